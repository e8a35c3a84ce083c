// Weather, components and view groups, and what a CIGI host is told without asking: collisions, sensors, warnings.
#include <catch2/catch.hpp>
#include <limits>

#include "host_link/cigi_query.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

/// The plane Z = 0, and nothing else.
std::optional<SurveyHit> flat_ground(const SurveyLine& line) {
    const double distance = -line.from.metres.z / line.direction.z;
    if (!(distance > line.least && distance <= line.most)) return std::nullopt;
    return SurveyHit{distance, {line.from.metres + distance * line.direction}, {0.0, 0.0, 1.0}, 7};
}

struct Host {
    Session session{[] {
        SessionOptions options;
        options.scene_origin = {{47.26}, {11.34}, 500.0};
        options.surveyor = flat_ground;
        options.entity_types = {3};
        options.cloud_decks = 1;
        return options;
    }()};
    std::uint32_t frame = 0;
    Time now = 0ms;
    cigi::Version version = cigi::Version::three;
    template <class... P>
    const HostState& send(const P&... packets) {
        const cigi::Format format{frame % 2 == 0 ? ByteOrder::big : ByteOrder::little, version};
        session.accept(message(format, ig_control(frame), packets...), now);
        ++frame;
        now += 16ms;
        return session.state();
    }
    /// The answer of the newest message, which is the only one.
    template <class P>
    P told() {
        REQUIRE(session.responses().size() == 1);
        const auto& response = session.responses()[0];
        const auto bytes = std::span(response.bytes).first(response.size);
        const cigi::Format format{frame % 2 == 1 ? ByteOrder::big : ByteOrder::little, version};
        auto rest = bytes;
        REQUIRE(next_packet(rest, format).id == P::kId);
        REQUIRE(rest.empty());
        return cigi::decode<P>(bytes, format);
    }
    [[nodiscard]] std::size_t answers() const { return session.responses().size(); }
    /// Of a warning; empty where there is none.
    [[nodiscard]] std::string text() const {
        if (session.responses().empty() || session.responses()[0].bytes[0] != std::byte{cigi::IgMessage::kId})
            return {};
        return reinterpret_cast<const char*>(session.responses()[0].bytes.data() + 4);
    }
    [[nodiscard]] std::uint64_t refused() const { return session.statistics().rejected_for(Reject::out_of_range); }
};

cigi::EntityControl level_flight(double altitude, bool detects = true) {
    auto entity = ownship(47.26, 11.34, altitude);
    entity.collision_detection = detects;
    return entity;
}

/// From the belly 10 m down.
constexpr cigi::CollisionSegmentDefinition kBelow{.segment = 4, .enable = true, .to = {0.0F, 0.0F, 10.0F}};

}  // namespace

TEST_CASE("Layers of weather are the host's, in heights of the scene; all other kinds of weather are left alone") {
    Host host;
    cigi::WeatherControl layer{
        .layer = 1, .enable = true, .visibility = 80.0F, .coverage = 40.0F, .base = 2500.0F, .thickness = 300.0F};
    const auto deck = host.send(layer).weather[1].value();
    CHECK(deck.enabled);
    CHECK(deck.base == 2000.0);
    CHECK(deck.top == 2300.0);
    CHECK(deck.coverage == Approx(0.4));
    CHECK(deck.visibility == 80.0);
    layer.layer = 0, layer.enable = false;
    CHECK_FALSE(host.send(layer).weather[0]->enabled);
    layer.enable = true;
    for (const auto scope : {cigi::WeatherScope::regional, cigi::WeatherScope::entity}) {
        layer.scope = scope;
        CHECK_FALSE(host.send(layer).weather[0]->enabled);
    }
    layer.scope = cigi::WeatherScope::global, layer.layer = 9;
    CHECK(host.send(layer).weather[9]->base == 2000.0);
    layer.layer = 10;
    host.send(layer);
    CHECK(host.refused() == 0);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::uint64_t refused = 0;
    for (float cigi::WeatherControl::*field : {&cigi::WeatherControl::base, &cigi::WeatherControl::thickness,
                                               &cigi::WeatherControl::coverage, &cigi::WeatherControl::visibility})
        for (const float bad : {nan, -2e4F}) {
            auto wrong = layer;
            wrong.layer = 1, wrong.*field = bad;
            CHECK(host.send(wrong).weather[1]->base == 2000.0);
            CHECK(host.refused() == ++refused);
        }
}

TEST_CASE("The system's components 1 and 2 are the test pattern and the overlay, and no others are anything") {
    for (const auto version : {cigi::Version::three, cigi::Version::four}) {
        Host host;
        host.version = version;
        CHECK_FALSE(host.send().overlay.has_value());
        cigi::ShortComponentControl component{.component = 1, .component_class = 13, .state = 1};
        CHECK(host.send(component).test_pattern);
        component.component_class = 12, component.state = 0;
        CHECK(host.send(component).test_pattern);
        component.component_class = 13, component.component = 2;
        CHECK(host.send(component).overlay == false);
        component.component = 3, component.state = 1;
        CHECK(host.send(component).overlay == false);
        component.component = 1, component.state = 0;
        CHECK_FALSE(host.send(component).test_pattern);
    }
    // Of 3.3, by hand: tshark does not show the data as numbers.
    const cigi::ShortComponentControl p{
        .component = 0x0102, .instance = 0x0304, .component_class = 13, .state = 6, .data = {0x0708090A, 0x0B0C0D0E}};
    CHECK(to_hex(message(ByteOrder::big, p)) ==
          "0510010203040d06"
          "0708090a0b0c0d0e");
}

TEST_CASE("View Control of a group counts for our view once its definition has put it there") {
    Host host;
    cigi::ViewControl control{.view = 99, .group = 5, .yaw_enable = true, .yaw = 25.0F};
    host.send(cigi::ViewDefinition{.view = 1});
    CHECK_FALSE(host.send(control).mount.has_value());
    host.send(cigi::ViewDefinition{.view = 1, .group = 5});
    CHECK(host.send(control).mount->attitude.heading.value == 25.0);
    control.group = 6, control.yaw = 50.0F;
    CHECK(host.send(control).mount->attitude.heading.value == 25.0);
    host.send(cigi::ViewDefinition{.view = 2, .group = 6});
    CHECK(host.send(control).mount->attitude.heading.value == 25.0);
}

TEST_CASE("A collision segment is told of in every frame in which it meets something, and in no other") {
    for (const auto version : {cigi::Version::three, cigi::Version::four}) {
        Host host;
        host.version = version;
        const auto fly = [&](double altitude, bool detects = true) {
            const auto entity = level_flight(altitude, detects);
            if (version == cigi::Version::three) return host.send(entity);
            return host.send(entity, static_cast<const cigi::EntityPosition&>(entity));
        };
        fly(520.0);
        host.send(kBelow);
        CHECK(host.answers() == 0);
        for (const double height : {9.5, 4.0, 1.0}) {
            fly(500.0 + height);
            const auto hit = host.told<cigi::CollisionSegmentNotification>();
            CHECK(hit.segment == 4);
            CHECK(hit.distance == Approx(height).margin(1e-3));
            CHECK(hit.material == 7);
            CHECK_FALSE(hit.with_entity);
        }
        host.send();
        CHECK(host.told<cigi::CollisionSegmentNotification>().distance == Approx(1.0).margin(1e-3));
        fly(504.0, false);
        CHECK(host.answers() == 0);
        auto off = kBelow;
        off.enable = false;
        host.send(off);
        fly(504.0);
        CHECK(host.answers() == 0);
    }
}

TEST_CASE("Collision segments ride on any entity, are few, and are refused where they are no line") {
    Host host;
    auto entity = level_flight(503.0);
    entity.entity = 6, entity.type = 3;
    auto below = kBelow;
    below.entity = 6;
    host.send(entity, below);
    CHECK(host.told<cigi::CollisionSegmentNotification>().entity == 6);
    below.to = below.from;
    host.send(below);
    below.to = {std::numeric_limits<float>::quiet_NaN(), 0.0F, 1.0F};
    host.send(below);
    CHECK(host.refused() == 2);
    for (int i = 0; i < 100; ++i) {
        auto more = kBelow;
        more.entity = 6, more.segment = static_cast<std::uint8_t>(i);
        host.send(more);
    }
    CHECK(host.answers() == Session::kMostSegments);
    CHECK(host.session.statistics().answers_dropped == 100 - Session::kMostSegments);
}

TEST_CASE("A sensor is answered once where it does not track, and in every frame while it does") {
    for (const auto version : {cigi::Version::three, cigi::Version::four}) {
        Host host;
        host.version = version;
        cigi::SensorControl sensor{.view = 300, .sensor = 2, .on = true};
        host.send(sensor);
        const auto response = host.told<cigi::SensorResponse>();
        CHECK(response.view == 300);
        CHECK(response.sensor == 2);
        CHECK(response.status == 0);
        CHECK(response.host_frame == 0);
        host.send();
        CHECK(host.answers() == 0);
        sensor.track_mode = 3;
        host.send(sensor);
        for (std::uint32_t i = 3; i < 6; ++i) {
            host.send();
            CHECK(host.told<cigi::SensorResponse>().host_frame == i);
        }
        sensor.extended_response = true;
        host.send(sensor);
        for (std::uint32_t i = 7; i < 9; ++i) {
            host.send();
            const auto extended = host.told<cigi::SensorExtendedResponse>();
            CHECK(extended.view == 300);
            CHECK(extended.sensor == 2);
            CHECK(extended.host_frame == i);
            CHECK((extended.status == 0 && !extended.entity_valid));
        }
        sensor.on = false;
        host.send(sensor);
        CHECK(host.answers() == 1);
        host.send();
        CHECK(host.answers() == 0);
    }
}

TEST_CASE(
    "A host is warned in words of what it may not have meant, and not more than once in ten seconds of the same") {
    Host host;
    auto entity = level_flight(1000.0, false);
    entity.entity = 6, entity.type = 3;
    host.send(entity);
    CHECK(host.answers() == 0);
    entity.type = 44;
    host.send(entity);
    CHECK(host.text() == "no model for entity 6, type 44");
    host.send(entity);
    CHECK(host.answers() == 0);
    host.now += 10s;
    host.send(entity);
    CHECK(host.text() == "no model for entity 6, type 44");
    host.send(cigi::ViewControl{.view = 1, .entity = 9});
    CHECK(host.text() == "view 1 is on entity 9, which is unknown");
    entity.attached = true, entity.parent = 6, entity.type = 3;
    entity.latitude = entity.longitude = entity.altitude = 0.0;
    host.send(entity);
    CHECK(host.text() == "entity 6 cannot hang on entity 6: loop, or too deep");
    host.send(cigi::WeatherControl{.layer = 1});
    CHECK(host.answers() == 0);
    host.send(cigi::WeatherControl{.layer = 2});
    CHECK(host.text() == "the scene has no cloud deck 2");
    host.send(ownship(49.26));
    CHECK(host.text() == "view is 222 km from the scene's origin");
    host.send(ownship(49.27));
    CHECK(host.answers() == 0);
}
