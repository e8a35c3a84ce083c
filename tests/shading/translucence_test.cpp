#include <catch2/catch.hpp>

#include "tests/ig_core/random_scene.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// A texture so coarse that T is the same everywhere: with phase 0, 1/4.
const Texture kEven{"even", {{1.0, 1e-9, 0.0}}, 0.0, {0.0, 0.0}};
constexpr double kT = 0.25, kBlendStep = 0.7;

/// Light from everywhere: surfaces have their own colour.
Scene bright() {
    Scene scene;
    scene.sun.ambient = 1;
    scene.sky = {{0.5, 0.25, 0.125}, {0.5, 0.25, 0.125}};
    scene.textures = {kEven};
    return scene;
}

Paint see_through(const Colour& colour, const Translucence& translucence) { return {colour, 0u, 0.0, translucence}; }

Colour behind(const Scene& scene) { return scene.sky.horizon; }

double middle_off(const Scene& scene, const glm::dvec3& eye, const Attitude& attitude, const Colour& expected) {
    const View view = look(eye, attitude, 9, 9, 1);
    const Picture picture = render(scene, view);
    return steps_off(picture.at(4, 4), expected);
}

}  // namespace

TEST_CASE("opacity rises from 0 to 1 across the softness about the threshold") {
    Scene scene = bright();
    scene.objects = {box({-5, 20, -5}, {5, 30, 5})};
    const Colour colour(0.1, 0.6, 0.9);
    for (const double threshold : {0.0, 0.1, 0.19, 0.2, 0.25, 0.3, 0.31, 0.5, 1.0}) {
        scene.objects[0].paint = see_through(colour, {threshold, 1.0, 0.12});
        const double a = std::clamp((kT - threshold) / 0.12 + 0.5, 0.0, 1.0);
        CAPTURE(threshold, a);
        CHECK(middle_off(scene, {0, 0, 0}, {}, a * colour + (1 - a) * behind(scene)) < kBlendStep);
    }
}

TEST_CASE(
    "softness may be as small or great as a double: at its threshold, and where it is endless, opacity is a half") {
    Scene scene = bright();
    scene.objects = {box({-5, 20, -5}, {5, 30, 5})};
    const Colour colour(0.1, 0.6, 0.9);
    const Colour half = 0.5 * colour + 0.5 * behind(scene);
    for (const double softness : {5e-324, 1e-30, 1e-15, 1e-3, 1.0, 1e15, 1e20, 1e300}) {
        CAPTURE(softness);
        scene.objects[0].paint = see_through(colour, {kT, 10.0, softness});
        CHECK(middle_off(scene, {0, 0, 0}, {}, half) < kBlendStep);
        scene.objects[0].paint = see_through(colour, {-10.0, 10.0, softness});
        CHECK(middle_off(scene, {0, 0, 0}, {}, softness > 1e3 ? half : colour) < kBlendStep);
    }
}

TEST_CASE("a ball opens towards its limb, its faces do not") {
    Scene scene = bright();
    scene.objects = {ball({0, 0, 0}, 5)};
    scene.objects[0].planes = {{{0, 0, -1, 3}}};
    const Colour colour(1, 1, 1);
    const Translucence holes{0.2, 0.5, 0.4};
    scene.objects[0].paint = see_through(colour, holes);
    const auto over_sky = [&](double a) { return a * colour + (1 - a) * behind(scene); };
    for (const double aside : {0.0, 1.0, 2.5, 4.0, 4.8}) {
        const double g = 1 - aside * aside / 25;
        const double a = std::clamp((kT - (0.2 + 0.3 * (1 - g))) / 0.4 + 0.5, 0.0, 1.0);
        CAPTURE(aside);
        CHECK(middle_off(scene, {aside, 0, -60}, {{0}, {90}, {0}}, over_sky(a)) < kBlendStep + 0.5);
    }
    const double on_face = std::clamp((kT - 0.2) / 0.4 + 0.5, 0.0, 1.0);
    for (const double aside : {0.0, 3.0, 3.9})
        CHECK(middle_off(scene, {aside, 0, 60}, {{0}, {-90}, {0}}, over_sky(on_face)) < kBlendStep);
}

TEST_CASE("layers stack front to back by distance, each by its own opacity") {
    Scene scene = bright();
    const Colour red(0.9, 0.1, 0.1), green(0.1, 0.9, 0.1), blue(0.1, 0.1, 0.9);
    // Out of order in the file: blue is the nearest, red the furthest and opaque.
    scene.objects = {box({-5, 30, -5}, {5, 31, 5}), box({-5, 20, -5}, {5, 21, 5}), box({-5, 10, -5}, {5, 11, 5})};
    scene.objects[0].paint = {red, 0u, 0.0, {}};
    scene.objects[1].paint = see_through(green, {0.25, 1, 0.4});  // 1/2
    scene.objects[2].paint = see_through(blue, {0.35, 1, 0.4});   // 1/4
    CHECK(middle_off(scene, {0, 0, 0}, {}, 0.25 * blue + 0.75 * (0.5 * green + 0.5 * red)) < kBlendStep);
    CHECK(middle_off(scene, {0, 50, 0}, {{180}, {0}, {0}}, red) < kBlendStep);
}

TEST_CASE("a translucent texture shows the next object, never its own back") {
    Scene scene = bright();
    scene.objects = {ball({0, 30, 0}, 10)};
    scene.objects[0].paint = see_through({1, 1, 1}, {1, 1, 0.01});
    CHECK(middle_off(scene, {0, 0, 0}, {}, behind(scene)) < kBlendStep);
    scene.ground = Ground{{{0.2, 0.9, 0.2}, {}, 0, {}}};
    scene.objects = {ball({0, 0, 15}, 10)};
    scene.objects[0].paint = see_through({1, 1, 1}, {1, 1, 0.01});
    CHECK(middle_off(scene, {0, 0, 60}, {{0}, {-90}, {0}}, {0.2, 0.9, 0.2}) < kBlendStep);
}

TEST_CASE("cloud decks cover from above and below, in the order of their distance") {
    Scene scene = bright();
    const Colour low(0.9, 0.2, 0.1), high(0.1, 0.3, 0.9), ground(0.2, 0.7, 0.2);
    scene.ground = Ground{{ground, {}, 0, {}}};
    scene.cloud_decks = {{200, see_through(high, {0.25, 1, 0.4})},
                         {100, see_through(low, {0.35, 1, 0.4})}};  // 1/2, 1/4
    CHECK(middle_off(scene, {0, 0, 50}, {{0}, {90}, {0}}, 0.25 * low + 0.75 * (0.5 * high + 0.5 * behind(scene))) <
          kBlendStep);
    CHECK(middle_off(scene, {0, 0, 300}, {{0}, {-90}, {0}}, 0.5 * high + 0.5 * (0.25 * low + 0.75 * ground)) <
          kBlendStep);
    CHECK(middle_off(scene, {0, 0, 150}, {{0}, {90}, {0}}, 0.5 * high + 0.5 * behind(scene)) < kBlendStep);
    CHECK(middle_off(scene, {0, 0, 150}, {{0}, {-90}, {0}}, 0.25 * low + 0.75 * ground) < kBlendStep);
}

TEST_CASE("texture lightens and darkens by its weight, and a surface without one keeps its shade") {
    Scene scene = bright();
    scene.sun = {{180}, {0}, 0.4};
    scene.objects = {box({-5, 20, -5}, {5, 30, 5})};
    const Colour colour(0.9, 0.6, 0.3);
    for (const double weight : {0.0, 0.3, 1.0}) {
        scene.objects[0].paint = {colour, 0u, weight, {}};
        CHECK(middle_off(scene, {0, 0, 0}, {}, ((1 - weight) * 1.0 + weight * kT) * colour) < kBlendStep);
    }
    scene.objects[0].paint = {colour, {}, 0.7, Translucence{1, 1, 0.1}};
    CHECK(middle_off(scene, {0, 0, 0}, {}, colour) < kBlendStep);
}
