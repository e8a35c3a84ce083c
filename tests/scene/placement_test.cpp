#include "ig_core/scene/placement.h"

#include <catch2/catch.hpp>

#include "tests/clusters/solids.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

Long general_at(const GeneralQuadric& quadric, const LongPoint& p) {
    const auto& q = quadric.coefficients;
    return q[0] * p.x * p.x + q[1] * p.y * p.y + q[2] * p.z * p.z + q[3] * p.x * p.y + q[4] * p.y * p.z +
           q[5] * p.x * p.z + q[6] * p.x + q[7] * p.y + q[8] * p.z + q[9];
}

/// p of the model in the scene, by turning it axis by axis: roll about Y, pitch about X, heading about Z.
LongPoint in_scene(const LongPoint& p, const Attitude& attitude, const glm::dvec3& position) {
    const auto radians = [](Degrees d) { return static_cast<Long>(d.value) * std::acos(Long(-1)) / 180; };
    const Long h = radians(attitude.heading), t = radians(attitude.pitch), r = radians(attitude.roll);
    const Long x = p.x * std::cos(r) + p.z * std::sin(r), up = p.z * std::cos(r) - p.x * std::sin(r);
    const Long ahead = p.y * std::cos(t) - up * std::sin(t), z = p.y * std::sin(t) + up * std::cos(t);
    return {x * std::cos(h) + ahead * std::sin(h) + position.x, ahead * std::cos(h) - x * std::sin(h) + position.y,
            z + position.z};
}

}  // namespace

TEST_CASE("a placed model's solids hold the same points as in its own axes") {
    long inside = 0;
    for (int trial = 0; trial < trials(400); ++trial) {
        Randomness random(trial);
        const auto some = [&](double size) {
            return glm::dvec3(random.between(-size, size), random.between(-size, size), random.between(-size, size));
        };
        Object egg, bowl;
        egg.shape = Ellipsoid{{some(3)},
                              {random.between(1, 4), random.between(1, 4), random.between(0.1, 4)},
                              {{random.between(-180, 180)}, {random.between(-90, 90)}, {random.between(-180, 180)}}};
        egg.planes = {{{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(0, 2)}}};
        GeneralQuadric cylinder;
        cylinder.coefficients = {0.5, 0, 2, 0, 0, 0, random.between(-1, 1), 0, random.between(-1, 1), -3};
        bowl.shape = cylinder;
        bowl.planes = {{{0, 1, 0.2, 2}}, {{0.1, -1, 0, 2}}};
        const Attitude attitude{{random.between(0, 360)}, {random.between(-90, 90)}, {random.between(-180, 180)}};
        const ScenePose pose{{some(1e4)}, eye_from_scene_rotation(attitude)};
        const Object placed_egg = *placed(egg, pose), placed_bowl = *placed(bowl, pose);
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 at = some(5);
            const LongPoint own{at.x, at.y, at.z}, there = in_scene(own, attitude, pose.position.metres);
            CAPTURE(seed(), trial, i);
            CHECK(std::abs(quadric_at(egg, own) - quadric_at(placed_egg, there)) < 1e-9);
            const Long before = general_at(cylinder, own);
            const Long after = general_at(std::get<GeneralQuadric>(placed_bowl.shape), there);
            // Coefficients of 1e8 are rounded to 1e-8.
            CHECK(std::abs(before - after) < 2e-6);
            for (std::size_t j = 0; j < 2; ++j)
                CHECK(std::abs(plane_at(bowl.planes[j], own) - plane_at(placed_bowl.planes[j], there)) < 1e-10);
            inside += before < 0 && within_planes(placed_bowl, there) ? 1 : 0;
        }
    }
    CHECK(inside > trials(400));
    CHECK_FALSE(placed(Object{"", Hill{}, {}, {}}, {}));
}
