// Modbus streams as a capture has them: segments late, and segments lost.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "host_link/capture.h"
#include "host_link/modbus.h"
#include "host_link/modbus_pose.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;

namespace {

/// An IPv4 packet with a TCP segment in it; checksums zero.
constexpr std::byte kFin{1}, kSyn{2}, kReset{4}, kPushAck{0x18};
Bytes segment_packet(std::uint32_t sequence, std::span<const std::byte> payload, std::byte flags = kPushAck,
                     std::uint16_t port = 8005) {
    constexpr std::size_t kIp = 20, kTcp = 20, kUdp = 8;
    Bytes packet = ipv4_udp(Bytes(kTcp - kUdp) + Bytes(payload.begin(), payload.end()),
                            {.source_port = port, .destination_port = 502});
    packet[9] = std::byte{6};
    store(std::span(packet), kIp + 4, ByteOrder::big, sequence);
    packet[kIp + 12] = std::byte{0x50};
    packet[kIp + 13] = flags;
    return packet;
}

/// A request that writes the pose of that sequence number.
Bytes request_with(std::uint16_t sequence) {
    const modbus::HostPose pose{sequence, 0, {{{47.26}, {11.34}, 1200.0}, {}}};
    const auto block = modbus::float_block(pose, {});
    Bytes frame(modbus::kLargestFrame);
    frame.resize(modbus::write_request(1, 0, block, frame));
    return frame;
}

}  // namespace

TEST_CASE("Segments captured out of order give every frame, and a lost one takes no frame but its own") {
    constexpr std::uint32_t kRawIp = 101;
    constexpr std::uint16_t kFrames = 30;
    const std::size_t size = request_with(0).size(), half = size / 2;
    struct Piece {
        std::uint16_t frame;
        bool second;
    };
    std::vector<Piece> in_order;
    for (std::uint16_t f = 0; f < kFrames; ++f)
        for (const bool second : {false, true}) in_order.push_back({f, second});
    // A frame's sequence number, where the capture has it whole, and when.
    const auto read = [&](const std::vector<Piece>& pieces, std::uint32_t start) {
        PcapWriter writer(kRawIp);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const Bytes frame = request_with(pieces[i].frame);
            const std::span all(frame);
            const auto offset = static_cast<std::uint32_t>(pieces[i].frame * size + (pieces[i].second ? half : 0));
            writer.packet(segment_packet(start + offset, pieces[i].second ? all.subspan(half) : all.first(half)),
                          Time(1'000'000'000 + 1'000'000 * static_cast<std::int64_t>(i)));
        }
        const Capture capture = read_capture(writer.save("segments.pcap"), Protocol::modbus);
        std::vector<std::pair<std::uint16_t, std::int64_t>> frames;
        for (const auto& datagram : capture.datagrams)
            frames.emplace_back(load<std::uint16_t>(capture.payload(datagram), size - 2, ByteOrder::big),
                                (datagram.captured.count() - 1'000'000'000) / 1'000'000);
        return frames;
    };
    for (const std::uint32_t start : {1U, 0xFFFFFFFFU - static_cast<std::uint32_t>(5 * size)}) {
        CAPTURE(start);
        // Each piece up to four places late.
        std::mt19937 random(7);
        for (int trial = 0; trial < 20; ++trial) {
            auto pieces = in_order;
            std::vector<double> place(pieces.size());
            std::vector<std::size_t> order(pieces.size());
            for (std::size_t i = 0; i < place.size(); ++i) {
                order[i] = i;
                place[i] =
                    static_cast<double>(i) + (i == 0 ? 0.0 : 4.0 * static_cast<double>(random() % 1000) / 1000.0);
            }
            std::ranges::sort(order, {}, [&](std::size_t i) { return place[i]; });
            for (std::size_t i = 0; i < order.size(); ++i) pieces[i] = in_order[order[i]];
            const auto frames = read(pieces, start);
            REQUIRE(frames.size() == kFrames);
            // It is there once all before it are.
            for (std::uint16_t f = 0; f < kFrames; ++f) {
                std::int64_t last = 0;
                for (std::size_t i = 0; i < pieces.size(); ++i)
                    if (pieces[i].frame <= f) last = static_cast<std::int64_t>(i);
                CHECK(frames[f] == std::pair(f, last));
            }
        }
        for (const std::size_t lost : {std::size_t{20}, std::size_t{21}, in_order.size() - 4}) {
            auto pieces = in_order;
            pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(lost));
            const auto frames = read(pieces, start);
            CAPTURE(lost);
            REQUIRE(frames.size() == kFrames - 1U);
            for (std::size_t i = 0; i < frames.size(); ++i) {
                const std::size_t f = i < lost / 2 ? i : i + 1;
                CHECK(frames[i] == std::pair(static_cast<std::uint16_t>(f),
                                             static_cast<std::int64_t>(2 * f + 1 - (f < lost / 2 ? 0 : 1))));
            }
        }
    }
}

TEST_CASE("A stream ends with FIN or RST, or where its port begins another, and of one flow it is told between which") {
    constexpr std::uint32_t kRawIp = 101;
    PcapWriter writer(kRawIp);
    Time now{1'000'000'000};
    const auto add = [&](const Bytes& packet) { writer.packet(packet, now += Time(1'000'000)); };
    const Bytes frame = request_with(1);
    add(segment_packet(100, frame, kPushAck, 1));
    // A server that writes too: a flow of its own, which is not taken.
    Bytes other = segment_packet(100, frame, kPushAck, 9);
    other[15] = std::byte{99};
    add(other);
    add(segment_packet(161, {}, kFin, 1));
    add(segment_packet(100, frame, kPushAck, 2));
    add(segment_packet(161, {}, kReset, 2));
    add(segment_packet(100, frame, kPushAck, 3));
    add(segment_packet(500, {}, kSyn, 3));
    add(segment_packet(501, frame, kPushAck, 3));
    add(segment_packet(562, {}, kFin, 3));
    const Capture capture = read_capture(writer.save("ends.pcap"), Protocol::modbus);
    REQUIRE(capture.datagrams.size() == 4);
    CHECK(capture.closed_before(0).empty());
    for (std::size_t i = 1; i < 4; ++i) {
        CAPTURE(i);
        REQUIRE(capture.closed_before(i).size() == 1);
        CHECK(capture.closed_before(i)[0].source == capture.datagrams[i - 1].source);
    }
}
