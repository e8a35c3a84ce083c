// Views, environment and the answer to the host.
#include <catch2/catch.hpp>

#include "host_link/geodesy.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

struct ViewHost {
    Session session;
    std::uint32_t frame = 0;
    Time now = 0ms;
    explicit ViewHost(SessionOptions options = {}) : session(options) {}
    template <class... P>
    const HostState& send(const P&... packets) {
        session.accept(
            message(frame % 2 == 0 ? ByteOrder::big : ByteOrder::little, ig_control(frame, frame), packets...), now);
        ++frame;
        return session.state();
    }
    std::uint64_t refused() { return session.statistics().rejected_for(Reject::out_of_range); }
};

cigi::ViewControl full_view_control(std::uint16_t view) {
    cigi::ViewControl p;
    p.view = view;
    p.x_enable = p.y_enable = p.z_enable = p.roll_enable = p.pitch_enable = p.yaw_enable = true;
    p.x = 3.0F;
    p.y = -0.5F;
    p.z = -1.2F;
    p.yaw = 30.0F;
    p.pitch = -4.0F;
    p.roll = 1.0F;
    return p;
}

cigi::ViewDefinition full_view_definition(std::uint16_t view) {
    cigi::ViewDefinition p;
    p.view = view;
    p.left_enable = p.right_enable = p.top_enable = p.bottom_enable = true;
    p.left = -40.0F;
    p.right = 20.0F;
    p.top = 15.0F;
    p.bottom = -10.0F;
    return p;
}

cigi::CelestialSphereControl noon() {
    cigi::CelestialSphereControl p;
    p.date_time_valid = true;
    p.hour = 12;
    p.minute = 30;
    p.date = 2282024;
    return p;
}

}  // namespace

TEST_CASE("View Control's body axes become the mount's: forward, right, down to right, forward, up") {
    ViewHost host;
    const ViewMount mount = host.send(full_view_control(1)).mount.value();
    CHECK(mount.offset.x == -0.5);
    CHECK(mount.offset.y == 3.0);
    CHECK(mount.offset.z == Approx(1.2).epsilon(1e-7));
    CHECK(mount.attitude.heading.value == 30.0);
    CHECK(mount.attitude.pitch.value == -4.0);
    CHECK(mount.attitude.roll.value == 1.0);
}

TEST_CASE("View Control changes only what it enables") {
    ViewHost host;
    host.send(full_view_control(1));
    cigi::ViewControl yaw_only;
    yaw_only.view = 1;
    yaw_only.yaw_enable = true;
    yaw_only.yaw = 99.0F;
    yaw_only.x = 50.0F;
    const ViewMount mount = host.send(yaw_only).mount.value();
    CHECK(mount.attitude.heading.value == 99.0);
    CHECK(mount.offset.y == 3.0);
    CHECK(mount.attitude.pitch.value == -4.0);
}

TEST_CASE("Ours is the view that was asked for, or the first one that the host names") {
    ViewHost first;
    first.send(full_view_control(4));
    first.send(full_view_definition(5));
    CHECK(first.session.state().mount.has_value());
    CHECK_FALSE(first.session.state().window.has_value());
    SessionOptions options;
    options.view = 5;
    ViewHost asked(options);
    asked.send(full_view_control(4));
    asked.send(full_view_definition(5));
    CHECK_FALSE(asked.session.state().mount.has_value());
    CHECK(asked.session.state().window.has_value());
}

TEST_CASE("View groups are not followed, and a view on an entity that nobody named is counted") {
    ViewHost host;
    auto group = full_view_control(1);
    group.group = 3;
    CHECK_FALSE(host.send(group).mount.has_value());
    auto elsewhere = full_view_control(1);
    elsewhere.entity = 12;
    CHECK_FALSE(host.send(elsewhere).mount.has_value());
    CHECK(host.session.statistics().rejected_for(Reject::view_of_unknown_entity) == 1);
}

TEST_CASE("View Definition sets the window; its flags enable each angle by itself") {
    ViewHost host;
    const ViewWindow window = host.send(full_view_definition(1)).window.value();
    CHECK(window.left.value == -40.0);
    CHECK(window.right.value == 20.0);
    CHECK(window.top.value == 15.0);
    CHECK(window.bottom.value == -10.0);
    cigi::ViewDefinition right;
    right.view = 1;
    right.right_enable = true;
    right.right = 35.0F;
    right.left = 5.0F;
    CHECK(host.send(right).window->right.value == 35.0);
    CHECK(host.session.state().window->left.value == -40.0);
}

TEST_CASE("A View Definition of some angles waits for the others, or takes them from the default window") {
    cigi::ViewDefinition sides;
    sides.left_enable = sides.right_enable = true;
    sides.left = -10.0F;
    sides.right = 10.0F;
    ViewHost bare;
    CHECK_FALSE(bare.send(sides).window.has_value());
    SessionOptions options;
    options.default_window = ViewWindow{{-30.0}, {30.0}, {20.0}, {-20.0}};
    ViewHost filled(options);
    CHECK_FALSE(filled.send(cigi::ViewDefinition{}).window.has_value());
    CHECK(filled.send(sides).window->top.value == 20.0);
    CHECK(filled.session.state().window->right.value == 10.0);
}

TEST_CASE("Windows that cannot be drawn are refused as a whole") {
    ViewHost host;
    auto crossed = full_view_definition(1);
    crossed.left = 25.0F;
    CHECK_FALSE(host.send(crossed).window.has_value());
    auto wide = full_view_definition(1);
    wide.top = 90.0F;
    CHECK_FALSE(host.send(wide).window.has_value());
    auto nan = full_view_definition(1);
    nan.bottom = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(host.send(nan).window.has_value());
    CHECK(host.refused() == 3);
}

TEST_CASE("Visibility is the atmosphere's, never negative and never zero") {
    ViewHost host;
    cigi::AtmosphereControl air;
    air.visibility = 12500.0F;
    CHECK(host.send(air).visibility == 12500.0);
    air.visibility = -1.0F;
    CHECK(host.send(air).visibility == 12500.0);
    air.visibility = std::numeric_limits<float>::infinity();
    CHECK(host.send(air).visibility == 12500.0);
    CHECK(host.refused() == 2);
    air.visibility = 0.0F;
    CHECK(host.send(air).visibility == 1.0);
}

TEST_CASE("Date and time are the host's; without ephemeris they stand, with it they run over midnight and leap days") {
    ViewHost host;
    auto sky = noon();
    sky.hour = 23;
    sky.minute = 59;
    host.send(sky);
    host.now = 90s;
    CivilTime utc = host.send().utc.value();
    CHECK(utc.year == 2024);
    CHECK(utc.day == 28);
    CHECK(utc.minute == 59);
    CHECK(utc.second == 0.0);
    sky.ephemeris = true;
    host.send(sky);
    host.now += 90s;
    utc = host.send().utc.value();
    CHECK(utc.month == 2);
    CHECK(utc.day == 29);
    CHECK(utc.hour == 0);
    CHECK(utc.minute == 0);
    CHECK(utc.second == 30.0);
    // The same packet again does not set the clock back.
    CHECK(host.send(sky).utc->second == 30.0);
}

TEST_CASE("Dates that are not valid, or not in the calendar, are not taken") {
    ViewHost host;
    auto sky = noon();
    sky.date_time_valid = false;
    CHECK_FALSE(host.send(sky).utc.has_value());
    CHECK(host.refused() == 0);
    for (const std::uint32_t bad : {2302024U, 2292023U, 13012024U, 2024U, 0U, 4000000000U, 268152020U}) {
        sky = noon();
        sky.date = bad;
        CHECK_FALSE(host.send(sky).utc.has_value());
    }
    sky = noon();
    sky.hour = 24;
    CHECK_FALSE(host.send(sky).utc.has_value());
    CHECK(host.refused() == 8);
}

TEST_CASE("The host's mode is followed") {
    for (const auto& [wire, mode] : {std::pair{cigi::IgMode::standby, Mode::standby},
                                     {cigi::IgMode::operate, Mode::operate},
                                     {cigi::IgMode::debug, Mode::debug}}) {
        Session session(SessionOptions{});
        auto ig = ig_control(0);
        ig.mode = wire;
        session.accept(message(ByteOrder::big, ig), 0ms);
        CHECK(session.state().mode == mode);
    }
}

TEST_CASE("Start Of Frame answers in the host's byte order and version, with both frame numbers") {
    for (const ByteOrder order : {ByteOrder::little, ByteOrder::big}) {
        Session session(SessionOptions{});
        CHECK_FALSE(session.reply_context().has_value());
        auto ig = ig_control(4711);
        session.accept(message(order, ig), 0ms);
        std::array<std::byte, cigi::StartOfFrame::kSize> bytes{};
        REQUIRE(start_of_frame(session.reply_context().value(), 99, 123450us, false, bytes) == 24);
        const auto sof = cigi::decode<cigi::StartOfFrame>(bytes, order);
        CHECK(sof.ig_frame == 99);
        CHECK(sof.last_host_frame == 4711U);
        CHECK(sof.timestamp == 12345);
        CHECK(sof.timestamp_valid);
        CHECK(sof.mode == cigi::IgMode::operate);
        CHECK(sof.minor_version == 3);
        CHECK(sof.database == 0);
        CHECK(load<std::uint16_t>(bytes, 6, order) == 0x8000);

        ig.last_ig_frame.reset();
        ig.minor_version = 0;
        session.accept(message(order, ig), 0ms);
        CHECK(start_of_frame(session.reply_context().value(), 99, 0ms, false, bytes) == 16);
    }
}

TEST_CASE("Start Of Frame's minor version is one of its size, whatever a host's IG Control claims") {
    for (const int claimed : {0, 1, 2, 3, 15}) {
        for (const bool since_32 : {true, false}) {
            INFO("minor version " << claimed << (since_32 ? " in 24 bytes" : " in 16 bytes"));
            Session session(SessionOptions{});
            auto ig = ig_control(1);
            ig.minor_version = static_cast<std::uint8_t>(claimed);
            if (!since_32) ig.last_ig_frame.reset();
            session.accept(message(ByteOrder::little, ig), 0ms);
            std::array<std::byte, cigi::StartOfFrame::kSize> bytes{};
            const std::size_t size = start_of_frame(session.reply_context().value(), 7, 0ms, false, bytes);
            CHECK(size == (since_32 ? 24 : 16));
            const int told = std::to_integer<int>(bytes[5]) >> 4;
            CHECK(told == (since_32 ? std::max(claimed, 2) : std::min(claimed, 1)));
        }
    }
}

TEST_CASE("A database is told as loading until the host has taken notice, then as loaded, and another is not there") {
    for (const auto available : {std::optional<std::int8_t>(), std::optional<std::int8_t>(3)}) {
        SessionOptions options;
        options.database = available;
        Session session(options);
        std::uint32_t frame = 0;
        const auto told = [&](int wanted) {
            auto ig = ig_control(++frame);
            ig.database = static_cast<std::int8_t>(wanted);
            session.accept(message(ByteOrder::big, ig), 0ms);
            return int{session.reply_context()->database};
        };
        CHECK(told(0) == 0);
        CHECK(told(3) == -3);
        CHECK(told(0) == 3);
        CHECK(told(0) == 3);
        CHECK(told(3) == 3);
        CHECK(told(5) == (available ? -128 : -5));
        // A host that goes on asking gets there as well.
        CHECK(told(5) == (available ? -128 : 5));
        CHECK(told(0) == (available ? 3 : 5));
        CHECK(told(3) == (available ? 3 : -3));
        CHECK(told(5) == (available ? -128 : -5));
        CHECK(session.statistics().rejected_in_all() == 0);
        told(-3);
        CHECK(session.statistics().rejected_for(Reject::out_of_range) == 1);
    }
}

TEST_CASE("A host that goes to standby has everything that it put there taken away, but where it is") {
    ViewHost host;
    cigi::EntityControl other = ownship(47.3);
    other.entity = 9, other.type = 2;
    const cigi::WeatherControl fog{.enable = true, .visibility = 90.0F, .coverage = 100.0F, .thickness = 100.0F};
    cigi::WeatherControl regional = fog;
    regional.scope = cigi::WeatherScope::regional;
    const cigi::ShortComponentControl pattern{.component = 1, .component_class = 13, .state = 1};
    host.send(ownship(47.2), other, fog, regional, noon(), cigi::AtmosphereControl{.visibility = 900.0F}, pattern,
              cigi::ViewDefinition{.view = 4, .group = 2, .left_enable = true, .left = -9.0F},
              cigi::ViewControl{.view = 4, .yaw_enable = true, .entity = 9, .yaw = 20.0F});
    auto ig = ig_control(1000);
    ig.mode = cigi::IgMode::standby;
    host.session.accept(message(ByteOrder::big, ig), 30s);
    const HostState& state = host.session.state();
    CHECK(state.mode == Mode::standby);
    CHECK(state.pose->position.latitude.value == 47.2);
    CHECK(state.entities.empty());
    CHECK_FALSE((state.mount || state.window || state.view_entity || state.visibility || state.utc ||
                 state.weather[0] || state.test_pattern));
    CHECK(state.regions.empty());
    // What comes in standby stays, and another view may be ours.
    ig.host_frame = 1001;
    host.session.accept(
        message(ByteOrder::big, ig, other, cigi::ViewControl{.view = 5, .yaw_enable = true, .yaw = 3.0F}), 31s);
    ig.host_frame = 1002, ig.mode = cigi::IgMode::operate;
    host.session.accept(message(ByteOrder::big, ig), 32s);
    CHECK(host.session.state().entities.size() == 1);
    CHECK(host.session.state().mount->attitude.heading.value == 3.0);
}

TEST_CASE("In synchronous operation nothing is smoothed, whatever the host asks for") {
    for (const bool synchronous : {false, true}) {
        SessionOptions options;
        options.synchronous = synchronous;
        Session session(options);
        auto ig = ig_control(1);
        ig.smoothing = true;
        auto other = ownship(47.3);
        other.entity = 9;
        auto own = ownship(47.2);
        own.smoothing = other.smoothing = true;
        session.accept(message(ByteOrder::big, ig, own, other), 0ms);
        CHECK(session.state().smoothing == !synchronous);
        CHECK(session.state().entities.find(9)->smoothing == !synchronous);
    }
}

TEST_CASE("The entity that carries the eye is the one asked for") {
    SessionOptions options;
    options.ownship = 9;
    Session session(options);
    auto entity = ownship(10.0);
    entity.entity = 9;
    session.accept(message(ByteOrder::little, ig_control(0), ownship(20.0), entity, ownship(30.0)), 0ms);
    CHECK(session.state().pose->position.latitude.value == 10.0);
    REQUIRE(session.state().entities.find(0) != nullptr);
    CHECK(session.state().entities.find(0)->active);
    CHECK(session.state().ownship == 9);
}
