#include <catch2/catch.hpp>
#include <glm/matrix.hpp>

#include "tests/ig_core/random_scene.h"
#include "tests/ig_core/rendering.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

Paint plain(const Colour& colour) { return {colour, {}, 0.0, {}}; }

/// Rounding, and what float shading adds to it.
constexpr double kStep = 0.6;

Scene dusk() {
    Scene scene;
    scene.sun = {{0}, {30}, 0.2};
    scene.sky = {{0.6, 0.7, 0.8}, {0.1, 0.2, 0.5}};
    return scene;
}

View small(const glm::dvec3& eye, const Attitude& attitude, double fov = 4) { return look(eye, attitude, 9, 9, fov); }

/// The pixel in the middle, as steps off a colour.
double middle_off(const Scene& scene, const View& view, const Colour& expected, const Environment& environment = {}) {
    const Picture picture = render(scene, view, environment);
    return steps_off(picture.at(view.image.width / 2, view.image.height / 2), expected);
}

}  // namespace

TEST_CASE("a box is lit on each side by the cosine to the sun, and never below the ambient share") {
    Scene scene = dusk();
    const Colour colour(0.9, 0.5, 0.25);
    scene.objects = {box({-5, -5, 20}, {5, 5, 30})};
    scene.objects[0].paint = plain(colour);
    const auto lit = [&](double cosine) { return (0.2 + 0.8 * std::max(0.0, cosine)) * colour; };
    const double side = std::cos(Degrees{30}.radians()), top = 0.5;
    CHECK(middle_off(scene, small({0, 50, 25}, {{180}, {0}, {0}}), lit(side)) < kStep);  // the sun stands in the north
    CHECK(middle_off(scene, small({0, -50, 25}, {{0}, {0}, {0}}), lit(-side)) < kStep);
    CHECK(middle_off(scene, small({50, 0, 25}, {{270}, {0}, {0}}), lit(0)) < kStep);
    CHECK(middle_off(scene, small({-50, 0, 25}, {{90}, {0}, {0}}), lit(0)) < kStep);
    CHECK(middle_off(scene, small({0, 0, 60}, {{77}, {-90}, {0}}), lit(top)) < kStep);
    CHECK(middle_off(scene, small({0, 0, 0}, {{77}, {90}, {0}}), lit(-top)) < kStep);

    Environment evening;
    evening.sun = Sun{{90}, {10}, 0.4};
    const Colour east = (0.4 + 0.6 * std::cos(Degrees{10}.radians())) * colour;
    CHECK(middle_off(scene, small({50, 0, 25}, {{270}, {0}, {0}}), east, evening) < kStep);
    CHECK(middle_off(scene, small({0, 50, 25}, {{180}, {0}, {0}}), 0.4 * colour, evening) < kStep);
}

TEST_CASE("a ball is lit by the cosine between its normal and the sun, all over") {
    Scene scene = dusk();
    scene.objects = {ball({0, 100, 0}, 10)};
    scene.objects[0].paint = plain({1, 1, 1});
    const View view = look({0, 0, 0}, {}, 101, 101, 14);
    const double sun_azimuth = 200, sun_elevation = 35;
    Environment environment;
    environment.sun = Sun{{sun_azimuth}, {sun_elevation}, 0.1};
    const double a = Degrees{sun_azimuth}.radians(), e = Degrees{sun_elevation}.radians();
    const glm::dvec3 to_sun(std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e));
    const Picture picture = render(scene, view, environment);
    int lit = 0;
    for (int r = 0; r < 101; ++r) {
        for (int c = 0; c < 101; ++c) {
            const glm::dvec3 d(view.image.x(c + 0.5), 1, view.image.z(r + 0.5));
            const double aa = glm::dot(d, d), discriminant = 100.0 * 100 - aa * (100.0 * 100 - 100);
            if (discriminant < 5) continue;  // about the limb the light within a pixel is not that of its centre
            const glm::dvec3 normal = ((100 - std::sqrt(discriminant)) / aa * d - glm::dvec3(0, 100, 0)) / 10.0;
            const double cosine = glm::dot(normal, to_sun);
            if (std::abs(cosine) < 0.03) continue;  // nor is it about the edge of night
            CAPTURE(c, r);
            REQUIRE(steps_off(picture.at(c, r), Colour(0.1 + 0.9 * std::max(0.0, cosine))) < 1);
            ++lit;
        }
    }
    CHECK(lit > 4000);
}

TEST_CASE("ground and cloud decks are lit from above, whichever side is seen") {
    Scene scene = dusk();
    const Colour colour(0.5, 0.4, 0.3), lit = (0.2 + 0.8 * 0.5) * colour;
    scene.ground = Ground{plain(colour)};
    CHECK(middle_off(scene, small({0, 0, 5}, {{0}, {-90}, {0}}), lit) < kStep);
    CHECK(middle_off(scene, small({0, 0, -5}, {{0}, {90}, {0}}), lit) < kStep);
    scene.ground.reset();
    scene.cloud_decks = {{100.0, plain(colour)}};
    CHECK(middle_off(scene, small({0, 0, 150}, {{0}, {-90}, {0}}), lit) < kStep);
    CHECK(middle_off(scene, small({0, 0, 5}, {{0}, {90}, {0}}), lit) < kStep);
}

TEST_CASE("the sky goes from horizon to zenith with the sine of elevation, and keeps the horizon's colour below") {
    const Scene scene = dusk();
    for (const double roll : {0.0, 40.0, 180.0}) {
        const View view = look({0, 0, 10}, {{33}, {20}, {roll}}, 61, 45, 120);
        const Picture picture = render(scene, view);
        const glm::dmat3 scene_from_eye = glm::transpose(view.eye_from_scene);
        for (int r = 0; r < 45; ++r) {
            for (int c = 0; c < 61; ++c) {
                const glm::dvec3 d = scene_from_eye * glm::dvec3(view.image.x(c + 0.5), 1, view.image.z(r + 0.5));
                const double sine = std::max(0.0, glm::normalize(d).z);
                CAPTURE(roll, c, r);
                REQUIRE(steps_off(picture.at(c, r), scene.sky.horizon + sine * (scene.sky.zenith - scene.sky.horizon)) <
                        kStep);
            }
        }
    }
}

TEST_CASE("haze leaves 5 % of a surface at the visibility, by slant range, and takes nothing of the sky") {
    Scene scene = dusk();
    scene.haze = Haze{500, {0.2, 0.1, 0.05}};
    scene.sun.ambient = 1;
    scene.objects = {box({-5000, 500, -5000}, {5000, 600, 5000})};
    const Colour white(1, 1, 1), haze = scene.haze->colour;
    scene.objects[0].paint = plain(white);
    const auto hazed = [&](double range, double visibility, const Colour& air) {
        const double e = std::exp(-2.996 * range / visibility);
        return e * white + (1 - e) * air;
    };
    CHECK(std::exp(-2.996) == Approx(0.05).epsilon(1e-3));
    CHECK(middle_off(scene, small({0, 0, 0}, {}), hazed(500, 500, haze)) < kStep);
    CHECK(middle_off(scene, small({0, 250, 0}, {{60}, {0}, {0}}, 1), hazed(500, 500, haze)) <
          kStep);  // slant range 500 again
    for (const double distance : {1.0, 10.0, 100.0, 333.0})
        CHECK(middle_off(scene, small({0, 500 - distance, 0}, {}), hazed(distance, 500, haze)) < kStep);
    CHECK(middle_off(scene, small({0, 0, 0}, {{180}, {30}, {0}}, 0.5), 0.5 * (scene.sky.horizon + scene.sky.zenith)) <
          kStep);

    scene.haze->visibility = std::numeric_limits<double>::infinity();
    CHECK(middle_off(scene, small({0, 0, 0}, {}), white) < kStep);

    Environment clearer;
    clearer.visibility = 2000;
    CHECK(middle_off(scene, small({0, 0, 0}, {}), hazed(500, 2000, haze), clearer) < kStep);
    scene.haze.reset();
    CHECK(middle_off(scene, small({0, 0, 0}, {}), white) < kStep);
    CHECK(middle_off(scene, small({0, 0, 0}, {}), hazed(500, 2000, scene.sky.horizon), clearer) < kStep);
}

TEST_CASE("every instruction set draws the same picture to within a step") {
    Randomness random(5);
    Scene scene = random_scene(random, 30);
    scene.ground = Ground{};
    scene.haze = Haze{300, {0.6, 0.7, 0.8}};
    scene.textures = {{"", {{1, 0.2, 0.3}, {0.7, 0.9, 2}, {0.5, 3.1, 1}}, 0.75, {3, 1}}};
    scene.ground->paint = {{0.3, 0.4, 0.2}, 0u, 0.6, {}};
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        scene.objects[i].paint = {
            {random.between(0, 1), random.between(0, 1), random.between(0, 1)}, 0u, random.between(0, 1), {}};
        if (i % 3 == 0) scene.objects[i].paint.translucence = Translucence{0.15, 0.5, 0.2};
    }
    const View view = look({0, -90, 20}, {{0}, {-8}, {3}}, 320, 240, 60);
    ImageGenerator generator(scene, 2);
    const Picture best = render(generator, view, {12.5, {}, {}});
    for (const std::int64_t target : simd_targets()) {
        const SimdTarget held(target);
        CAPTURE(hwy::TargetName(target));
        CHECK(ImageGenerator::simd_target() == hwy::TargetName(target));
        const Picture other = render(generator, view, {12.5, {}, {}});
        int most = 0;
        for (std::size_t i = 0; i < best.rgba.size(); ++i)
            most = std::max(most, std::abs(best.rgba[i] - other.rgba[i]));
        CHECK(most <= 1);
    }
}
