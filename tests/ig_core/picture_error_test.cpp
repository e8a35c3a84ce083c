#include <catch2/catch.hpp>

#include "ig_core/reference/reference_renderer.h"
#include "tests/ig_core/painted_scene.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

struct Error {
    double psnr;      ///< dB, linear light
    double mean;      ///< linear light
    double worst;     ///< linear light
    int column, row;  ///< of the worst
};

/// The fast picture against supersampling of the exact one. What is left at four sub-scan lines is mostly texture: the
/// filter of a hole's edge is an approximation, worst where its sines are near the sampling frequency.
Error picture_error(const Scene& scene, const View& view, const Environment& environment = {},
                    const Quality& quality = {4}, int samples = 8) {
    const reference::LinearImage exact = reference::picture(scene, view, environment, samples);
    const Picture fast = render(scene, view, environment, quality);
    double squares = 0, sum = 0;
    Error error{0, 0, 0, 0, 0};
    for (int r = 0; r < fast.height; ++r) {
        for (int c = 0; c < fast.width; ++c) {
            for (int k = 0; k < 3; ++k) {
                const auto at = 3 * static_cast<std::size_t>(r * fast.width + c) + static_cast<std::size_t>(k);
                const double off = std::abs(linear_light(fast.at(c, r)[k]) - std::clamp<double>(exact.rgb[at], 0, 1));
                squares += off * off, sum += off;
                if (off > error.worst) error.worst = off, error.column = c, error.row = r;
            }
        }
    }
    const double values = 3.0 * fast.width * fast.height;
    error.psnr = -10 * std::log10(squares / values);
    error.mean = sum / values;
    return error;
}

/// The tree of the smallest scene file, with its ground and a deck.
Scene one_tree() {
    Scene scene;
    scene.sun = {{140}, {40}, 0.3};
    scene.haze = Haze{20000, {0.62, 0.72, 0.82}};
    scene.textures = {
        {"grass", {{1, 0.05, 0.3}, {0.707, 0.11, 1.9}, {0.5, 0.21, 4}}, 0, {0, 0}},
        {"leaves", {{1, 0.9, 6.01}, {0.707, 1.858, 1.35}, {0.5, 3.85, 2.24}, {0.353, 7.96, 0.6}}, 0.75, {0, 0}},
        {"overcast", {{1, 0.002, 1}, {0.7, 0.0043, 2}}, 0, {8, 3}}};
    scene.ground = Ground{{{0.25, 0.33, 0.14}, 0u, 0.6, {}}};
    scene.cloud_decks = {{2000, {{1, 1, 1}, 2u, 0.3, Translucence{0.3, 0.3, 0.2}}}};
    Object tree, hill;
    tree.shape = Ellipsoid{{{0, 100, 6}}, {4, 4, 6}, {}};
    tree.planes = {{{0, 0, 1, -1}}};
    tree.paint = {{0.1, 0.25, 0.05}, 1u, 0.7, Translucence{0.12, 0.45, 0.15}};
    hill.shape = Hill{{{100, 500, 60}}, 200, 0.5};
    hill.planes = {{{0, 0, 1, 0}}};
    hill.paint = {{0.3, 0.35, 0.2}, {}, 0, {}};
    scene.objects = {tree, hill};
    return scene;
}

}  // namespace

TEST_CASE("edges of plain opaque solids are as 64 rays a pixel have them") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(10, 3); ++trial) {
        Randomness random(trial);
        Scene scene = random_scene(random, 12);
        for (Object& object : scene.objects)
            object.paint.colour = {random.between(0, 1), random.between(0, 1), random.between(0, 1)};
        const Error error = picture_error(scene, random_view(random, 96, 72));
        CAPTURE(trial, error.psnr, error.worst, error.column, error.row);
        CHECK(error.psnr > 40);
        CHECK(error.worst < 0.35);
    }
}

TEST_CASE("a tree on a hill's foot under clouds is drawn as the reference draws it") {
    const Scene scene = one_tree();
    for (const View& view :
         {look({0, 60, 4}, {{0}, {3}, {0}}, 120, 90, 40), look({-40, 70, 12}, {{55}, {-5}, {10}}, 120, 90, 60),
          look({0, 0, 2500}, {{10}, {-60}, {0}}, 120, 90, 60)}) {
        const Error error = picture_error(scene, view, {30, {}, {}});
        CAPTURE(view.eye.metres.z, error.psnr, error.worst, error.column, error.row);
        CHECK(error.psnr > 42);
        CHECK(error.mean < 3.5e-3);
    }
}

TEST_CASE("scenes with everything in them are drawn as the reference draws them") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(8, 2); ++trial) {
        Randomness random(trial);
        const Scene scene = painted_scene(random, 15);
        const Error error = picture_error(scene, random_view(random, 96, 72), {random.between(0, 60), {}, {}});
        CAPTURE(trial, error.psnr, error.mean, error.worst, error.column, error.row);
        CHECK(error.psnr > 36);
        CHECK(error.mean < 6e-3);
    }
}

TEST_CASE("more sub-scan lines come closer to the exact picture") {
    Randomness random(4);
    Scene scene = random_scene(random, 25);
    for (Object& object : scene.objects)
        object.paint.colour = {random.between(0, 1), random.between(0, 1), random.between(0, 1)};
    const View view = look({0, -100, 25}, {{0}, {-10}, {7}}, 120, 90, 60);
    double before = 0;
    for (const int lines : {1, 2, 4, 8}) {
        const Error error = picture_error(scene, view, {}, {lines});
        CAPTURE(lines, error.psnr);
        CHECK(error.psnr > before + 0.5);
        before = error.psnr;
    }
}

TEST_CASE("a view window off the middle, pixels not square, shows the same world") {
    const Scene scene = one_tree();
    const View view{{{-20, 40, 8}},
                    eye_from_scene_rotation({{30}, {2}, {5}}),
                    ImagePlane::window(140, 60, {-45}, {10}, {20}, {-30})};
    const Error error = picture_error(scene, view);
    CAPTURE(error.psnr, error.worst, error.column, error.row);
    CHECK(error.psnr > 42);
}

TEST_CASE("drift carries a texture along with scene time, far into a flight") {
    Scene scene = one_tree();
    scene.textures[0].drift = {3, -2};
    const View view = look({0, 0, 60}, {{0}, {-60}, {0}}, 96, 72, 50);
    const Picture at_start = render(scene, view, {0, {}, {}});
    for (const double seconds : {1.0, 10.0, 7200.0}) {
        const Environment environment{seconds, {}, {}};
        const Error error = picture_error(scene, view, environment);
        CAPTURE(seconds, error.psnr);
        CHECK(error.psnr > 46);
        CHECK_FALSE(render(scene, view, environment) == at_start);
    }
}

TEST_CASE("a pattern rises and changes with scene time as the reference has it") {
    Scene scene = one_tree();
    const View view = look({0, 60, 4}, {{0}, {3}, {0}}, 96, 72, 30);
    const Picture still = render(scene, view, {8, {}, {}, {}});
    const double psnr_at_rest = picture_error(scene, view, {8, {}, {}, {}}).psnr;
    for (const bool rises : {false, true}) {
        (rises ? scene.textures[1].rise : scene.textures[1].churn) = 0.7;
        const Environment environment{8, {}, {}, {}};
        const Error error = picture_error(scene, view, environment);
        CAPTURE(rises, error.psnr, psnr_at_rest);
        CHECK(error.psnr > psnr_at_rest - 1);
        CHECK_FALSE(render(scene, view, environment) == still);
    }
}
