#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/view.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

TEST_CASE("pixel centres look along d = ((c + 0.5 - W/2)/F, 1, (H/2 - r - 0.5)/F)") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(200); ++trial) {
        Randomness random(trial);
        const int width = 1 + random.below(4000), height = 1 + random.below(3000);
        const double fov = random.between(1, 179);
        const double f = width / 2.0 / std::tan(fov / 2 * 3.14159265358979323846 / 180);
        const ImagePlane image = ImagePlane::symmetric(width, height, {fov});
        const int c = random.below(width), r = random.below(height);
        CAPTURE(trial, width, height, fov, c, r);
        const double size = std::max(width, height) / f;
        REQUIRE(image.width == width);
        REQUIRE(image.height == height);
        REQUIRE(std::abs(image.x(c + 0.5) - (c + 0.5 - width / 2.0) / f) < 1e-14 * size);
        REQUIRE(std::abs(image.z(r + 0.5) - (height / 2.0 - r - 0.5) / f) < 1e-14 * size);
    }
}

TEST_CASE("a view window's edges look along its half angles, pixels square or not") {
    const ImagePlane image = ImagePlane::window(300, 50, {-40}, {10}, {25}, {-60});
    const auto tangent = [](double degrees) { return std::tan(degrees * 3.14159265358979323846 / 180); };
    CHECK(image.x(0) == Approx(tangent(-40)).epsilon(1e-15));
    CHECK(image.x(300) == Approx(tangent(10)).epsilon(1e-14));
    CHECK(image.z(0) == Approx(tangent(25)).epsilon(1e-15));
    CHECK(image.z(50) == Approx(tangent(-60)).epsilon(1e-14));
    CHECK(image.column_step != Approx(image.row_step));
}

TEST_CASE("a symmetric window with square pixels is the symmetric image plane") {
    const ImagePlane a = ImagePlane::symmetric(640, 480, {60});
    const double top = std::atan(0.75 * std::tan(Degrees{30}.radians()));
    const ImagePlane b =
        ImagePlane::window(640, 480, {-30}, {30}, Degrees::from_radians(top), Degrees::from_radians(-top));
    CHECK(a.left == Approx(b.left).epsilon(1e-14));
    CHECK(a.top == Approx(b.top).epsilon(1e-14));
    CHECK(a.column_step == Approx(b.column_step).epsilon(1e-14));
    CHECK(a.row_step == Approx(b.row_step).epsilon(1e-14));
}

TEST_CASE("row 0 is the top row whether rows go down or up in memory") {
    std::uint8_t bytes[4 * 3 * 2] = {};
    const FrameImage down{bytes, 3, 2, 12}, up{bytes + 12, 3, 2, -12};
    CHECK(down.row(0) == bytes);
    CHECK(down.row(1) == bytes + 12);
    CHECK(up.row(0) == bytes + 12);
    CHECK(up.row(1) == bytes);
}
