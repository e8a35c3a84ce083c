#include "host_link/tcp_streams.h"

#include <algorithm>

namespace quadrig::host {

TcpStreams::Stream& TcpStreams::stream_of(const TcpSegment& segment) {
    const Key key{segment.source, segment.destination, segment.source_port, segment.destination_port};
    const auto [place, is_new] = streams_.try_emplace(key);
    // A port that is used again is another connection.
    if (is_new || segment.begins) place->second = Stream{count_++, segment.sequence, {}};
    return place->second;
}

std::span<const std::byte> TcpStreams::fresh_bytes(Stream& stream, const TcpSegment& segment) {
    auto bytes = segment.payload;
    const auto behind = static_cast<std::int32_t>(*stream.expected - segment.sequence);
    if (behind > 0) bytes = bytes.subspan(std::min(static_cast<std::size_t>(behind), bytes.size()));
    // What is missing was lost to the capture, and with it the rest of the frame that it belonged to.
    if ((behind < 0 && !bytes.empty()) || stream.frames.broken()) stream.frames = {};
    if (!bytes.empty()) stream.expected = segment.sequence + static_cast<std::uint32_t>(segment.payload.size());
    return bytes;
}

}  // namespace quadrig::host
