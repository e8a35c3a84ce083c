/// Captured link-layer packets down to the UDP datagram inside. Pure.
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

enum class NotUdp : std::uint8_t { other_protocol, fragment, damaged };

/// libpcap's data link types that are understood.
bool is_known_link_type(int link_type);

/// `packet` is what was captured, from the link layer's header on.
std::variant<UdpDatagram, NotUdp> udp_datagram(int link_type, std::span<const std::byte> packet);

}  // namespace quadrig::host
