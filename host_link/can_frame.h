/// Classic CAN frames as recordings hold them: LINKTYPE_CAN_SOCKETCAN records and candump's text. Pure.
///
/// Record: u32 big-endian identifier (11 or 29 bits) with flags (bit 31 extended, 30 remote, 29 error), u8 length,
/// u8 FD flags, two reserved bytes, data. Text: "(seconds.fraction) interface ID#DATA", ID three hexadecimal digits or,
/// extended, eight. Source: tcpdump.org's list of link types, 227; can-utils' lib.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host_link/host_state.h"

namespace quadrig::host {

inline constexpr std::size_t kCanDataSize = 8;
inline constexpr std::size_t kCanRecordSize = 16;

struct CanFrame {
    std::uint32_t id = 0;
    bool extended = false;  ///< 29 bits
    bool remote = false;    ///< asks for data, carries none
    bool error = false;     ///< a controller's report, not a frame of the bus
    bool fd = false;        ///< CAN FD: no host's, and its data is left out
    std::uint8_t size = 0;  ///< bytes of `data`, 0 to 8
    std::array<std::byte, kCanDataSize> data{};

    friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

/// Absent where the record is cut, or holds a CAN FD or CAN XL frame: `fd` is never set.
std::optional<CanFrame> can_frame(std::span<const std::byte> record);
/// The whole 16 bytes, as Linux hands them to capture programs.
std::array<std::byte, kCanRecordSize> can_record(const CanFrame& frame);

struct CandumpLine {
    Time time{};                 ///< since 1970
    std::string_view interface;  ///< into the line's text
    CanFrame frame;
};

/// Absent for all that is not a frame: comments, damaged lines, CAN XL.
std::optional<CandumpLine> read_candump_line(std::string_view line);
/// Without the line's end; microseconds, as can-utils of every age read them.
std::string candump_line(const CandumpLine& line);

}  // namespace quadrig::host
