/// What a recording holds, byte by byte: pcapng of datagrams and requests with headers made up for them, or candump's
/// text. Pure.
///
/// pcapng: one section, one interface, times in nanoseconds. UDP and Modbus/TCP: raw IP packets (LINKTYPE_RAW) without
/// checksums; CAN: LINKTYPE_CAN_SOCKETCAN. Source: draft-ietf-opsawg-pcapng, sections 4.1 to 4.3; RFC 791, 8200, 768,
/// 9293.
#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "host_link/can_frame.h"
#include "host_link/link_url.h"

namespace quadrig::host {

/// Something that a live link took in, in the order in which its session saw it.
struct Heard {
    Time arrival{};  ///< CLOCK_MONOTONIC
    std::span<const std::byte> bytes;
    std::uint32_t source = 0;   ///< Modbus: the connection
    sockaddr_storage from{};    ///< not CAN
    std::uint16_t to_port = 0;  ///< not CAN
    std::uint32_t changes = 0;  ///< how often the link has passed to another host since the one before
    bool closes = false;        ///< Modbus: the connection's end, without bytes; nothing that is counted
};

enum class RecordingFormat : std::uint8_t { pcapng, candump };

/// Makes up one recording, piece by piece.
class RecordingText {
  public:
    /// `interface`: CAN's name.
    RecordingText(Protocol protocol, RecordingFormat format, std::string interface);

    /// What a file begins with.
    [[nodiscard]] std::string begin() const;
    /// What stands for `heard`, at `time` since 1970.
    std::string piece(const Heard& heard, Time time);

  private:
    std::string ip_packet(const Heard& heard, std::uint8_t protocol, const std::string& segment) const;
    std::string tcp_segment(const Heard& heard, std::uint8_t flags, std::uint32_t sequence);
    std::string modbus_piece(const Heard& heard, Time time);
    [[nodiscard]] std::string block(std::span<const char> packet, Time time) const;

    Protocol protocol_;
    RecordingFormat format_;
    std::string interface_;
    std::map<std::uint32_t, std::uint32_t> next_sequence_;  ///< by connection
};

}  // namespace quadrig::host
