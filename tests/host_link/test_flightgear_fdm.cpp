#include <catch2/catch.hpp>
#include <random>

#include "host_link/flightgear_fdm.h"
#include "support.h"

using namespace quadrig::host;
using namespace quadrig::host::test;

namespace {

Reject reason_of(const Bytes& datagram) {
    const auto decoded = flightgear::decode(datagram);
    REQUIRE(std::holds_alternative<Reject>(decoded));
    return std::get<Reject>(decoded);
}

Bytes encoded(const flightgear::NetFdm& packet) {
    Bytes bytes(flightgear::kSize25);
    bytes.resize(flightgear::encode(packet, bytes));
    return bytes;
}

Bytes sized(std::uint32_t version, std::size_t size) {
    Bytes bytes(size);
    if (size >= 4) store(bytes, 0, ByteOrder::big, version);
    return bytes;
}

}  // namespace

TEST_CASE("The start of a version 24 packet reads as the values it was made from") {
    Bytes bytes = from_hex(
        "00000018000000003fc957af137e62063fea6523a09912354098b400000000000000"
        "00003db2b8c7bd32b8ba");
    bytes.resize(flightgear::kSize24);
    const auto decoded = flightgear::decode(bytes);
    const auto& packet = std::get<flightgear::NetFdm>(decoded);
    CHECK(packet.version == 24);
    CHECK(packet.longitude == Approx(0.1979884).epsilon(1e-7));
    CHECK(packet.latitude == Approx(0.82484609).epsilon(1e-8));
    CHECK(packet.altitude == 1581.0);
    CHECK(packet.phi == 0.0872665F);
    CHECK(packet.theta == -0.0436332F);
}

TEST_CASE("Versions 24 and 25 carry a pose at the same place and the time at their own") {
    for (const auto& [version, size, time_at] : {std::tuple{24U, 408U, 356U}, std::tuple{25U, 552U, 500U}}) {
        flightgear::NetFdm packet;
        packet.version = version;
        packet.latitude = 0.5;
        packet.psi = 6.0F;
        packet.cur_time = 0x01020304;
        packet.visibility = 25000.0F;
        const Bytes bytes = encoded(packet);
        CHECK(bytes.size() == size);
        CHECK(load<double>(bytes, 16, ByteOrder::big) == 0.5);
        CHECK(load<float>(bytes, 44, ByteOrder::big) == 6.0F);
        CHECK(load<std::uint32_t>(bytes, time_at, ByteOrder::big) == 0x01020304);
        const auto decoded = flightgear::decode(bytes);
        CHECK(std::get<flightgear::NetFdm>(decoded).cur_time == 0x01020304);
        CHECK(std::get<flightgear::NetFdm>(decoded).visibility == 25000.0F);
    }
}

TEST_CASE("Other versions and sizes are refused with the likely cause") {
    CHECK(reason_of({}) == Reject::truncated);
    CHECK(reason_of(sized(24, 3)) == Reject::truncated);
    CHECK(reason_of(sized(24, 552)) == Reject::version_size_mismatch);
    CHECK(reason_of(sized(25, 408)) == Reject::version_size_mismatch);
    CHECK(reason_of(sized(24, 409)) == Reject::version_size_mismatch);
    CHECK(reason_of(sized(0x18000000, 408)) == Reject::byte_swapped_version);
    CHECK(reason_of(sized(0x19000000, 552)) == Reject::byte_swapped_version);
    CHECK(reason_of(sized(23, 408)) == Reject::unknown_version);
    CHECK(reason_of(sized(0, 408)) == Reject::unknown_version);
    for (std::size_t size = 4; size < flightgear::kSize24; ++size)
        REQUIRE(reason_of(sized(24, size)) == Reject::truncated);
    for (std::size_t size = 409; size < flightgear::kSize25; ++size)
        REQUIRE(reason_of(sized(25, size)) == Reject::truncated);
}

TEST_CASE("Random bytes are never taken for a packet of another size or version") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::size_t taken = 0;
    for (int i = 0; i < 20000; ++i) {
        Bytes bytes(i % 2 == 0 ? random() % 600 : (random() % 2 == 0 ? 408 : 552));
        for (auto& b : bytes) b = static_cast<std::byte>(random());
        if (bytes.size() >= 4)
            store<std::uint32_t>(bytes, 0, ByteOrder::big, 23 + static_cast<std::uint32_t>(random() % 4));
        const auto decoded = flightgear::decode(bytes);
        const bool sound = bytes.size() >= 4 && ((bytes.size() == 408 && std::to_integer<int>(bytes[3]) == 24) ||
                                                 (bytes.size() == 552 && std::to_integer<int>(bytes[3]) == 25));
        REQUIRE(std::holds_alternative<flightgear::NetFdm>(decoded) == sound);
        taken += sound ? 1U : 0U;
    }
    CHECK(taken > 1000);
}
