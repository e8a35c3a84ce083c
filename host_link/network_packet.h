/// Captured link-layer packets down to the UDP datagram or TCP segment inside. Pure.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

namespace quadrig::host {

/// An IPv4 (in the first four bytes) or IPv6 address.
struct IpAddress {
    bool v6 = false;
    std::array<std::uint8_t, 16> bytes{};
    friend auto operator<=>(const IpAddress&, const IpAddress&) = default;
};

struct UdpDatagram {
    IpAddress source, destination;
    std::uint16_t source_port = 0, destination_port = 0;
    std::span<const std::byte> payload;  ///< as much of it as was captured
};

/// One segment of a TCP stream.
struct TcpSegment {
    IpAddress source, destination;
    std::uint16_t source_port = 0, destination_port = 0;
    std::uint32_t sequence = 0;  ///< of the payload's first byte, or of the one after SYN
    bool begins = false;         ///< SYN: the stream starts here
    bool ends = false;           ///< FIN or RST: it ends with the payload
    std::span<const std::byte> payload;
};

enum class NotUdp : std::uint8_t { other_protocol, fragment, damaged };

/// libpcap's data link types that are understood.
bool is_known_link_type(int link_type);

/// `packet` is what was captured, from the link layer's header on.
std::variant<UdpDatagram, TcpSegment, NotUdp> transport_packet(int link_type, std::span<const std::byte> packet);
/// The same where only UDP matters.
std::variant<UdpDatagram, NotUdp> udp_datagram(int link_type, std::span<const std::byte> packet);

}  // namespace quadrig::host
