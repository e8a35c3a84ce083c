/// The Modbus frames inside captured TCP segments. Pure.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "host_link/host_state.h"
#include "host_link/modbus.h"
#include "host_link/network_packet.h"

namespace quadrig::host {

/// Follows every direction of every connection in a capture. Segments that repeat what was there are skipped; those
/// that come before their turn wait for it. What does not come before kMostHeld others was lost to the capture, and
/// with it the rest of the frame that it belonged to: the stream goes on with the next segment, as a host writes one
/// frame at a time.
class TcpStreams {
  public:
    static constexpr std::size_t kMostHeld = 8;

    /// A segment before its turn.
    struct Held {
        std::uint32_t sequence = 0;
        Time captured{};
        std::vector<std::byte> payload;
    };
    /// A connection's direction, numbered in the order of their first bytes.
    struct Stream {
        std::uint32_t number = 0;
        IpAddress source, destination;
        std::uint16_t destination_port = 0;
        std::uint32_t expected = 0;  ///< sequence number
        modbus::FrameBuffer frames;
        std::vector<Held> held;
    };

    /// Gives each frame that is complete with the segment to `take(stream, captured, frame)`; whether there was any, or
    /// the beginning of one. A frame was captured when the last of its segments was. `end(number)` is told of streams
    /// that close, or whose port another connection uses.
    template <class Take, class End>
    bool feed(const TcpSegment& segment, Time captured, Take take, End end) {
        if (const auto before = segment.begins ? number_of(segment) : std::nullopt) end(*before);
        Stream& stream = stream_of(segment);
        if (is_early(stream, segment)) {
            hold(stream, segment, captured);
            if (stream.held.size() > kMostHeld) release(stream, take);
            return true;
        }
        const bool modbus = read(stream, segment.sequence, segment.payload, captured, take);
        catch_up(stream, captured, take);
        if (segment.ends) end(stream.number);
        return modbus;
    }
    /// What still waits, once there is no more.
    template <class Take>
    void finish(Take take) {
        for (auto& [key, stream] : streams_)
            while (!stream.held.empty()) release(stream, take);
    }

  private:
    struct Key {
        IpAddress source, destination;
        std::uint16_t source_port = 0, destination_port = 0;
        friend auto operator<=>(const Key&, const Key&) = default;
    };

    static Key key_of(const TcpSegment& segment);
    /// Of the stream that the segment's ports have had so far.
    [[nodiscard]] std::optional<std::uint32_t> number_of(const TcpSegment& segment) const;
    Stream& stream_of(const TcpSegment& segment);
    static bool is_early(const Stream& stream, const TcpSegment& segment);
    static void hold(Stream& stream, const TcpSegment& segment, Time captured);
    /// What of the payload was not there before.
    static std::span<const std::byte> fresh_bytes(Stream& stream, std::uint32_t sequence,
                                                  std::span<const std::byte> payload);
    /// Passes over what is missing before the first one held.
    static void pass_over_gap(Stream& stream);

    template <class Take>
    static bool read(Stream& stream, std::uint32_t sequence, std::span<const std::byte> payload, Time captured,
                     Take take) {
        auto bytes = fresh_bytes(stream, sequence, payload);
        if (bytes.empty()) return payload.empty() ? false : !stream.frames.broken();
        while (const auto frame = stream.frames.next(bytes)) take(stream, captured, *frame);
        return !stream.frames.broken();
    }
    /// Reads those held whose turn has come, none of them earlier than at `since`.
    template <class Take>
    static void catch_up(Stream& stream, Time since, Take take) {
        while (!stream.held.empty() && static_cast<std::int32_t>(stream.expected - stream.held[0].sequence) >= 0) {
            const Held next = std::move(stream.held.front());
            stream.held.erase(stream.held.begin());
            read(stream, next.sequence, next.payload, std::max(since, next.captured), take);
        }
    }
    template <class Take>
    static void release(Stream& stream, Take take) {
        pass_over_gap(stream);
        catch_up(stream, Time::min(), take);
    }

    std::map<Key, Stream> streams_;
    std::uint32_t count_ = 0;
};

}  // namespace quadrig::host
