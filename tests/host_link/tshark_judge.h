/// Wireshark's dissector as the judge of what we encode: random fields, their names in tshark, and what it reads.
#pragma once

#include <array>
#include <functional>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "support.h"

namespace quadrig::host::test {

struct Random {
    std::mt19937_64 engine;
    explicit Random(std::uint64_t seed) : engine(seed) {}
    std::uint64_t below(std::uint64_t n) { return std::uniform_int_distribution<std::uint64_t>(0, n - 1)(engine); }
    template <class T>
    void number(T& value) {
        value = static_cast<T>(engine());
    }
    void bits(auto& value, int count) {
        value = static_cast<std::remove_reference_t<decltype(value)>>(below(1U << count));
    }
    // tshark prints floats with six digits: multiples of 1/8 below 1000 need no more.
    void number(float& value) { value = static_cast<float>(static_cast<int>(below(15999)) - 7999) / 8.0F; }
    void number(double& value) { value = std::uniform_real_distribution<double>(-180.0, 180.0)(engine); }
};

struct Column {
    std::string field;
    double value;
};
using Columns = std::vector<Column>;

/// Expects fields of one packet, whose names begin alike.
struct Fields {
    Random& random;
    Columns& columns;
    std::string packet;

    void expect(const std::string& field, auto value) {
        columns.push_back({"cigi." + packet + "." + field, static_cast<double>(value)});
    }
    void number(const std::string& field, auto& value) {
        random.number(value);
        expect(field, value);
    }
    void bits(const std::string& field, auto& value, int count) {
        random.bits(value, count);
        expect(field, value);
    }
    void triple(const std::string& before, std::array<double, 3>& values) {
        number(before + "lat_xoff", values[0]);
        number(before + "lon_yoff", values[1]);
        number(before + "alt_zoff", values[2]);
    }
};

/// 300 messages of random fields are read by tshark as they were meant, none of it malformed or unknown.
void judge(const std::string& name, ByteOrder order, const std::function<Columns(Random&, Bytes&, ByteOrder)>& make);

}  // namespace quadrig::host::test
