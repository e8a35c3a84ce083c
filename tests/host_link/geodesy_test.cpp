// The answers here come from textbook formulas written out anew: WGS-84 to ECEF and the three axes of a local level
// frame.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "host_link/geodesy.h"

using namespace quadrig;
using namespace quadrig::host;

namespace {

glm::dvec3 ecef(const GeodeticPosition& p) {
    const double a = 6378137.0, f = 1.0 / 298.257223563, e2 = f * (2.0 - f);
    const double s = std::sin(p.latitude.radians()), c = std::cos(p.latitude.radians());
    const double n = a / std::sqrt(1.0 - e2 * s * s);
    return {(n + p.altitude) * c * std::cos(p.longitude.radians()),
            (n + p.altitude) * c * std::sin(p.longitude.radians()), (n * (1.0 - e2) + p.altitude) * s};
}

struct Axes {
    glm::dvec3 east, north, up;
};
Axes level_axes(const GeodeticPosition& p) {
    const double sp = std::sin(p.latitude.radians()), cp = std::cos(p.latitude.radians());
    const double sl = std::sin(p.longitude.radians()), cl = std::cos(p.longitude.radians());
    return {{-sl, cl, 0.0}, {-sp * cl, -sp * sl, cp}, {cp * cl, cp * sl, sp}};
}

glm::dvec3 in_axes(const Axes& axes, const glm::dvec3& v) {
    return {dot(axes.east, v), dot(axes.north, v), dot(axes.up, v)};
}

/// A row of eye_from_scene: the body's right (0), forward (1) or up (2) axis in scene space.
glm::dvec3 axis(const ScenePose& pose, int row) { return glm::transpose(pose.eye_from_scene)[row]; }

/// Body axes by turning vectors one after the other: heading about down, pitch about right, roll about forward.
struct Body {
    glm::dvec3 right, forward, up;
};
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& about, double angle) {
    return v * std::cos(angle) + cross(about, v) * std::sin(angle) + about * dot(about, v) * (1.0 - std::cos(angle));
}
Body turned(const Body& level, const Attitude& attitude) {
    Body b = level;
    b.forward = turned(b.forward, -level.up, attitude.heading.radians());
    b.right = turned(b.right, -level.up, attitude.heading.radians());
    b.forward = turned(b.forward, b.right, attitude.pitch.radians());
    b.up = cross(b.right, b.forward);
    b.right = turned(b.right, b.forward, attitude.roll.radians());
    b.up = turned(b.up, b.forward, attitude.roll.radians());
    return b;
}

}  // namespace

TEST_CASE("Poses agree with ECEF arithmetic, curvature included") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int i = 0; i < 2000; ++i) {
        const GeodeticPosition origin{{uniform(-89, 89)}, {uniform(-180, 180)}, uniform(-100, 4000)};
        const double reach = i % 2 == 0 ? 0.5 : 20.0;
        const GeodeticPosition place{{std::clamp(origin.latitude.value + uniform(-reach, reach), -90.0, 90.0)},
                                     {origin.longitude.value + uniform(-reach, reach)},
                                     uniform(0, 20000)};
        const Attitude attitude{{uniform(0, 360)}, {uniform(-90, 90)}, {uniform(-180, 180)}};
        SceneFrame frame(origin);
        const ScenePose pose = frame.pose(place, attitude);

        const Axes scene = level_axes(origin), level = level_axes(place);
        const glm::dvec3 position = in_axes(scene, ecef(place) - ecef(origin));
        CHECK(glm::length(pose.position.metres - position) < 1e-8);
        const Body body = turned({level.east, level.north, level.up}, attitude);
        CHECK(glm::length(axis(pose, 0) - in_axes(scene, body.right)) < 1e-13);
        CHECK(glm::length(axis(pose, 1) - in_axes(scene, body.forward)) < 1e-13);
        CHECK(glm::length(axis(pose, 2) - in_axes(scene, body.up)) < 1e-13);
    }
}

TEST_CASE(
    "At the origin the local frame is the scene's, and a hundred kilometres north it leans back by the verticals' "
    "angle") {
    const GeodeticPosition origin{{47.0}, {11.0}, 500.0};
    SceneFrame frame(origin);
    const ScenePose here = frame.pose(origin, {{90.0}, {0.0}, {0.0}});
    CHECK(glm::length(here.position.metres) < 1e-9);
    CHECK(glm::length(axis(here, 1) - glm::dvec3(1, 0, 0)) < 1e-14);
    const ScenePose north = frame.pose({{47.9}, {11.0}, 500.0}, {{0.0}, {0.0}, {0.0}});
    CHECK(attitude_of(north.eye_from_scene).pitch.value == Approx(-0.9).epsilon(1e-12));
}
