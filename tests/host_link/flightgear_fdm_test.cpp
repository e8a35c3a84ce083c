#include <catch2/catch.hpp>
#include <filesystem>
#include <random>
#include <thread>

#include "host_link/fdm_stream.h"
#include "host_link/fdm_tcp_link.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/internet_address.h"
#include "host_link/sender.h"
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

TEST_CASE("Packets are found in a stream in whatever pieces it comes, and again after garbage") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (int run = 0; run < 50; ++run) {
        Bytes stream;
        std::vector<Bytes> sent;
        std::uint64_t garbage_runs = 0;
        std::uint32_t clean_from = 0;
        for (std::uint32_t i = 0; i < 60; ++i) {
            // A packet alone between garbage, or at the very end, has none behind it to tell it by.
            if (i < 59 && i > clean_from && random() % 6 == 0) {
                clean_from = i + 1;
                ++garbage_runs;
                for (auto left = 1 + random() % 900; left > 0; --left)
                    stream.push_back(static_cast<std::byte>(random() % 255 + 1));
            }
            Bytes packet = encoded({.version = random() % 2 == 0 ? 24U : 25U, .latitude = 0.5, .cur_time = i});
            // A host that forgot the byte order is to be heard whole too, for the reason to be told.
            if (random() % 10 == 0) std::reverse(packet.begin(), packet.begin() + 4);
            stream.insert(stream.end(), packet.begin(), packet.end());
            sent.push_back(packet);
        }
        flightgear::PacketStream packets;
        std::vector<Bytes> found;
        for (std::size_t at = 0; at < stream.size();) {
            const std::size_t piece = std::min<std::size_t>(stream.size() - at, 1 + random() % 1500);
            std::span<const std::byte> rest = std::span(stream).subspan(at, piece);
            while (const auto packet = packets.next(rest)) found.emplace_back(packet->begin(), packet->end());
            CHECK(rest.empty());
            at += piece;
        }
        CHECK((found == sent));
        CHECK(packets.breaks() == garbage_runs);
    }
}

TEST_CASE("Over TCP one host at a time is heard, may come back, and others are let go") {
    using namespace std::chrono_literals;
    FdmTcpLink link(parse_link_url("fdm://127.0.0.1:0?transport=tcp"));
    link.start(session_options(link.url(), {}));
    const LinkUrl to = parse_link_url("fdm://127.0.0.1:" + std::to_string(link.port()) + "?transport=tcp");
    const auto until = [&](const auto& condition) {
        for (int i = 0; i < 5000 && !condition(link.statistics()); ++i) std::this_thread::sleep_for(1ms);
        CHECK(condition(link.statistics()));
    };
    const Bytes packet = encoded({.latitude = 0.8, .altitude = 700.0});
    auto host = open_sender(to);
    for (std::size_t at = 0; at < packet.size(); at += 100)
        host->send(std::span(packet).subspan(at, std::min<std::size_t>(100, packet.size() - at)), 0);
    until([](const LinkStatistics& s) { return s.frames == 1; });
    const auto second = open_sender(to);
    until([](const LinkStatistics& s) { return s.rejected_for(Reject::too_many_clients) == 1; });
    host->send(Bytes(1000, std::byte{7}), 0);
    for (int i = 0; i < 20; ++i) host->send(packet, 0);
    until([](const LinkStatistics& s) { return s.frames == 21 && s.rejected_for(Reject::unknown_version) == 1; });
    host.reset();
    host = open_sender(to);
    host->send(packet, 0);
    until([](const LinkStatistics& s) { return s.frames == 22 && s.restarts == 1; });
    HostState state;
    CHECK(link.take_newest(state));
    CHECK(state.pose->position.altitude == 700.0);
    CHECK_FALSE(state.earlier.has_value());
    link.stop();
    CHECK(link.statistics().rejected_in_all() == 2);

    FdmTcpLink closed(parse_link_url("fdm://127.0.0.1:0?transport=tcp&allow=10.0.0.0/8"));
    closed.start(session_options(closed.url(), {}));
    const auto stranger =
        open_sender(parse_link_url("fdm://127.0.0.1:" + std::to_string(closed.port()) + "?transport=tcp"));
    for (int i = 0; i < 5000 && closed.statistics().rejected_in_all() == 0; ++i) std::this_thread::sleep_for(1ms);
    CHECK(closed.statistics().rejected_for(Reject::not_allowed) == 1);
}

TEST_CASE("A host's name is looked up when its link is opened, at either end, in the family of its reply") {
    using namespace std::chrono_literals;
    // Longer than a label may be: no name server is asked.
    const std::string nobody(64, 'x');
    CHECK_THROWS_WITH(open_link(parse_link_url("cigi://" + nobody + ":1")), Catch::Contains("host '" + nobody + "': "));

    // No name server need know this one: the system's table of hosts does, where there is one.
    if (!std::filesystem::exists("/etc/hosts")) {
        WARN("this machine has no /etc/hosts: no name looked up");
        return;
    }
    const auto link = open_link(parse_link_url("fdm://LocalHost:0"));
    link->start(session_options(link->url(), {}));
    const auto host = open_sender(parse_link_url("fdm://LOCALHOST:" + std::to_string(link->port())));
    host->send(encoded({.latitude = 0.8, .altitude = 700.0}), 0);
    for (int i = 0; i < 5000 && link->statistics().frames == 0; ++i) std::this_thread::sleep_for(1ms);
    CHECK(link->statistics().frames == 1);
    CHECK(link->url().text == "fdm://LocalHost:0");
    CHECK(looked_up(parse_link_url("cigi://LocalHost:0?reply=127.0.0.1:9")).address == "127.0.0.1");
}
