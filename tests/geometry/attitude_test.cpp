#include <catch2/catch.hpp>
#include <glm/matrix.hpp>

#include "ig_core/geometry/space.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

struct Axes {
    glm::dvec3 right, forward, up;
};
Axes axes_of(const Attitude& attitude) {
    const glm::dmat3 scene_from_eye = glm::transpose(eye_from_scene_rotation(attitude));
    return {scene_from_eye[0], scene_from_eye[1], scene_from_eye[2]};
}

void check_same(const glm::dvec3& a, const glm::dvec3& b) {
    CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
    CHECK(glm::length(a - b) < 1e-15);
}

double difference(const glm::dmat3& a, const glm::dmat3& b) {
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

/// Right-handed turn about an axis.
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, Degrees angle) {
    const double c = std::cos(angle.radians()), s = std::sin(angle.radians());
    return c * v + s * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
}

/// Heading, pitch and roll, one after the other, each about an axis of the body's own.
Axes turned(Axes a, const Attitude& attitude) {
    a.forward = turned(a.forward, a.up, {-attitude.heading.value});
    a.right = turned(a.right, a.up, {-attitude.heading.value});
    a.forward = turned(a.forward, a.right, attitude.pitch), a.up = turned(a.up, a.right, attitude.pitch);
    a.right = turned(a.right, a.forward, attitude.roll), a.up = turned(a.up, a.forward, attitude.roll);
    return a;
}

void require_same(const Axes& a, const Axes& b) {
    REQUIRE(glm::length(a.right - b.right) < 1e-14);
    REQUIRE(glm::length(a.forward - b.forward) < 1e-14);
    REQUIRE(glm::length(a.up - b.up) < 1e-14);
}

}  // namespace

TEST_CASE("a level eye heading north looks along Y, with X to the right and Z up") {
    const Axes axes = axes_of({});
    check_same(axes.right, {1, 0, 0});
    check_same(axes.forward, {0, 1, 0});
    check_same(axes.up, {0, 0, 1});
}

TEST_CASE("heading goes clockwise from north, pitch lifts the nose, roll lowers the right wing") {
    check_same(axes_of({{90}, {0}, {0}}).forward, {1, 0, 0});    // east
    check_same(axes_of({{90}, {0}, {0}}).right, {0, -1, 0});     // south
    check_same(axes_of({{270}, {0}, {0}}).forward, {-1, 0, 0});  // west
    const double half = std::sqrt(0.5);
    check_same(axes_of({{0}, {45}, {0}}).forward, {0, half, half});
    check_same(axes_of({{0}, {45}, {0}}).up, {0, -half, half});
    check_same(axes_of({{0}, {0}, {45}}).right, {half, 0, -half});
    check_same(axes_of({{0}, {0}, {45}}).up, {half, 0, half});
    check_same(axes_of({{0}, {0}, {90}}).right, {0, 0, -1});
}

TEST_CASE("heading, pitch and roll turn the body about its own axes, in this order") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(trial);
        const Attitude attitude{{random.between(-360, 720)}, {random.between(-90, 90)}, {random.between(-360, 360)}};
        CAPTURE(trial);
        require_same(axes_of(attitude), turned({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, attitude));
    }
}

TEST_CASE("what rides on a body is where its offset along the body's axes puts it, and turns from them") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(trial);
        const Attitude attitude = random.attitude(), own = random.attitude();
        const ScenePose body{{random.vector(1e4)}, eye_from_scene_rotation(attitude)};
        const glm::dvec3 offset = random.vector(5);
        const ScenePose pose = pose_on(body, {{offset}, eye_from_scene_rotation(own)});
        const Axes axes = axes_of(attitude);
        const glm::dvec3 place =
            body.position.metres + offset.x * axes.right + offset.y * axes.forward + offset.z * axes.up;
        CAPTURE(trial);
        REQUIRE(glm::length(pose.position.metres - place) < 1e-11);
        REQUIRE(pose.position == place_on(body, offset));
        const glm::dmat3 scene_from_own = glm::transpose(pose.eye_from_scene);
        require_same({scene_from_own[0], scene_from_own[1], scene_from_own[2]}, turned(axes, own));
    }
}

TEST_CASE("attitude rotations are orthonormal and right-handed") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(trial);
        const glm::dmat3 rotation = eye_from_scene_rotation(random.attitude());
        CAPTURE(trial);
        REQUIRE(difference(rotation * glm::transpose(rotation), glm::dmat3(1.0)) < 5e-16);
        REQUIRE(glm::determinant(rotation) == Approx(1.0).epsilon(1e-15));
    }
}

TEST_CASE("an attitude comes back from its rotation, within its ranges") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(2000); ++trial) {
        Randomness random(trial);
        const Attitude given{{random.between(0, 360)}, {random.between(-89.9, 89.9)}, {random.between(-180, 180)}};
        const Attitude back = attitude_of(eye_from_scene_rotation(given));
        CAPTURE(trial);
        REQUIRE(back.heading.value == Approx(given.heading.value).margin(1e-10));
        REQUIRE(back.pitch.value == Approx(given.pitch.value).margin(1e-10));
        REQUIRE(back.roll.value == Approx(given.roll.value).margin(1e-10));
    }
    for (int trial = 0; trial < trials(2000); ++trial) {
        Randomness random(trial);
        const glm::dmat3 rotation = eye_from_scene_rotation(random.attitude());
        const Attitude attitude = attitude_of(rotation);
        CAPTURE(trial, attitude.heading.value, attitude.pitch.value, attitude.roll.value);
        REQUIRE(attitude.heading.value >= 0);
        REQUIRE(attitude.heading.value <= 360);
        REQUIRE(std::abs(attitude.pitch.value) <= 90);
        REQUIRE(std::abs(attitude.roll.value) <= 180);
        REQUIRE(difference(eye_from_scene_rotation(attitude), rotation) < 1e-12);
    }
}

TEST_CASE("straight up and straight down, roll is 0 and heading takes the whole turn") {
    for (const double pitch : {90.0, -90.0}) {
        for (const double heading : {0.0, 30.0, 200.0}) {
            for (const double roll : {0.0, 50.0, -120.0}) {
                const glm::dmat3 rotation = eye_from_scene_rotation({{heading}, {pitch}, {roll}});
                const Attitude attitude = attitude_of(rotation);
                CAPTURE(heading, pitch, roll);
                CHECK(attitude.pitch.value == Approx(pitch));
                CHECK(attitude.roll.value == 0);
                CHECK(difference(eye_from_scene_rotation(attitude), rotation) < 1e-12);
            }
        }
    }
}

TEST_CASE("degrees and radians convert both ways") {
    CHECK(Degrees{180}.radians() == Approx(3.14159265358979323846).epsilon(1e-15));
    CHECK(Degrees::from_radians(Degrees{12.5}.radians()).value == Approx(12.5).epsilon(1e-15));
}
