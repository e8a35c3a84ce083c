// Lines through scenes: closed form against the reference renderer's rays in quadruple precision.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "ig_core/reference/reference_renderer.h"
#include "ig_core/scene_query.h"
#include "tests/ig_core/random_objects.h"
#include "tests/ig_core/random_scene.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// The scene direction of a pixel centre's ray, not normalised: its depth is the parameter.
glm::dvec3 ray(const View& view, int column, int row) {
    return glm::transpose(view.eye_from_scene) * glm::dvec3(view.image.x(column + 0.5), 1.0, view.image.z(row + 0.5));
}

}  // namespace

TEST_CASE(
    "10,000 random lines meet the surface that the reference renderer sees, within 1e-6 m or 1e-9 of the distance") {
    int compared = 0, met = 0;
    for (int trial = 0; compared < trials(10'000, 2'000); ++trial) {
        Randomness random(trial);
        const Scene scene = random_scene(random, 30);
        const SceneQuery query(scene);
        const View view = random_view(random, 10, 10);
        std::vector<std::uint8_t> ties;
        const GroundTruth truth = reference::ground_truth(scene, view, &ties);
        for (int pixel = 0; pixel < 100; ++pixel) {
            const auto i = static_cast<std::size_t>(pixel);
            if (ties[i] != 0) continue;
            ++compared;
            INFO("trial " << trial << ", pixel " << pixel);
            const glm::dvec3 along = ray(view, pixel % 10, pixel / 10);
            const double length = glm::length(along);
            const auto hit = query.nearest(view.eye, along / length, kNearDepth * length, 1e12);
            REQUIRE((hit ? hit->object : kSkyId) == truth.object_ids[i]);
            if (!hit) continue;
            ++met;
            REQUIRE(hit->surface == truth.surface_ids[i]);
            const double distance = truth.depth[i] * length;
            REQUIRE(std::abs(hit->distance - distance) <= std::max(1e-6, 1e-9 * distance));
            const glm::dvec3 there = view.eye.metres + hit->distance * along / length;
            REQUIRE(glm::distance(hit->point.metres, there) <= std::max(1e-6, 1e-9 * distance));
            REQUIRE(glm::length(hit->normal) == Approx(1.0));
            // Into a solid: against its face. The ground is met from both sides.
            if (hit->object != kGroundId) REQUIRE(glm::dot(hit->normal, along) <= 1e-6 * length);
        }
    }
    CHECK(met > compared / 2);
}

TEST_CASE("The highest surface above a place is the hill's, the ball's top, the box's lid, or the ground") {
    Scene scene;
    scene.ground = Ground{};
    scene.objects = {ball({100.0, 0.0, 20.0}, 5.0), box({-10.0, -10.0, -1.0}, {10.0, 10.0, 7.5})};
    scene.objects.push_back({"hill", Hill{{{500.0, 900.0, 120.0}}, 200.0, 0.5}, {{{0.0, 0.0, 1.0, 0.0}}}, {}});
    const SceneQuery query(scene);
    const auto height = [&](double x, double y) { return query.highest(x, y).value().point.metres.z; };
    CHECK(height(100.0, 0.0) == Approx(25.0));
    CHECK(height(103.0, 0.0) == Approx(24.0));
    CHECK(height(9.9, -9.9) == Approx(7.5));
    CHECK(height(500.0, 900.0) == Approx(120.0));
    // By the hill's own formula: Z = h + c - c sqrt(1 + d^2 / a^2), c = r m^2, a = r m.
    CHECK(height(530.0, 940.0) == Approx(120.0 + 50.0 - 50.0 * std::sqrt(1.0 + 2500.0 / 10000.0)));
    CHECK(height(-300.0, 5.0) == 0.0);
    CHECK(query.highest(103.0, 0.0)->normal.x == Approx(0.6));
    CHECK(query.highest(103.0, 0.0)->normal.z == Approx(0.8));
    CHECK(query.highest(0.0, 0.0)->surface == 5);
    scene.ground.reset();
    CHECK_FALSE(SceneQuery(scene).highest(-300.0, 5.0).has_value());
}

TEST_CASE("A line's ends count: what is nearer than the least or further than the most is not met") {
    Scene scene;
    scene.objects = {ball({0.0, 100.0, 0.0}, 10.0)};
    const SceneQuery query(scene);
    const auto at = [&](double least, double most) { return query.nearest({{}}, {0.0, 1.0, 0.0}, least, most); };
    CHECK(at(0.0, 90.0)->distance == Approx(90.0));
    CHECK_FALSE(at(0.0, 89.999).has_value());
    CHECK_FALSE(at(90.0, 1000.0).has_value());
    // From inside it is not met; behind the line's beginning neither.
    CHECK_FALSE(query.nearest({{0.0, 95.0, 0.0}}, {0.0, 1.0, 0.0}, 0.0, 1000.0).has_value());
    CHECK_FALSE(query.nearest({{0.0, 120.0, 0.0}}, {0.0, 1.0, 0.0}, 0.0, 1000.0).has_value());
}

TEST_CASE("20,000 questions a second are answered on one core of a quiet machine, in a scene of 200 objects",
          "[.][timing]") {
    Randomness random(1);
    const SceneQuery query(random_scene(random, 200));
    constexpr int kQuestions = 200'000;
    int met = 0;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kQuestions; ++i)
        met += query.nearest({random.vector(100.0)}, random.direction(), 0.0, 1e5).has_value();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    WARN(kQuestions / seconds << " questions a second, " << met << " met something");
    CHECK(kQuestions / seconds > 20'000.0);
}
