/// How CIGI frames packets, in both of its living generations, and which packets there are.
///
/// 3.x: u8 id, u8 size, body. 4.0: u16 size, u16 id, body. Sizes are of the whole packet, in bytes, multiples of 8; the
/// byte order is the sender's. A packet goes by its kind here: its 3.x id, and numbers from 256 on for those that only
/// 4.0 has. Sources: CIGI 3.3 interface control document as read by the CIGI class library 3.3.3 and by Wireshark's
/// dissector; SISO-STD-013-2014 (CIGI 4.0) as read by the CIGI class library for 4.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "host_link/wire.h"

namespace quadrig::host::cigi {

/// By the major version.
enum class Version : std::uint8_t { three = 3, four = 4 };

/// What has to be known of a message to read its packets; a byte order alone means 3.x.
struct Format {
    ByteOrder order = ByteOrder::little;
    Version version = Version::three;
    constexpr Format() = default;
    constexpr Format(ByteOrder o, Version v = Version::three) : order(o), version(v) {}
    friend bool operator==(const Format&, const Format&) = default;
};

/// A packet's kind.
using Kind = std::uint16_t;
inline constexpr Kind kEntityPosition = 256, kAnimationControl = 257, kSymbolTexturedCircle = 258,
                      kSymbolTexturedPolygon = 259;
/// Ids of 4.0 that the standard leaves to users, and those that it does not give a meaning.
inline constexpr Kind kExtension4 = 260, kUnknown4 = 261;
inline constexpr std::size_t kKinds = 262;

/// "entity_control", "rate_control"…; "user" for ids that are left to users, "unknown" for ids without a meaning.
/// What 4.0 renamed keeps its older name.
std::string_view packet_name(Kind kind);

/// The size that a packet has in a version; absent where it may have any, or is not there.
std::optional<std::size_t> fixed_size(Kind kind, Version version);
/// 4.0's id of a kind, and the other way round.
std::optional<std::uint16_t> id_in_4(Kind kind);
Kind kind_in_4(std::uint16_t id);

inline constexpr std::size_t header_size(Version version) { return version == Version::four ? 4 : 2; }

/// One packet inside a message, header included.
struct Packet {
    Kind id = 0;
    std::span<const std::byte> bytes;
};

/// Takes the first packet off `rest`, which begins with a whole one.
Packet next_packet(std::span<const std::byte>& rest, Format format = {});

}  // namespace quadrig::host::cigi
