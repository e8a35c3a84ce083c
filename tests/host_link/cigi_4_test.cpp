// Messages of CIGI 4.0 and what a session makes of them, beside those of 3.3.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "host_link/cigi.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

SessionOptions at_home(std::optional<cigi::Version> version = {}) {
    SessionOptions options;
    options.scene_origin = {{47.26}, {11.34}, 500.0};
    options.cigi_version = version;
    return options;
}

}  // namespace

TEST_CASE("IG Control and Start Of Frame of 4.0 match bytes laid out by hand in both byte orders") {
    cigi::IgControl ig;
    ig.minor_version = 0;
    ig.host_frame = 1001, ig.last_ig_frame = 5005, ig.timestamp = 123456;
    ig.mode = cigi::IgMode::operate, ig.timestamp_valid = true;
    CHECK(to_hex(message(kLittle4, ig)) == "1800000004000005e90300008d13000040e2010000000000");
    CHECK(to_hex(message(kBig4, ig)) == "0018000004000005000003e90000138d0001e24000000000");
    cigi::StartOfFrame sof;
    sof.minor_version = 0, sof.database = 1, sof.mode = cigi::IgMode::operate, sof.timestamp_valid = true;
    sof.ig_frame = 5006, sof.timestamp = 123999, sof.last_host_frame = 1001;
    CHECK(to_hex(message(kLittle4, sof)) == "1800ffff040100058e1300005fe40100e903000000000000");
    for (const auto& bytes : {message(kLittle4, ig), message(kBig4, ig)}) {
        const auto opened = cigi::open_message(bytes);
        REQUIRE(std::holds_alternative<cigi::Message>(opened));
        const auto& read = std::get<cigi::Message>(opened);
        CHECK(read.format.version == cigi::Version::four);
        CHECK(read.ig_control.host_frame == 1001);
        CHECK(read.ig_control.timestamp == 123456);
        CHECK(cigi::looks_like_host_message(bytes));
    }
    const auto reason = [](const Bytes& bytes) { return std::get<Reject>(cigi::open_message(bytes)); };
    CHECK(reason(message(kBig4, sof)) == Reject::start_of_frame);
    CHECK_FALSE(cigi::looks_like_host_message(message(kBig4, sof)));
}

namespace {

cigi::IgControl ig_control_4(std::uint32_t frame) {
    auto ig = ig_control(frame, frame * 1667);
    ig.minor_version = 0;
    return ig;
}

/// Of 4.0 and of any size.
Bytes raw_4(cigi::Format format, std::uint16_t id, std::uint16_t size, std::size_t there) {
    Bytes bytes(std::max<std::size_t>(there, 4));
    store(bytes, 0, format.order, size);
    store(bytes, 2, format.order, id);
    return bytes;
}

/// A pose that both versions tell.
struct BothHosts {
    Session three{at_home()}, four{at_home()};
    std::uint32_t frame = 0;
    void send(const cigi::EntityControl& entity, ByteOrder order, Time now) {
        three.accept(message(order, ig_control(frame, frame * 1667), entity), now);
        const cigi::Format format{order, cigi::Version::four};
        four.accept(message(format, ig_control_4(frame), entity, static_cast<const cigi::EntityPosition&>(entity)),
                    now);
        ++frame;
    }
};

}  // namespace

TEST_CASE("4.0's packets without a use here are skipped by size and named, and odd sizes are refused") {
    for (const cigi::Format format : {kLittle4, kBig4}) {
        const Bytes first = message(format, ig_control_4(1));
        const Bytes all = first + raw_4(format, 0x0026, 16, 16) + raw_4(format, 0x0023, 96, 96) +
                          raw_4(format, 0x1234, 320, 320) + raw_4(format, 0xABCD, 8, 8) + raw_4(format, 0x0500, 8, 8);
        const auto opened = cigi::open_message(all);
        auto rest = std::get<cigi::Message>(opened).packets;
        std::vector<std::string_view> names;
        while (!rest.empty()) names.push_back(cigi::packet_name(next_packet(rest, format).id));
        CHECK(names == std::vector<std::string_view>{"ig_control", "animation_control",
                                                     "symbol_textured_circle_definition", "user", "user", "unknown"});
        for (std::size_t length = 0; length < all.size(); ++length) {
            const bool whole = length == 24 || length == 40 || length == 136 || length == 456 || length == 464;
            CHECK(std::holds_alternative<cigi::Message>(cigi::open_message(std::span(all).first(length))) == whole);
        }
        const auto reason = [](const Bytes& bytes) { return std::get<Reject>(cigi::open_message(bytes)); };
        CHECK(reason(first + raw_4(format, 0x1234, 0, 8)) == Reject::bad_size);
        CHECK(reason(first + raw_4(format, 0x1234, 12, 16)) == Reject::bad_size);
        CHECK(reason(first + raw_4(format, 0x0001, 40, 48)) == Reject::bad_size);
        CHECK(reason(first + raw_4(format, 0x1234, 65528, 8)) == Reject::truncated);
    }
    for (cigi::Kind kind = 0; kind < cigi::kKinds; ++kind)
        if (const auto id = cigi::id_in_4(kind)) CHECK(cigi::kind_in_4(*id) == kind);
}

TEST_CASE("A 4.0 host gives the very pose that a 3.3 host gives, and the same rules hold for its frame numbers") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> near(-0.5, 0.5);
    BothHosts hosts;
    for (int i = 0; i < 200; ++i) {
        auto entity = ownship(47.26 + near(random), 11.34 + near(random), 900.0 + 500.0 * near(random));
        entity.yaw = static_cast<float>(720.0 * near(random));
        entity.pitch = static_cast<float>(180.0 * near(random));
        entity.smoothing = random() % 2 == 0;
        if (i % 3 == 0) entity.entity = 7, entity.type = 3;
        hosts.send(entity, random() % 2 == 0 ? ByteOrder::little : ByteOrder::big, i * 16ms);
        if (random() % 10 == 0) ++hosts.frame;
        const HostState &a = hosts.three.state(), &b = hosts.four.state();
        REQUIRE(a.pose.has_value() == b.pose.has_value());
        if (!a.pose) continue;
        CHECK(a.pose->pose.position.metres == b.pose->pose.position.metres);
        CHECK(a.pose->pose.eye_from_scene == b.pose->pose.eye_from_scene);
        CHECK(a.pose->source_time == b.pose->source_time);
        CHECK(a.smoothing == b.smoothing);
        CHECK(a.entities.size() == b.entities.size());
    }
    CHECK(hosts.three.statistics().lost > 0);
    CHECK(hosts.four.statistics().lost == hosts.three.statistics().lost);
    CHECK(hosts.four.statistics().frames == hosts.three.statistics().frames);
    CHECK(hosts.four.statistics().rejected_in_all() == 0);
    // The same number with the same bytes is a duplicate, with others a host that counts anew.
    hosts.frame = 5;
    auto entity = ownship();
    hosts.send(entity, ByteOrder::big, 9s);
    CHECK(hosts.four.statistics().restarts + hosts.four.statistics().reordered ==
          hosts.three.statistics().restarts + hosts.three.statistics().reordered);
    CHECK(packets_by_name(hosts.four.statistics())[1].first == "entity_control");
    CHECK(packets_by_name(hosts.four.statistics())[2].first == "entity_position");
}

TEST_CASE("4.0's seconds are the sun's, and its smoothing bit counts at any minor version") {
    Session session{SessionOptions{}};
    cigi::CelestialSphereControl sky;
    sky.date_time_valid = true;
    sky.hour = 12, sky.minute = 30, sky.seconds = 17.0F, sky.date = 2282024;
    auto entity = ownship();
    entity.smoothing = true;
    auto ig = ig_control_4(1);
    ig.smoothing = true;
    session.accept(message(kBig4, ig, entity, sky), 0ms);
    CHECK(session.state().utc->second == 17.0);
    CHECK(session.state().smoothing);
    sky.seconds = 60.0F;
    session.accept(message(kBig4, ig_control_4(2), sky), 0ms);
    CHECK(session.statistics().rejected_for(Reject::out_of_range) == 1);
}

TEST_CASE("Start Of Frame of 4.0 tells a missed deadline, and a version that was not asked for is refused") {
    for (const cigi::Format format : {kLittle4, kBig4}) {
        Session session{SessionOptions{}};
        session.accept(message(format, ig_control_4(77)), 0ms);
        for (const bool overframing : {false, true}) {
            Bytes bytes(24);
            REQUIRE(start_of_frame(*session.reply_context(), 3, 10us, overframing,
                                   std::span<std::byte, 24>(bytes.data(), 24)) == 24);
            const auto sof = cigi::decode<cigi::StartOfFrame>(bytes, format);
            CHECK(sof.last_host_frame == 77U);
            CHECK(sof.conditions == (overframing ? 0x0100 : 0));
            CHECK(bytes[4] == std::byte{4});
        }
    }
    Session three{at_home(cigi::Version::three)}, four{at_home(cigi::Version::four)};
    const Bytes old = message(ByteOrder::big, ig_control(1), ownship()), young = message(kBig4, ig_control_4(1));
    CHECK(three.accept(old, 0ms) == Verdict::pose);
    CHECK(three.accept(young, 0ms) == Verdict::rejected);
    CHECK(four.accept(old, 0ms) == Verdict::rejected);
    CHECK(four.accept(young, 0ms) == Verdict::no_pose);
    CHECK(three.statistics().rejected_for(Reject::unknown_version) == 1);
    CHECK(four.statistics().rejected_for(Reject::unknown_version) == 1);
}

TEST_CASE("Garbled 4.0 messages are taken or refused, never worse, and leave finite numbers") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    Session session{SessionOptions{}};
    std::size_t taken = 0;
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const cigi::Format format = i % 2 == 0 ? kLittle4 : kBig4;
        Bytes bytes = message(format, ig_control_4(i), cigi::EntityControl{}, cigi::EntityPosition{},
                              cigi::RateControl{}, cigi::ViewControl{}, cigi::ViewDefinition{},
                              cigi::CelestialSphereControl{}, cigi::AtmosphereControl{}, cigi::WeatherControl{});
        for (std::size_t b = 24; b < bytes.size(); ++b)
            if (bytes[b] == std::byte{0} && random() % 8 == 0) bytes[b] = static_cast<std::byte>(random());
        if (random() % 4 == 0) bytes.resize(random() % bytes.size());
        bytes.shrink_to_fit();
        taken += session.accept(bytes, i * 1ms) != Verdict::rejected;
        if (session.state().pose)
            REQUIRE(std::isfinite(glm::dot(session.state().pose->pose.position.metres, glm::dvec3(1.0))));
    }
    CHECK(taken > 50);
}
