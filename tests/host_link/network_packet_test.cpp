#include <catch2/catch.hpp>

#include "host_link/network_packet.h"
#include "support.h"

using namespace quadrig::host;
using namespace quadrig::host::test;

namespace {

constexpr int kEthernet = 1, kRaw = 12;

const UdpDatagram* datagram(const std::variant<UdpDatagram, NotUdp>& result) {
    return std::get_if<UdpDatagram>(&result);
}

}  // namespace

TEST_CASE("Addresses and ports of IPv4 and IPv6 are read") {
    const Bytes v4 = ipv4_udp(from_hex("aabb"), {0x0A000005, 0xC0A80102, 1234, 5678});
    const auto read = udp_datagram(kRaw, v4);
    REQUIRE(datagram(read));
    CHECK(datagram(read)->source_port == 1234);
    CHECK(datagram(read)->destination_port == 5678);
    CHECK(datagram(read)->source.bytes[3] == 5);
    CHECK(datagram(read)->destination.bytes[0] == 192);
    CHECK_FALSE(datagram(read)->source.v6);
    CHECK(datagram(read)->payload.size() == 2);
    const Bytes v6 = ipv6_udp(from_hex("aabbcc"));
    const auto read6 = udp_datagram(kRaw, v6);
    REQUIRE(datagram(read6));
    CHECK(datagram(read6)->destination.v6);
    CHECK(datagram(read6)->destination.bytes[15] == 1);
    CHECK(datagram(read6)->payload.size() == 3);
}

TEST_CASE("IPv4 options and IPv6 extension headers are stepped over") {
    Bytes options = ipv4_udp(from_hex("aabb"));
    options[0] = std::byte{0x46};
    options.insert(options.begin() + 20, 4, std::byte{1});
    options[3] = static_cast<std::byte>(options.size());
    REQUIRE(datagram(udp_datagram(kRaw, options)));
    Bytes extended = ipv6_udp(from_hex("aabb"));
    extended[6] = std::byte{0};
    extended[5] = std::byte{18};
    const Bytes hop_by_hop = from_hex("1100000000000000");
    extended.insert(extended.begin() + 40, hop_by_hop.begin(), hop_by_hop.end());
    const auto read = udp_datagram(kRaw, extended);
    REQUIRE(datagram(read));
    CHECK(datagram(read)->payload.size() == 2);
    extended[6] = std::byte{44};
    CHECK(std::get<NotUdp>(udp_datagram(kRaw, extended)) == NotUdp::fragment);
}

TEST_CASE("The first fragment and the later ones are both told as fragments") {
    Bytes first = ipv4_udp(from_hex("aabb"));
    first[6] = std::byte{0x20};
    CHECK(std::get<NotUdp>(udp_datagram(kRaw, first)) == NotUdp::fragment);
    Bytes later = ipv4_udp(from_hex("aabb"));
    later[7] = std::byte{0x10};
    CHECK(std::get<NotUdp>(udp_datagram(kRaw, later)) == NotUdp::fragment);
    Bytes whole = ipv4_udp(from_hex("aabb"));
    whole[6] = std::byte{0x40};  // may not be fragmented
    CHECK(datagram(udp_datagram(kRaw, whole)) != nullptr);
}

TEST_CASE("A packet cut at any length, or with any byte garbled, never yields more payload than there is") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const std::vector<std::pair<int, Bytes>> sources{
        {kRaw, ipv4_udp(Bytes(40))},
        {kRaw, ipv6_udp(Bytes(40))},
        {kEthernet, ethernet(from_hex("00640800") + ipv4_udp(Bytes(40)), 0x8100)},
        {113, Bytes(14) + from_hex("86dd") + ipv6_udp(Bytes(40))},
        {276, from_hex("0800") + Bytes(18) + ipv4_udp(Bytes(40))},
        {0, from_hex("02000000") + ipv4_udp(Bytes(40))}};
    int found = 0;
    for (int i = 0; i < 100000; ++i) {
        auto [link, bytes] = sources[random() % sources.size()];
        for (auto n = random() % 4; n > 0; --n) bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        bytes.resize(random() % (bytes.size() + 1));
        bytes.shrink_to_fit();
        const auto read = udp_datagram(link, bytes);
        if (const auto* d = datagram(read)) {
            ++found;
            REQUIRE(d->payload.data() >= bytes.data());
            REQUIRE(d->payload.data() + d->payload.size() <= bytes.data() + bytes.size());
        }
    }
    CHECK(found > 1000);
}
