#include "tshark_judge.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <stdexcept>

namespace quadrig::host::test {

namespace {

double number_of(const std::string& text) {
    if (text == "True") return 1.0;
    if (text == "False") return 0.0;
    std::size_t used = 0;
    const double value =
        text.starts_with("0x") ? static_cast<double>(std::stoull(text, &used, 16)) : std::stod(text, &used);
    if (used != text.size()) throw std::runtime_error("not one number: " + text);
    return value;
}

}  // namespace

void judge(const std::string& name, ByteOrder order, const std::function<Columns(Random&, Bytes&, ByteOrder)>& make) {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    Random random(seed);
    PcapWriter capture(228);
    std::vector<Columns> expected;
    for (int i = 0; i < 300; ++i) {
        Bytes bytes;
        expected.push_back(make(random, bytes, order));
        capture.packet(ipv4_udp(bytes), std::chrono::milliseconds(i));
    }
    std::vector<std::string> fields{"cigi.byte_swap", "_ws.malformed", "cigi.unknown"};
    for (const auto& column : expected.front()) fields.push_back(column.field);
    const auto rows = tshark_fields(capture.save(name + ".pcap"), fields);
    REQUIRE(rows.size() == expected.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        REQUIRE(rows[r].size() == fields.size());
        CHECK(number_of(rows[r][0]) == (order == ByteOrder::big ? 0x8000 : 0x0080));
        CHECK(rows[r][1].empty());
        CHECK(rows[r][2].empty());
        for (std::size_t i = 0; i < expected[r].size(); ++i) {
            INFO("message " << r << ", " << expected[r][i].field << " read as " << rows[r][i + 3]);
            const double value = expected[r][i].value;
            CHECK(std::abs(number_of(rows[r][i + 3]) - value) <= 1e-14 * std::abs(value));
        }
    }
}

}  // namespace quadrig::host::test
