// Entities: where their packets, their rates and their parents put them.
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "host_link/entity_motion.h"
#include "host_link/geodesy.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

SessionOptions at_home() {
    SessionOptions options;
    options.scene_origin = {{47.26}, {11.34}, 500.0};
    return options;
}

struct EntityHost {
    Session session{at_home()};
    std::uint32_t frame = 0;
    Time now = 0ms;
    template <class... P>
    void send(const P&... packets) {
        session.accept(message(ByteOrder::big, ig_control(frame++), packets...), now);
    }
    [[nodiscard]] const EntityList& entities() const { return session.state().entities; }
    [[nodiscard]] std::optional<ScenePose> pose(std::uint16_t id, Time at) const { return pose_of(entities(), id, at); }
    [[nodiscard]] std::uint64_t refused(Reject reason) const { return session.statistics().rejected_for(reason); }
    [[nodiscard]] long shown() const {
        return std::count_if(entities().begin(), entities().end(), [&](const Entity& e) {
            return e.id != session.state().ownship && is_shown(entities(), e);
        });
    }
};

cigi::EntityControl entity(std::uint16_t id, double latitude = 47.26) {
    auto packet = ownship(latitude);
    packet.entity = id, packet.type = 12;
    return packet;
}

cigi::EntityControl hung(std::uint16_t id, std::uint16_t parent, double forward = 0, double right = 0,
                         double down = 0) {
    cigi::EntityControl packet;
    packet.entity = id, packet.parent = parent, packet.attached = true;
    packet.latitude = forward, packet.longitude = right, packet.altitude = down;
    return packet;
}

/// Of a chain that begins with 1.
constexpr std::uint16_t kDeepest = 1 + kDeepestAttachment;

double apart(const ScenePose& a, const ScenePose& b) { return glm::distance(a.position.metres, b.position.metres); }
double turned(const ScenePose& a, const ScenePose& b) {
    double most = 0.0;
    for (int c = 0; c < 3; ++c) most = std::max(most, glm::distance(a.eye_from_scene[c], b.eye_from_scene[c]));
    return most;
}

}  // namespace

TEST_CASE("Entities are where their newest packets have them, and shown while they are active") {
    EntityHost host;
    auto other = entity(7, 47.001);
    other.yaw = 90.0F;
    host.send(other);
    REQUIRE(host.shown() == 1);
    const Entity& known = *host.entities().find(7);
    CHECK(known.type == 12);
    const auto expected = SceneFrame(at_home().scene_origin)
                              .pose({{other.latitude}, {other.longitude}, other.altitude}, {{90}, {0}, {0}});
    CHECK(host.pose(7, 99s)->position.metres == expected.position.metres);
    CHECK(host.pose(7, 99s)->eye_from_scene == expected.eye_from_scene);
    other.state = cigi::EntityState::standby;
    host.send(other);
    CHECK(host.shown() == 0);
    CHECK(host.pose(7, 0s).has_value());
    other.state = cigi::EntityState::active, other.latitude = 95.0;
    host.send(other);
    CHECK(host.shown() == 1);
    CHECK(host.pose(7, 99s)->position.metres == expected.position.metres);
    CHECK(host.refused(Reject::out_of_range) == 1);
    other.state = cigi::EntityState::destroyed;
    host.send(other);
    CHECK(host.entities().find(7) == nullptr);
}

TEST_CASE("As many entities as there is room for are followed beside the ownship; those that stand by make room") {
    EntityHost host;
    host.send(ownship());
    auto idle = entity(9);
    idle.state = cigi::EntityState::standby;
    host.send(idle);
    for (std::uint16_t id = 100; id < 300; ++id) host.send(entity(id));
    CHECK(host.shown() == EntityList::kMost);
    CHECK(host.entities().find(9) == nullptr);
    CHECK(host.entities().find(100) != nullptr);
    CHECK(host.session.statistics().other_entities == EntityList::kMost);
    CHECK(host.session.statistics().entities_dropped >= 200 - EntityList::kMost);
    CHECK(host.session.state().pose.has_value());
}

TEST_CASE("Rates in level axes move an entity on a straight line, turning it about a fixed axis") {
    EntityHost host;
    auto other = entity(7);
    other.yaw = 30.0F;
    host.now = 5s;
    host.send(other, cigi::RateControl{.entity = 7, .x = 30.0F, .y = -20.0F, .z = 4.0F, .yaw = 6.0F});
    const ScenePose begin = *host.pose(7, 5s), later = *host.pose(7, 15s);
    SceneFrame frame(at_home().scene_origin);
    const GeodeticPosition at{{other.latitude}, {other.longitude}, other.altitude};
    const glm::dmat3 scene_from_level = glm::transpose(frame.pose(at, {}).eye_from_scene);
    // X north, Y east, Z down on the wire.
    const glm::dvec3 way = scene_from_level * glm::dvec3(-200.0, 300.0, -40.0);
    CHECK(glm::distance(later.position.metres, begin.position.metres + way) < 1e-9);
    CHECK(turned(later, frame.pose(at, {{90.0}, {0.0}, {0.0}})) < 1e-9);
    // Till other rates come: those count from then on.
    host.now = 15s;
    host.send(cigi::RateControl{.entity = 7});
    CHECK(apart(*host.pose(7, 99s), later) < 1e-9);
    CHECK(turned(*host.pose(7, 99s), later) < 1e-12);
}

TEST_CASE("Rates in an entity's own axes fly it as many small steps would") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> rate(-1.0, 1.0);
    for (int i = 0; i < 20; ++i) {
        Entity body;
        body.pose = {{{rate(random), rate(random), rate(random)}},
                     eye_from_scene_rotation({{180 * rate(random)}, {80 * rate(random)}, {180 * rate(random)}})};
        body.rates = {{30 * rate(random), 200 * rate(random), 30 * rate(random)},
                      {rate(random), rate(random), rate(random)},
                      true};
        constexpr int kSteps = 100000;
        constexpr double kStep = 2.0 / kSteps;
        glm::dmat3 scene_from_body = glm::transpose(body.pose.eye_from_scene);
        glm::dvec3 at = body.pose.position.metres;
        for (int s = 0; s < kSteps; ++s) {
            // The mid-point rule: errors of the order of the step squared.
            const auto turn = [&](const glm::dmat3& m, double seconds) {
                glm::dmat3 next = m;
                const glm::dvec3 axis = m * body.rates.turn;
                for (int c = 0; c < 3; ++c) {
                    const glm::dvec3 half = m[c] + 0.5 * seconds * glm::cross(axis, m[c]);
                    next[c] = m[c] + seconds * glm::cross(axis, half);
                }
                return next;
            };
            at += kStep * (turn(scene_from_body, 0.5 * kStep) * body.rates.velocity);
            scene_from_body = turn(scene_from_body, kStep);
        }
        const ScenePose closed = moved_on(body, 2s);
        CHECK(apart(closed, {{at}, {}}) < 1e-4);
        CHECK(turned(closed, {{}, glm::transpose(scene_from_body)}) < 1e-6);
        CHECK(turned(moved_on(body, 0s), body.pose) < 1e-14);
    }
}

TEST_CASE("A smoothed entity never jumps: a new packet is let in evenly, and then holds") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    EntityHost host;
    auto other = entity(7);
    other.smoothing = true;
    auto rates = cigi::RateControl{.entity = 7, .x = 50.0F, .y = 5.0F, .yaw = 10.0F};
    auto ig = ig_control(0);
    ig.smoothing = true;
    host.now = 1s;
    host.session.accept(message(ByteOrder::big, ig, other, rates), host.now);
    for (int i = 1; i < 200; ++i) {
        host.now += Time(std::chrono::milliseconds(20 + static_cast<int>(random() % 300)));
        const ScenePose before = *host.pose(7, host.now);
        ig.host_frame = static_cast<std::uint32_t>(i);
        other.latitude = 47.26 + 1e-5 * i + 1e-5 * unit(random);
        other.yaw = static_cast<float>(i + 5.0 * unit(random));
        other.pitch = static_cast<float>(5.0 * unit(random));
        rates.yaw = static_cast<float>(20.0 * unit(random));
        host.session.accept(message(ByteOrder::big, ig, other, rates), host.now);
        CHECK(apart(*host.pose(7, host.now), before) < 1e-8);
        CHECK(turned(*host.pose(7, host.now), before) < 1e-8);
        const Entity& now = *host.entities().find(7);
        CHECK(now.held_back.lasts <= kLetIn);
        const Time in = host.now + now.held_back.lasts, half = host.now + now.held_back.lasts / 2;
        CHECK(apart(*host.pose(7, in), predicted(now, in)) < 1e-9);
        CHECK(turned(*host.pose(7, in), predicted(now, in)) < 1e-9);
        CHECK(apart(*host.pose(7, half), predicted(now, half)) ==
              Approx(0.5 * glm::length(now.held_back.way)).margin(1e-8));
    }
    // Far and late ones are jumps, and so is everything where smoothing is not asked for.
    const auto jumps = [&](double latitude, Time later, bool smooth) {
        host.now += later;
        ++ig.host_frame;
        ig.smoothing = smooth;
        other.latitude = latitude;
        host.session.accept(message(ByteOrder::big, ig, other), host.now);
        const Entity& now = *host.entities().find(7);
        return apart(*host.pose(7, host.now), now.pose) == 0.0;
    };
    CHECK_FALSE(jumps(47.263, 50ms, true));
    CHECK(jumps(47.3, 50ms, true));
    CHECK(jumps(47.3001, 1100ms, true));
    CHECK_FALSE(jumps(47.3002, 50ms, true));
    CHECK(jumps(47.3003, 50ms, false));
}

TEST_CASE("Roll, pitch and yaw rates of the wire turn right wing down, nose up and to the right") {
    const auto after = [](cigi::RateControl rates) {
        EntityHost host;
        rates.entity = 7, rates.local = true;
        host.send(entity(7), rates);
        return std::pair(*host.pose(7, 1s), *host.pose(7, 0s));
    };
    const auto expect = [](const std::pair<ScenePose, ScenePose>& poses, const Attitude& turn) {
        const ScenePose expected{poses.second.position, eye_from_scene_rotation(turn) * poses.second.eye_from_scene};
        CHECK(turned(poses.first, expected) < 1e-9);
    };
    expect(after({.roll = 20.0F}), {{0}, {0}, {20}});
    expect(after({.pitch = 20.0F}), {{0}, {20}, {0}});
    expect(after({.yaw = 20.0F}), {{20}, {0}, {0}});
}

TEST_CASE("An attached entity is where its parent and its offset put it, however deep, and goes with its parent") {
    EntityHost host;
    auto parent = entity(1);
    parent.yaw = 90.0F, parent.pitch = 10.0F;
    auto turret = hung(2, 1, 5.0, 2.0, -3.0);
    turret.yaw = 30.0F;
    host.send(parent, turret, hung(3, 2, 1.0), cigi::RateControl{.entity = 1, .local = true, .x = 100.0F},
              cigi::RateControl{.entity = 2, .yaw = 10.0F});
    for (const Time at : {Time(0s), Time(3s)}) {
        const ScenePose base = *host.pose(1, at), child = *host.pose(2, at), barrel = *host.pose(3, at);
        const ScenePose expected = pose_on(
            base,
            {{{2.0, 5.0, 3.0}}, eye_from_scene_rotation({{30.0 + 10.0 * static_cast<double>(at / 1s)}, {0.0}, {0.0}})});
        CHECK(apart(child, expected) < 1e-9);
        CHECK(turned(child, expected) < 1e-9);
        CHECK(apart(barrel, pose_on(child, {{{0.0, 1.0, 0.0}}})) < 1e-9);
    }
    CHECK(apart(*host.pose(1, 3s), *host.pose(1, 0s)) == Approx(300.0));
    CHECK(host.shown() == 3);
    parent.state = cigi::EntityState::standby;
    host.send(parent);
    CHECK(host.shown() == 0);
    parent.state = cigi::EntityState::destroyed;
    host.send(parent);
    CHECK_FALSE(host.pose(3, 0s).has_value());
}

TEST_CASE("What hangs on the ownship goes where the ownship is said to be, and the ownship may hang on others") {
    EntityHost host;
    host.send(ownship(), hung(4, 0, 10.0), entity(1), hung(5, 1, 7.0));
    const ScenePose elsewhere{{{1e4, 0.0, 0.0}}, eye_from_scene_rotation({{45}, {0}, {0}})};
    CHECK(apart(*pose_of(host.entities(), 4, 0s, std::pair(std::uint16_t{0}, elsewhere)),
                pose_on(elsewhere, {{{0.0, 10.0, 0.0}}})) < 1e-9);
    host.send(hung(0, 1, -20.0));
    CHECK(apart(*host.pose(0, 0s), pose_on(*host.pose(1, 0s), {{{0.0, -20.0, 0.0}}})) < 1e-9);
    CHECK(apart(*pose_of(host.entities(), 0, 0s, std::pair(std::uint16_t{0}, elsewhere)), *host.pose(0, 0s)) < 1e-9);
    host.send(ownship());
    CHECK(apart(*host.pose(0, 0s), host.session.state().pose->pose) == 0.0);
}

TEST_CASE("Loops and chains too deep are refused, counted, and leave everything where it was") {
    EntityHost host;
    host.send(entity(1), hung(2, 1), hung(3, 2));
    for (const std::uint16_t onto : {std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{3}}) host.send(hung(1, onto));
    CHECK(host.refused(Reject::bad_attachment) == 3);
    CHECK(host.shown() == 3);
    for (std::uint16_t id = 4; id < 20; ++id) host.send(hung(id, static_cast<std::uint16_t>(id - 1)));
    CHECK(host.pose(kDeepest, 0s).has_value());
    CHECK_FALSE(host.pose(kDeepest + 1, 0s).has_value());
    CHECK(host.refused(Reject::bad_attachment) > 3);
    // A chain that grows from its end is found too deep where it is looked at.
    EntityHost other;
    for (std::uint16_t id = 30; id > 1; --id) other.send(hung(id, static_cast<std::uint16_t>(id - 1)));
    other.send(entity(1));
    CHECK(other.pose(kDeepest, 0s).has_value());
    CHECK_FALSE(other.pose(30, 0s).has_value());
}

TEST_CASE("Offsets and rates that are not finite or beyond belief are counted and not taken") {
    EntityHost host;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    host.send(entity(1), hung(2, 1));
    std::uint64_t refused = 0;
    for (const double bad : {double{nan}, 1.1e6, -1.1e6}) {
        host.send(hung(2, 1, bad));
        CHECK(host.refused(Reject::out_of_range) == ++refused);
        host.send(cigi::RateControl{.entity = 1, .y = static_cast<float>(bad)});
        CHECK(host.refused(Reject::out_of_range) == ++refused);
        host.send(cigi::RateControl{.entity = 1, .yaw = static_cast<float>(bad)});
        CHECK(host.refused(Reject::out_of_range) == ++refused);
    }
    CHECK(apart(*host.pose(1, 0s), *host.pose(2, 99s)) == 0.0);
    // Rates of a part are not those of the whole.
    host.send(cigi::RateControl{.entity = 1, .apply_to_part = true, .x = 5.0F});
    CHECK(apart(*host.pose(1, 0s), *host.pose(1, 99s)) == 0.0);
}

TEST_CASE("A view may ride on any entity that the host has named") {
    EntityHost host;
    host.send(ownship(), entity(7), cigi::ViewControl{.x_enable = true, .entity = 7, .x = 3.0F});
    CHECK(host.session.state().view_entity == 7);
    CHECK(host.session.state().mount->offset.y == 3.0);
    host.send(cigi::ViewControl{.entity = 8});
    CHECK(host.session.state().view_entity == 7);
    CHECK(host.refused(Reject::view_of_unknown_entity) == 1);
    host.send(cigi::ViewControl{.entity = 0});
    CHECK(host.session.state().view_entity == 0);
}
