#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tests/reference/scene_makers.h"

using namespace quadrig;
using namespace quadrig::reference;

namespace {

Approx exactly(double value) { return Approx(value).epsilon(1e-13).margin(1e-13); }

/// Half the chord's distance before the axis, as a solid of revolution about Z gives it to a level ray at height z.
void check_level_rays(const Scene& scene, double eye_distance, const std::function<double(double)>& radius_at) {
    for (const double z : {0.5, 1.0, 2.5, 4.0, 7.5}) {
        const Seen seen = seen_in_the_middle(scene, look_north({0, -eye_distance, z}));
        INFO("level ray at height " << z);
        CHECK(seen.object == 0);
        CHECK(seen.surface == 0);
        CHECK(seen.depth == exactly(eye_distance - radius_at(z)));
    }
}

}  // namespace

TEST_CASE("a sphere ahead covers the disc of its limb, at the depths of elementary trigonometry") {
    const double distance = 100.0, radius = 30.0;
    const View view = look_north({0, 0, 0});
    const GroundTruth truth = ground_truth(scene_of({solid(sphere({0, distance, 0}, radius))}), view);
    const double limb = radius / std::sqrt(distance * distance - radius * radius);
    int inside = 0;
    for (int row = 0; row < 65; ++row) {
        for (int column = 0; column < 65; ++column) {
            const double tangent = std::hypot(view.image.x(column + 0.5), view.image.z(row + 0.5));
            const auto pixel = static_cast<std::size_t>(65 * row + column);
            REQUIRE(truth.object_ids[pixel] == (tangent < limb ? 0 : kSkyId));
            if (tangent >= limb) continue;
            const double sine = tangent / std::hypot(1.0, tangent), cosine = 1 / std::hypot(1.0, tangent);
            const double range = distance * cosine - std::sqrt(radius * radius - std::pow(distance * sine, 2));
            REQUIRE(truth.depth[pixel] == exactly(range * cosine));
            ++inside;
        }
    }
    const double limb_in_pixels = limb / view.image.column_step;
    CHECK(inside == Approx(3.14159 * limb_in_pixels * limb_in_pixels).epsilon(0.02));
}

TEST_CASE("each side of a box shows the face of its plane") {
    const Scene scene = scene_of({box({8, 48, 3}, {12, 52, 7})});
    const auto from = [&](glm::dvec3 eye, Attitude attitude) { return seen_in_the_middle(scene, look(eye, attitude)); };
    const auto check = [](const Seen& seen, int surface, double depth) {
        CHECK(seen.object == 0);
        CHECK(seen.surface == surface);
        CHECK(seen.depth == exactly(depth));
    };
    check(from({40, 50, 5}, {{270}, {0}, {0}}), 1, 28);
    check(from({-30, 50, 5}, {{90}, {0}, {0}}), 2, 38);
    check(from({10, 90, 5}, {{180}, {0}, {30}}), 3, 38);
    check(from({10, 0, 5}, {{0}, {0}, {-70}}), 4, 48);
    check(from({10, 50, 25}, {{20}, {-90}, {0}}), 5, 18);
    check(from({10, 50, -25}, {{300}, {90}, {0}}), 6, 28);
}

TEST_CASE("a cut sphere shows its flat face from the cut side and its quadric from the other") {
    const Scene scene = scene_of({solid(sphere({0, 0, 10}, 4), {{{0, 0, -2, 24}}})});
    const Seen above = seen_in_the_middle(scene, look({1, 2, 40}, {{0}, {-90}, {0}}));
    CHECK(above.surface == 1);
    CHECK(above.depth == exactly(28));
    const Seen below = seen_in_the_middle(scene, look({0, 0, -10}, {{0}, {90}, {0}}));
    CHECK(below.surface == 0);
    CHECK(below.depth == exactly(16));
    const double disc_radius = std::sqrt(16.0 - 4.0);
    CHECK(seen_in_the_middle(scene, look({disc_radius - 1e-9, 0, 40}, {{0}, {-90}, {0}})).surface == 1);
    CHECK(seen_in_the_middle(scene, look({disc_radius + 1e-9, 0, 40}, {{0}, {-90}, {0}})).surface == 0);
}

TEST_CASE("an ellipsoid is turned by heading, then pitch, then roll") {
    const Ellipsoid ellipsoid{{{0, 0, 0}}, {3, 20, 1}, {{30}, {40}, {50}}};
    const Scene scene = scene_of({solid(ellipsoid)});
    const double degree = std::acos(-1.0) / 180;
    const glm::dvec3 nose(std::sin(30 * degree) * std::cos(40 * degree), std::cos(30 * degree) * std::cos(40 * degree),
                          std::sin(40 * degree));
    CHECK(seen_in_the_middle(scene, look(-100.0 * nose, {{30}, {40}, {0}})).depth == exactly(80));
    const glm::dvec3 level_right(std::cos(30 * degree), -std::sin(30 * degree), 0);
    const glm::dvec3 up_at_no_roll(level_right.y * nose.z - level_right.z * nose.y,
                                   level_right.z * nose.x - level_right.x * nose.z,
                                   level_right.x * nose.y - level_right.y * nose.x);
    const glm::dvec3 right = std::cos(50 * degree) * level_right - std::sin(50 * degree) * up_at_no_roll;
    View from_the_right = look(100.0 * right, {});
    from_the_right.eye_from_scene = eye_from_scene_rotation(
        {Degrees::from_radians(std::atan2(-right.x, -right.y)), Degrees::from_radians(std::asin(-right.z)), {12}});
    CHECK(seen_in_the_middle(scene, from_the_right).depth == exactly(97));
}

TEST_CASE("a hill has the profile of its hyperbola, no upper sheet, and the apex where the file says") {
    const double r = 20, m = 0.5, height = 9, c = r * m * m, a = r * m;
    const Scene scene = scene_of({solid(Hill{{{0, 0, height}}, r, m}, {{{0, 0, 1, 0}}})});
    check_level_rays(scene, 200, [&](double z) { return a * std::sqrt(std::pow((height + c - z) / c, 2) - 1); });
    CHECK(seen_in_the_middle(scene, look({0, 0, 50}, {{77}, {-90}, {0}})).depth == exactly(41));
    for (const double z : {9.001, 10.0, 15.0, 19.5, 40.0})
        CHECK(seen_in_the_middle(scene, look_north({0, -200, z})).object == kSkyId);
    CHECK(seen_in_the_middle(scene, look({3, 4, -60}, {{0}, {90}, {0}})).surface == 1);
}

TEST_CASE("a cylinder between two planes shows side, top and bottom") {
    const Scene scene =
        scene_of({solid(GeneralQuadric{{1, 1, 0, 0, 0, 0, 0, 0, 0, -9}}, {{{0, 0, 1, 0}}, {{0, 0, -1, 8}}})});
    check_level_rays(scene, 50, [](double) { return 3.0; });
    const Seen top = seen_in_the_middle(scene, look({1, 1, 30}, {{0}, {-90}, {0}}));
    CHECK(top.surface == 2);
    CHECK(top.depth == exactly(22));
    CHECK(seen_in_the_middle(scene, look({2.2, 2.2, 30}, {{0}, {-90}, {0}})).object == kSkyId);
    CHECK(seen_in_the_middle(scene, look({1, -1, -30}, {{0}, {90}, {0}})).surface == 1);
}

TEST_CASE("a cone keeps the nappe of its half-space") {
    const double slope = 0.75;
    const Scene scene =
        scene_of({solid(GeneralQuadric{{1, 1, -slope * slope, 0, 0, 0, 0, 0, 20 * slope * slope, -100 * slope * slope}},
                        {{{0, 0, -1, 10}}, {{0, 0, 1, 0}}})});
    check_level_rays(scene, 50, [&](double z) { return slope * (10 - z); });
    CHECK(seen_in_the_middle(scene, look_north({0, -50, 12})).object == kSkyId);
    CHECK(seen_in_the_middle(scene, look({1, 0, 40}, {{0}, {-90}, {0}})).depth == exactly(30 + 1 / slope));
}

TEST_CASE("a paraboloid has the profile of its parabola") {
    const double focus = 0.4;
    const Scene scene = scene_of({solid(GeneralQuadric{{1, 1, 0, 0, 0, 0, 0, 0, -4 * focus, 0}}, {{{0, 0, -1, 8}}})});
    check_level_rays(scene, 30, [&](double z) { return 2 * std::sqrt(focus * z); });
    const Seen inside_rim = seen_in_the_middle(scene, look({1, 2, 20}, {{0}, {-90}, {0}}));
    CHECK(inside_rim.surface == 1);
    CHECK(inside_rim.depth == exactly(12));
}

TEST_CASE("an oblique quadric of ten coefficients is met where its equation vanishes") {
    // (X + Y)^2 + (Y + Z)^2 + (X + Z)^2 = 8 about (1, 2, 3): on the axis through (1, 1, 1), t^2 = 8 / 12.
    const Scene scene = scene_of({solid(GeneralQuadric{{2, 2, 2, 2, 2, 2, -14, -16, -18, 50 - 8}})});
    const double t = std::sqrt(8.0 / 12.0);
    const glm::dvec3 diagonal(1, 1, 1);
    const Attitude along{{45}, Degrees::from_radians(std::atan(1 / std::sqrt(2.0))), {0}};
    const Seen seen = seen_in_the_middle(scene, look(glm::dvec3(1, 2, 3) - 40.0 * diagonal, along));
    CHECK(seen.object == 0);
    CHECK(seen.depth == exactly((40 - t) * std::sqrt(3.0)));
}

TEST_CASE("a tilted paraboloid is met at its apex along its axis, however its coefficients were rounded") {
    // |p|^2 - (t.p)^2 - t.p <= 0 with t a unit vector, to double precision: in exact terms now an ellipsoid, now a
    // hyperboloid.
    for (int tilt = 1; tilt <= 40; ++tilt) {
        const View axis = look({0, 0, 0}, {{11.0 * tilt}, {2.0 * tilt - 3.0}, {0}});
        const glm::dvec3 t(axis.eye_from_scene[0][1], axis.eye_from_scene[1][1], axis.eye_from_scene[2][1]);
        const Scene scene = scene_of({solid(GeneralQuadric{{1 - t.x * t.x, 1 - t.y * t.y, 1 - t.z * t.z, -2 * t.x * t.y,
                                                            -2 * t.y * t.z, -2 * t.x * t.z, -t.x, -t.y, -t.z, 0}})});
        View view = axis;
        view.eye.metres = -30.0 * t;
        INFO("tilt " << tilt);
        CHECK(seen_in_the_middle(scene, view).depth == Approx(30).epsilon(1e-12));
    }
}
