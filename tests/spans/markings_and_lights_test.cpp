#include <catch2/catch.hpp>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "ig_core/reference/error.h"
#include "tests/ig_core/random_scene.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// A convex polygon about a point: corners on a circle.
GroundPolygon polygon_about(const glm::dvec2& middle, double radius, const Colour& colour, Randomness& random) {
    GroundPolygon polygon;
    const int corners = 3 + random.below(6);
    double angle = random.between(0, 1);
    const bool clockwise = random.chance(0.5);
    for (int i = 0; i < corners; ++i, angle += random.between(0.6, 1.0) * 6.28 / corners) {
        const double a = clockwise ? -angle : angle;
        polygon.corners.push_back(middle + radius * glm::dvec2(std::cos(a), std::sin(a)));
    }
    polygon.paint.colour = colour;
    return polygon;
}

double psnr(const Scene& scene, const View& view, const Quality& quality = {}) {
    Picture picture = render(scene, view, {}, quality);
    const reference::LinearImage exact = reference::picture(scene, view, {}, 8);
    return reference::picture_error({picture.rgba.data(), picture.width, picture.height, 4 * picture.width}, exact)
        .psnr();
}

Scene plain(double visibility = 0) {
    Scene scene;
    scene.ground = Ground{{{0.1, 0.3, 0.05}, {}, 0, {}}};
    if (visibility > 0) scene.haze = Haze{visibility, {0.6, 0.6, 0.6}};
    return scene;
}

/// Light that a light point adds to the picture, in pixels full of white.
double light_in(const Scene& scene, const View& view, const Quality& quality = {}) {
    Scene dark = scene;
    dark.lights.clear();
    const Picture with = render(scene, view, {}, quality), without = render(dark, view, {}, quality);
    double sum = 0;
    for (std::size_t i = 0; i < with.rgba.size(); i += 4)
        sum += linear_light(with.rgba[i]) - linear_light(without.rgba[i]);
    return sum;
}

}  // namespace

TEST_CASE("polygons of the ground are drawn where the reference has them, from above, afar and within") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(12); ++trial) {
        Randomness random(trial);
        Scene scene = plain(random.chance(0.5) ? 3000 : 0);
        if (random.chance(0.2)) scene.ground.reset();
        for (int i = 0; i < 12; ++i)
            scene.ground_polygons.push_back(polygon_about({random.between(-150, 150), random.between(-50, 400)},
                                                          random.log_between(3, 80),
                                                          {random.between(0, 1), random.between(0, 1), 0.5}, random));
        scene.objects.push_back(ball({20, 120, 0}, 15));
        const View view =
            look({random.between(-20, 20), 0, random.log_between(2, 200)},
                 {{random.between(-30, 30)}, {random.between(-40, 3)}, {random.between(-30, 30)}}, 80, 60, 70);
        Quality quality;
        quality.sub_scan_lines = 4;
        CAPTURE(trial);
        CHECK(psnr(scene, view, quality) > 40);
    }
}

TEST_CASE("markings are ground in ids and depth") {
    Randomness random(1);
    Scene scene = plain();
    const View view = look({0, 0, 20}, {{0}, {-10}, {0}}, 64, 48, 60);
    const GroundTruth bare = ImageGenerator(scene).ground_truth(view);
    scene.ground_polygons.push_back(polygon_about({0, 60}, 30, {1, 1, 1}, random));
    scene.lights.push_back({{{0, 60, 1}}, {1, 1, 1}, 5, 0.3, {}});
    const GroundTruth marked = ImageGenerator(scene).ground_truth(view);
    CHECK(marked.object_ids == bare.object_ids);
    CHECK(marked.depth == bare.depth);
}

TEST_CASE("lights are drawn as the reference draws them, behind and in front of things, in clear air and in haze") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(12); ++trial) {
        Randomness random(trial);
        Scene scene = plain(random.chance(0.5) ? 800 : 0);
        scene.cloud_decks.push_back({60, {{0.9, 0.9, 0.9}, {}, 0, {}}});
        for (int i = 0; i < 4; ++i)
            scene.objects.push_back(ball({random.between(-60, 60), random.between(60, 200), 5}, random.between(4, 15)));
        for (int i = 0; i < 30; ++i) {
            LightPoint light{{{random.between(-100, 100), random.between(30, 400), random.between(-1, 8)}},
                             {1, random.between(0.3, 1), random.between(0, 1)},
                             random.log_between(0.5, 4),
                             random.log_between(0.2, 6),
                             {}};
            if (random.chance(0.3)) light.beam = LightPoint::Beam{{random.between(90, 270)}, {90}};
            scene.lights.push_back(light);
        }
        const View view =
            look({0, 0, random.between(3, 40)}, {{0}, {random.between(-10, 2)}, {random.between(-20, 20)}}, 80, 60, 60);
        Quality quality;
        quality.sub_scan_lines = 8;
        CAPTURE(trial);
        CHECK(psnr(scene, view, quality) > 34);
    }
}

TEST_CASE("a light that stands on the ground, or on a cloud deck, is seen from either side, wherever the eye is") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(400); ++trial) {
        Randomness random(trial);
        Scene scene = plain();
        CloudDeck deck;
        deck.altitude = random.between(40, 60);
        deck.paint.colour = {0.2, 0.2, 0.2};
        scene.cloud_decks = {deck};
        const bool on_deck = random.chance(0.3);
        const glm::dvec3 at(random.between(-300, 300), random.between(-300, 300), on_deck ? deck.altitude : 0.0);
        scene.lights = {LightPoint{{at}, {1, 1, 1}, 100, random.log_between(0.1, 5), {}}};
        // From between the two, or from the other side of the one that holds it.
        const double height = random.chance(0.7) ? random.between(1, 39) : on_deck ? random.between(61, 400) : -20.0;
        const glm::dvec3 eye(random.between(-50, 50), random.between(-50, 50), height), way = at - eye;
        const Attitude attitude{{glm::degrees(std::atan2(way.x, way.y)) + random.between(-9, 9)},
                                {glm::degrees(std::atan2(way.z, std::hypot(way.x, way.y))) + random.between(-9, 9)},
                                {random.between(-180, 180)}};
        CAPTURE(trial, at.x, at.y, at.z, eye.x, eye.y, eye.z);
        CHECK(light_in(scene, look(eye, attitude, 65, 49, 30)) > 0.05);
    }
}

TEST_CASE("a far light keeps its brightness wherever it stands between pixels, and adds up to its disc's area") {
    Randomness random(2);
    const double area = std::acos(-1.0) / 4 * kLeastLightPixels * kLeastLightPixels;
    for (int trial = 0; trial < 50; ++trial) {
        Scene scene;
        scene.sky = {{0, 0, 0}, {0, 0, 0}};
        const double distance = random.log_between(500, 30'000);
        scene.lights = {{{{random.between(-3, 3), distance, random.between(-3, 3)}}, {1, 1, 1}, 1.0, 0.3, {}}};
        const View view = look({0, 0, 0}, {}, 320, 240, 40);
        CAPTURE(trial, distance);
        CHECK(light_in(scene, view) == Approx(area).epsilon(0.02));
        for (const ShadingRate rate : {ShadingRate::quarter, ShadingRate::four})
            CHECK(light_in(scene, view, {.shading = rate}) == Approx(area).epsilon(0.02));
        // Sampled at the centres of pixels only, it may be larger than that, but it is there.
        for (const ShadingRate rate : {ShadingRate::quarter, ShadingRate::one})
            CHECK(light_in(scene, view, {.sub_scan_lines = 0, .shading = rate}) > 0.9);
    }
}

TEST_CASE("in haze a light brighter than white is seen from farther than the ground that it stands on") {
    Scene scene = plain(350);
    scene.lights = {{{{0, 700, 30}}, {1, 1, 1}, 50, 0.3, {}}};
    const View view = look({0, 0, 30}, {}, 160, 120, 20);
    // 5 % of 50 times white at twice 350 m: exp(-2.996 * 2) * 50.
    const double expected = 50 * std::exp(-2.996 * 2) * std::acos(-1.0) / 4 * kLeastLightPixels * kLeastLightPixels;
    CHECK(light_in(scene, view) == Approx(expected).epsilon(0.15));
    scene.lights[0].intensity = 0.5;
    CHECK(std::abs(light_in(scene, view)) < 0.03 * expected + 0.06);
}

TEST_CASE("the visible ground segment ends where the contrast of black and white on it falls to 5 %") {
    // Stripes of 1 m across the way, and how their contrast falls with distance.
    constexpr double kHeight = 30, kVisibility = 350;
    Scene scene = plain(kVisibility);
    scene.sun.ambient = 1.0;
    for (int y = 60; y < 420; ++y) {
        const auto stripe = [&](double from, double to, double x, double light) {
            scene.ground_polygons.push_back(
                {{{x - 20, from}, {x + 20, from}, {x + 20, to}, {x - 20, to}}, {Colour(light), {}, 0, {}}});
        };
        stripe(y, y + 1, -20, 1.0);  // white on the left, black on the right
        stripe(y, y + 1, 20, 0.0);
    }
    const View view = look({0, 0, kHeight}, {{0}, {-6}, {0}}, 200, 1200, 8);
    const Picture picture = render(scene, view);
    double farthest = 0;
    for (int row = 0; row < 1200; ++row) {
        const double z = view.image.z(row + 0.5), pitch = -6 * std::acos(-1.0) / 180;
        const double down = -(std::sin(pitch) + z * std::cos(pitch)), along = std::cos(pitch) - z * std::sin(pitch);
        if (down <= 0) continue;
        const double distance = kHeight * along / down;
        const double contrast = linear_light(picture.at(80, row)[0]) - linear_light(picture.at(120, row)[0]);
        if (distance < 410 && contrast >= 0.05) farthest = std::max(farthest, distance);
    }
    CHECK(farthest == Approx(std::sqrt(kVisibility * kVisibility - kHeight * kHeight)).epsilon(0.05));
}
