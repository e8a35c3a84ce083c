#include <catch2/catch.hpp>

#include "host_link/cigi.h"
#include "support.h"

using namespace quadrig::host;
using namespace quadrig::host::test;

namespace {

Reject reason_of(std::span<const std::byte> datagram) {
    const auto opened = cigi::open_message(datagram);
    REQUIRE(std::holds_alternative<Reject>(opened));
    return std::get<Reject>(opened);
}

bool is_sound(std::span<const std::byte> datagram) {
    return std::holds_alternative<cigi::Message>(cigi::open_message(datagram));
}

Bytes sound_message(ByteOrder order = ByteOrder::little) {
    return message(order, ig_control(7), ownship(), cigi::ViewControl{}, cigi::AtmosphereControl{});
}

constexpr auto kOrders = {ByteOrder::little, ByteOrder::big};

}  // namespace

// Made from the interface control document's tables, and read back right by Wireshark.
TEST_CASE("IG Control, Start Of Frame and Entity Control match published test vectors in both byte orders") {
    cigi::IgControl ig = ig_control(1001, 123456);
    ig.last_ig_frame = 5005;
    CHECK(to_hex(message(ByteOrder::little, ig)) == "0118030035000080e903000040e201008d13000000000000");
    CHECK(to_hex(message(ByteOrder::big, ig)) ==
          "01180300350080"
          "00000003e90001e2400000138d00000000");
    cigi::StartOfFrame sof;
    sof.database = 1;
    sof.mode = cigi::IgMode::operate;
    sof.timestamp_valid = true;
    sof.ig_frame = 5006;
    sof.timestamp = 123999;
    sof.last_host_frame = 1001;
    CHECK(to_hex(message(ByteOrder::little, sof)) == "65180301003500808e1300005fe40100e903000000000000");
    CHECK(to_hex(message(ByteOrder::big, sof)) == "65180301003580000000138e0001e45f000003e900000000");
    cigi::EntityControl entity = ownship(47.2602, 11.3439, 1581.0);
    entity.type = 1;
    entity.roll = 5.0F;
    entity.pitch = -2.5F;
    entity.yaw = 270.0F;
    CHECK(to_hex(message(ByteOrder::little, entity)) ==
          "023000000100ff00010000000000a040000020c000008743a835cd3b4ea1474055302aa913b026400000000000b49840");
    CHECK(to_hex(message(ByteOrder::big, entity)) ==
          "023000000100ff000001000040a00000c0200000438700004047a14e3bcd35a84026b013a92a30554098b40000000000");
}

TEST_CASE("The byte order of a message is told by the byte swap field and its packets are read in it") {
    for (const ByteOrder order : kOrders) {
        const Bytes bytes = sound_message(order);
        const auto opened = cigi::open_message(bytes);
        const auto& m = std::get<cigi::Message>(opened);
        CHECK(m.format == cigi::Format(order));
        CHECK(m.ig_control.host_frame == 7);
        auto rest = m.packets;
        cigi::next_packet(rest);
        const auto packet = cigi::next_packet(rest);
        REQUIRE(packet.id == cigi::EntityControl::kId);
        CHECK(cigi::decode<cigi::EntityControl>(packet.bytes, order).latitude == 47.26);
        CHECK(cigi::packet_name(cigi::next_packet(rest).id) == "view_control");
        CHECK(cigi::packet_name(cigi::next_packet(rest).id) == "atmosphere_control");
        CHECK(rest.empty());
    }
}

TEST_CASE("IG Control of 16 bytes, as before 3.2, is read without the newer counter") {
    for (const ByteOrder order : kOrders) {
        cigi::IgControl ig = ig_control(77, 5);
        ig.minor_version = 0;
        ig.last_ig_frame.reset();
        const Bytes bytes = message(order, ig, ownship());
        CHECK(bytes.size() == 16 + 48);
        const auto opened = cigi::open_message(bytes);
        const auto& read = std::get<cigi::Message>(opened).ig_control;
        CHECK_FALSE(read.last_ig_frame.has_value());
        CHECK(read.minor_version == 0);
        CHECK(read.host_frame == 77);
    }
}

TEST_CASE("Packets that are not decoded are skipped by size and named") {
    const Bytes bytes = message(ByteOrder::little, ig_control(1)) + raw_packet(8, 32) + raw_packet(12, 56) +
                        raw_packet(30, 48) + raw_packet(201, 248, 0xFF) + raw_packet(255, 8) + raw_packet(77, 16, 0xFF);
    const auto opened = cigi::open_message(bytes);
    auto rest = std::get<cigi::Message>(opened).packets;
    std::vector<std::string_view> names;
    while (!rest.empty()) names.push_back(cigi::packet_name(cigi::next_packet(rest).id));
    CHECK(names == std::vector<std::string_view>{"ig_control", "rate_control", "weather_control",
                                                 "symbol_text_definition", "user", "user", "unknown"});
}

TEST_CASE("A message cut anywhere is sound only where a packet ends") {
    for (const ByteOrder order : kOrders) {
        const Bytes bytes = sound_message(order);
        for (std::size_t length = 0; length < bytes.size(); ++length) {
            INFO("cut to " << length << " bytes");
            const auto part = std::span(bytes).first(length);
            if (length == 24 || length == 72 || length == 104) {
                CHECK(is_sound(part));
            } else {
                CHECK(reason_of(part) == Reject::truncated);
            }
        }
    }
}

TEST_CASE("Endless packets, odd sizes and sizes that an id does not have are refused") {
    const Bytes first = message(ByteOrder::little, ig_control(1));
    CHECK(reason_of(first + Bytes(64)) == Reject::bad_size);
    CHECK(reason_of(first + raw_packet(77, 0) + Bytes(6)) == Reject::bad_size);
    CHECK(reason_of(first + raw_packet(77, 1) + Bytes(6)) == Reject::bad_size);
    CHECK(reason_of(first + raw_packet(77, 2) + Bytes(6)) == Reject::bad_size);
    CHECK(reason_of(first + raw_packet(77, 12) + Bytes(4)) == Reject::bad_size);
    CHECK(reason_of(first + raw_packet(2, 40)) == Reject::bad_size);
    CHECK(reason_of(first + raw_packet(2, 56)) == Reject::bad_size);
    CHECK(reason_of(first + raw_packet(8, 24)) == Reject::bad_size);
    CHECK(reason_of(first + raw_packet(2, 48) + raw_packet(0, 0)) == Reject::bad_size);
    Bytes endless_first = first;
    endless_first[1] = std::byte{0};
    CHECK(reason_of(endless_first) == Reject::bad_size);
    CHECK(is_sound(first + raw_packet(77, 248)));
    CHECK(reason_of(first + Bytes(1)) == Reject::truncated);
}

TEST_CASE("Messages that are not a CIGI host's are refused by what they are") {
    CHECK(reason_of({}) == Reject::truncated);
    CHECK(reason_of(message(ByteOrder::big, ownship())) == Reject::no_ig_control);
    CHECK(reason_of(message(ByteOrder::big, cigi::StartOfFrame{})) == Reject::start_of_frame);
    // Of 4.0, but with a size that tells no byte order.
    CHECK(reason_of(from_hex("2000000004000005e90300008d13000040e2010000000000")) == Reject::no_ig_control);
    CHECK(reason_of(from_hex("1800ffff040100058e1300005fe40100e903000000000000")) == Reject::start_of_frame);
    Bytes bytes = sound_message();
    bytes[2] = std::byte{2};
    CHECK(reason_of(bytes) == Reject::unknown_version);
    bytes[2] = std::byte{3};
    bytes[6] = std::byte{0x40};
    CHECK(reason_of(bytes) == Reject::bad_byte_order);
    CHECK(reason_of(from_hex("000000180000000000000000")) == Reject::no_ig_control);
}

TEST_CASE("No random or garbled datagram is read beyond its end, and what is taken as sound adds up") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const Bytes good = sound_message();
    std::size_t sound = 0;
    for (int i = 0; i < 200000; ++i) {
        // A heap block of exactly this size, so that the address sanitizer sees one byte too far.
        Bytes bytes = good;
        if (i % 2 == 0) {
            for (auto flips = 1 + random() % 4; flips > 0; --flips)
                bytes[random() % bytes.size()] ^= std::byte{1} << (random() % 8);
            bytes.resize(1 + random() % bytes.size());
        } else {
            bytes.resize(random() % 128);
            for (auto& b : bytes) b = static_cast<std::byte>(random());
            if (bytes.size() > 8) std::copy_n(good.begin(), random() % 9, bytes.begin());
        }
        bytes.shrink_to_fit();
        const auto opened = cigi::open_message(bytes);
        const auto* m = std::get_if<cigi::Message>(&opened);
        if (m == nullptr) continue;
        ++sound;
        std::size_t total = 0;
        for (auto rest = m->packets; !rest.empty();) total += cigi::next_packet(rest).bytes.size();
        REQUIRE(total == bytes.size());
    }
    CHECK(sound > 1000);
}
