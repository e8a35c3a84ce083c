#include "host_link/network_packet.h"

#include <pcap/dlt.h>

#include <algorithm>
#include <cstring>

#include "host_link/wire.h"

#ifndef DLT_LINUX_SLL2
#define DLT_LINUX_SLL2 276
#endif

namespace quadrig::host {

namespace {

using Bytes = std::span<const std::byte>;
using Result = std::variant<UdpDatagram, TcpSegment, NotUdp>;

constexpr std::uint16_t kEtherIpv4 = 0x0800, kEtherIpv6 = 0x86DD, kEtherVlan = 0x8100, kEtherServiceVlan = 0x88A8,
                        kEtherOldQinQ = 0x9100;
constexpr std::uint8_t kHopByHop = 0, kTcp = 6, kUdp = 17, kRouting = 43, kFragment = 44, kDestinationOptions = 60;
constexpr std::size_t kUdpHeader = 8, kTcpHeader = 20, kIpv6Header = 40, kIpv4Header = 20;

std::uint8_t u8(Bytes b, std::size_t at) { return std::to_integer<std::uint8_t>(b[at]); }
std::uint16_t u16(Bytes b, std::size_t at) { return load<std::uint16_t>(b, at, ByteOrder::big); }

IpAddress address(Bytes bytes, bool v6) {
    IpAddress result{v6, {}};
    std::memcpy(result.bytes.data(), bytes.data(), bytes.size());
    return result;
}

Result udp(Bytes segment, const IpAddress& source, const IpAddress& destination) {
    if (segment.size() < kUdpHeader) return NotUdp::damaged;
    const std::size_t length = u16(segment, 4);
    if (length < kUdpHeader) return NotUdp::damaged;
    const Bytes payload = segment.subspan(kUdpHeader, std::min(length, segment.size()) - kUdpHeader);
    return UdpDatagram{source, destination, u16(segment, 0), u16(segment, 2), payload};
}

Result tcp(Bytes segment, const IpAddress& source, const IpAddress& destination) {
    constexpr unsigned kFin = 1, kSyn = 2, kReset = 4;
    if (segment.size() < kTcpHeader) return NotUdp::other_protocol;
    const std::size_t header = std::size_t{4} * (u8(segment, 12) >> 4);
    if (header < kTcpHeader || header > segment.size()) return NotUdp::other_protocol;
    const bool begins = (u8(segment, 13) & kSyn) != 0, ends = (u8(segment, 13) & (kFin | kReset)) != 0;
    const std::uint32_t sequence = load<std::uint32_t>(segment, 4, ByteOrder::big) + (begins ? 1U : 0U);
    return TcpSegment{source, destination, u16(segment, 0),        u16(segment, 2), sequence,
                      begins, ends,        segment.subspan(header)};
}

Result transport(std::uint8_t protocol, Bytes segment, const IpAddress& source, const IpAddress& destination) {
    if (protocol == kUdp) return udp(segment, source, destination);
    if (protocol == kTcp) return tcp(segment, source, destination);
    return NotUdp::other_protocol;
}

Result ipv4(Bytes packet) {
    if (packet.size() < kIpv4Header) return NotUdp::damaged;
    const std::size_t header = std::size_t{4} * (u8(packet, 0) & 0x0FU);
    if (header < kIpv4Header || header > packet.size()) return NotUdp::damaged;
    const std::uint8_t protocol = u8(packet, 9);
    if (protocol != kUdp && protocol != kTcp) return NotUdp::other_protocol;
    if ((u16(packet, 6) & 0x3FFFU) != 0) return NotUdp::fragment;
    // 0: the network card was to fill it in (segmentation offload). Ethernet pads short packets beyond the total
    // length.
    const std::size_t total = u16(packet, 2) == 0 ? packet.size() : u16(packet, 2);
    if (total < header) return NotUdp::damaged;
    const Bytes body = packet.first(std::min(total, packet.size())).subspan(header);
    return transport(protocol, body, address(packet.subspan(12, 4), false), address(packet.subspan(16, 4), false));
}

Result ipv6(Bytes packet) {
    if (packet.size() < kIpv6Header) return NotUdp::damaged;
    const IpAddress source = address(packet.subspan(8, 16), true), destination = address(packet.subspan(24, 16), true);
    std::uint8_t next = u8(packet, 6);
    const std::size_t length = u16(packet, 4);
    Bytes body = packet.subspan(kIpv6Header);
    if (length != 0) body = body.first(std::min(length, body.size()));
    while (next == kHopByHop || next == kRouting || next == kDestinationOptions) {
        if (body.size() < 8) return NotUdp::damaged;
        const std::size_t size = std::size_t{8} * (u8(body, 1) + 1U);
        if (size > body.size()) return NotUdp::damaged;
        next = u8(body, 0);
        body = body.subspan(size);
    }
    if (next == kFragment) return NotUdp::fragment;
    return transport(next, body, source, destination);
}

Result ip(Bytes packet) {
    if (packet.empty()) return NotUdp::damaged;
    switch (u8(packet, 0) >> 4) {
        case 4:
            return ipv4(packet);
        case 6:
            return ipv6(packet);
        default:
            return NotUdp::other_protocol;
    }
}

/// `type_at`: where the EtherType stands; the network packet, or a VLAN tag, follows `header` bytes from the start.
Result ether(Bytes packet, std::size_t type_at, std::size_t header) {
    if (packet.size() < header) return NotUdp::damaged;
    std::uint16_t type = u16(packet, type_at);
    packet = packet.subspan(header);
    while (type == kEtherVlan || type == kEtherServiceVlan || type == kEtherOldQinQ) {
        if (packet.size() < 4) return NotUdp::damaged;
        type = u16(packet, 2);
        packet = packet.subspan(4);
    }
    if (type == kEtherIpv4 || type == kEtherIpv6) return ip(packet);
    return NotUdp::other_protocol;
}

}  // namespace

bool is_known_link_type(int link_type) {
    switch (link_type) {
        case DLT_EN10MB:
        case DLT_RAW:
        case DLT_IPV4:
        case DLT_IPV6:
        case DLT_LINUX_SLL:
        case DLT_LINUX_SLL2:
        case DLT_NULL:
        case DLT_LOOP:
            return true;
        default:
            return false;
    }
}

std::variant<UdpDatagram, TcpSegment, NotUdp> transport_packet(int link_type, std::span<const std::byte> packet) {
    switch (link_type) {
        case DLT_EN10MB:
            return ether(packet, 12, 14);
        case DLT_LINUX_SLL:
            return ether(packet, 14, 16);
        case DLT_LINUX_SLL2:
            return ether(packet, 0, 20);
        case DLT_RAW:
        case DLT_IPV4:
        case DLT_IPV6:
            return ip(packet);
        // Four bytes of address family, whose numbers differ between systems: the IP version says the same.
        case DLT_NULL:
        case DLT_LOOP:
            return packet.size() < 4 ? Result(NotUdp::damaged) : ip(packet.subspan(4));
        default:
            return NotUdp::other_protocol;
    }
}

std::variant<UdpDatagram, NotUdp> udp_datagram(int link_type, std::span<const std::byte> packet) {
    const auto result = transport_packet(link_type, packet);
    if (const auto* datagram = std::get_if<UdpDatagram>(&result)) return *datagram;
    if (const auto* other = std::get_if<NotUdp>(&result)) return *other;
    return NotUdp::other_protocol;
}

}  // namespace quadrig::host
