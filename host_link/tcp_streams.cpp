#include "host_link/tcp_streams.h"

namespace quadrig::host {

TcpStreams::Key TcpStreams::key_of(const TcpSegment& segment) {
    return {segment.source, segment.destination, segment.source_port, segment.destination_port};
}

std::optional<std::uint32_t> TcpStreams::number_of(const TcpSegment& segment) const {
    const auto known = streams_.find(key_of(segment));
    return known == streams_.end() ? std::nullopt : std::optional(known->second.number);
}

TcpStreams::Stream& TcpStreams::stream_of(const TcpSegment& segment) {
    const auto [place, is_new] = streams_.try_emplace(key_of(segment));
    // A port that is used again is another connection.
    if (is_new || segment.begins)
        place->second =
            Stream{count_++, segment.source, segment.destination, segment.destination_port, segment.sequence, {}, {}};
    return place->second;
}

bool TcpStreams::is_early(const Stream& stream, const TcpSegment& segment) {
    const bool ahead = static_cast<std::int32_t>(stream.expected - segment.sequence) < 0;
    // Where no frames are, there is nothing to keep in order.
    return ahead && !segment.payload.empty() && !stream.frames.broken();
}

void TcpStreams::hold(Stream& stream, const TcpSegment& segment, Time captured) {
    const auto ahead = [&](std::uint32_t sequence) { return sequence - stream.expected; };
    const auto place = std::ranges::upper_bound(stream.held, ahead(segment.sequence), {},
                                                [&](const Held& h) { return ahead(h.sequence); });
    stream.held.insert(place, {segment.sequence, captured, {segment.payload.begin(), segment.payload.end()}});
}

void TcpStreams::pass_over_gap(Stream& stream) {
    stream.frames = {};
    stream.expected = stream.held.front().sequence;
}

std::span<const std::byte> TcpStreams::fresh_bytes(Stream& stream, std::uint32_t sequence,
                                                   std::span<const std::byte> payload) {
    const auto behind = static_cast<std::int32_t>(stream.expected - sequence);
    const auto known = static_cast<std::size_t>(std::max(behind, 0));
    const auto bytes = payload.subspan(std::min(known, payload.size()));
    if (stream.frames.broken()) stream.frames = {};
    if (!bytes.empty()) stream.expected = sequence + static_cast<std::uint32_t>(payload.size());
    return bytes;
}

}  // namespace quadrig::host
