/// The Modbus frames inside captured TCP segments. Pure.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "host_link/modbus.h"
#include "host_link/network_packet.h"

namespace quadrig::host {

/// Follows every direction of every connection in a capture. Segments that repeat what was there are skipped; after a
/// missing one the stream goes on with the next segment, as a host writes one frame at a time.
class TcpStreams {
  public:
    /// A connection's direction, numbered in the order of their first bytes.
    struct Stream {
        std::uint32_t number = 0;
        std::optional<std::uint32_t> expected;  ///< sequence number
        modbus::FrameBuffer frames;
    };

    /// Gives each frame that the segment completes to `take(stream, frame)`; whether there was any, or the beginning of
    /// one.
    template <class Take>
    bool feed(const TcpSegment& segment, Take take) {
        Stream& stream = stream_of(segment);
        auto bytes = fresh_bytes(stream, segment);
        if (bytes.empty()) return segment.payload.empty() ? false : !stream.frames.broken();
        while (const auto frame = stream.frames.next(bytes)) take(stream, *frame);
        return !stream.frames.broken();
    }

  private:
    struct Key {
        IpAddress source, destination;
        std::uint16_t source_port = 0, destination_port = 0;
        friend auto operator<=>(const Key&, const Key&) = default;
    };

    Stream& stream_of(const TcpSegment& segment);
    static std::span<const std::byte> fresh_bytes(Stream& stream, const TcpSegment& segment);

    std::map<Key, Stream> streams_;
    std::uint32_t count_ = 0;
};

}  // namespace quadrig::host
