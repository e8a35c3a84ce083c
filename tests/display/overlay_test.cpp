#include "display/overlay.h"
#include "display/test_pattern.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <string>

#include "tests/display/pictures.h"

using namespace quadrig;
using namespace quadrig::display;

namespace {

bool same_pixel(const FrameImage& a, const FrameImage& b, int row, int column) {
    return std::equal(a.row(row) + 4 * column, a.row(row) + 4 * column + 4, b.row(row) + 4 * column);
}

}  // namespace

TEST_CASE("The test pattern is eight bars over sixteen greys, inside a white line, at any size") {
    for (const auto& [width, height] : {std::pair{160, 120}, {641, 359}, {1, 1}, {17, 2}}) {
        Picture picture(width, height);
        draw_test_pattern(picture.image());
        for (int r = 0; r < height; ++r)
            for (int c = 0; c < width; ++c) {
                const std::uint8_t* p = pixel(picture.image(), r, c);
                std::array<int, 3> expected{};
                if (r == 0 || c == 0 || r == height - 1 || c == width - 1)
                    expected = {255, 255, 255};
                else if (r < 2 * height / 3)
                    expected = std::array<std::array<int, 3>, 8>{{{255, 255, 255},
                                                                  {255, 255, 0},
                                                                  {0, 255, 255},
                                                                  {0, 255, 0},
                                                                  {255, 0, 255},
                                                                  {255, 0, 0},
                                                                  {0, 0, 255},
                                                                  {0, 0, 0}}}[static_cast<std::size_t>(8 * c / width)];
                else
                    expected.fill(17 * (16 * c / width));
                REQUIRE((p[0] == expected[0] && p[1] == expected[1] && p[2] == expected[2] && p[3] == 255));
            }
    }
}

TEST_CASE("A layer laid over a picture is the source-over blend of every pixel within half a step") {
    const std::uint32_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Picture drawing = test::random_picture(37, 23, seed);
    for (std::size_t i = 3; i < drawing.pixels.size(); i += 4) {
        const auto kind = random() % 3;
        drawing.pixels[i] = kind == 0 ? 0 : kind == 1 ? 255 : static_cast<std::uint8_t>(random() & 0xFF);
    }
    const OverlayLayer layer = overlay_layer(drawing.image(), 2, 3, 30, 20);
    for (const auto& [row, column] : {std::pair{5, 6}, std::pair{-4, -7}, std::pair{33, 40}}) {
        Picture picture = test::random_picture(50, 40, seed + 1), before = picture;
        lay_over(layer, picture.image(), row, column);
        for (int r = 0; r < 40; ++r)
            for (int c = 0; c < 50; ++c) {
                const std::uint8_t* under = before.image().row(r) + 4 * c;
                const std::uint8_t* out = picture.image().row(r) + 4 * c;
                const int lr = r - row, lc = c - column;
                const bool inside = lr >= 0 && lr < 20 && lc >= 0 && lc < 30;
                const std::uint8_t* over = inside ? drawing.image().row(lr + 2) + 4 * (lc + 3) : nullptr;
                const double alpha = inside ? over[3] / 255.0 : 0.0;
                for (int i = 0; i < 3; ++i) {
                    const double exact = alpha * (inside ? over[i] : 0) + (1.0 - alpha) * under[i];
                    REQUIRE(out[i] == Approx(exact).margin(0.5 + 1e-9));
                }
                REQUIRE(out[3] == 255);
            }
    }
}

TEST_CASE("The cross is symmetric about the middle of the picture and white there") {
    for (const auto& [width, height] :
         {std::pair{640, 480}, std::pair{641, 481}, std::pair{1920, 1080}, std::pair{33, 20}}) {
        Picture picture(width, height);
        test::fill(picture.image(), 90, 120, 150);
        Picture untouched = picture;
        const Overlay overlay(width, height);
        overlay.lay_over(picture.image(), 0);
        const FrameImage image = picture.image();
        CHECK(image.row(height / 2)[4 * (width / 2)] == 255);
        int changed = 0;
        for (int r = height / 2 - 4; r <= height / 2; ++r)
            for (int c = width / 4; c < 3 * width / 4; ++c) {
                REQUIRE(std::equal(image.row(r) + 4 * c, image.row(r) + 4 * c + 4, image.row(height - 1 - r) + 4 * c));
                changed += !same_pixel(image, untouched.image(), r, c);
            }
        CHECK(changed > 0);
    }
}

TEST_CASE("The frame counter shows the same digit alike wherever it stands, and different digits differently") {
    constexpr int kWidth = 640, kHeight = 480, kCell = 8, kLeft = 16, kTop = 16, kDigitHeight = 12;
    const Overlay overlay(kWidth, kHeight);
    const auto digits_of = [&](std::uint64_t number) {
        Picture picture(kWidth, kHeight);
        test::fill(picture.image(), 90, 120, 150);
        overlay.lay_over(picture.image(), number);
        std::vector<std::string> cells;
        for (int d = 0; d < 6; ++d) {
            std::string cell;
            for (int r = 0; r < kDigitHeight; ++r) {
                const std::uint8_t* p = picture.image().row(kTop + r) + 4 * (kLeft + d * kCell);
                cell.append(p, p + 4 * kCell);
            }
            cells.push_back(cell);
        }
        return cells;
    };
    const auto low = digits_of(12345), high = digits_of(678909);
    const std::vector<std::string> digits{low[0], low[1],  low[2],  low[3],  low[4],
                                          low[5], high[0], high[1], high[2], high[3]};
    for (std::size_t a = 0; a < digits.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) CHECK(digits[a] != digits[b]);
    CHECK(high[4] == digits[0]);
    CHECK(high[5] == digits[9]);
}

TEST_CASE(
    "An overlay touches only its own small part of the picture, also where the picture is smaller than the digits") {
    Picture picture(640, 480);
    test::fill(picture.image(), 90, 120, 150);
    Picture untouched = picture;
    Overlay(640, 480).lay_over(picture.image(), 987654321);
    int changed = 0;
    for (int r = 0; r < 480; ++r)
        for (int c = 0; c < 640; ++c) changed += !same_pixel(picture.image(), untouched.image(), r, c);
    CHECK(changed > 500);
    CHECK(changed < 640 * 480 / 100);

    Picture tiny(1, 1);
    Overlay(1, 1).lay_over(tiny.image(), 18446744073709551615U);
    CHECK(tiny.pixels[3] == 255);
}
