#include "ig_core/reference/error.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace quadrig;
using namespace quadrig::reference;

namespace {

struct Pictures {
    Pictures(int width, int height, float linear)
        : exact{width, height, std::vector<float>(static_cast<std::size_t>(3 * width * height), linear)},
          rgba(static_cast<std::size_t>(4 * width * height)) {
        to_srgb8(exact, image());
    }
    [[nodiscard]] FrameImage image() { return {rgba.data(), exact.width, exact.height, 4 * exact.width}; }
    LinearImage exact;
    std::vector<std::uint8_t> rgba;
};

}  // namespace

TEST_CASE("a picture that is the exact one's rounding differs by half a step at most") {
    Pictures p(16, 16, 0);
    for (std::size_t i = 0; i < p.exact.rgb.size(); ++i) p.exact.rgb[i] = static_cast<float>(i) / 768.0F;
    to_srgb8(p.exact, p.image());
    const PictureError error = picture_error(p.image(), p.exact);
    CHECK(error.pixels == 256);
    CHECK(error.worst <= 0.501);
    CHECK(error.mean_steps() == Approx(0.25).margin(0.03));  // evenly spread roundings
    CHECK(error.within_16() == 1.0);
    CHECK(error.psnr() > 55);
}

TEST_CASE("the light that a picture's codes stand for is coded as they are") {
    std::vector<std::uint8_t> codes(4 * 256, 255), again = codes;
    for (std::size_t i = 0; i < 256; ++i)
        for (std::size_t k = 0; k < 3; ++k) codes[4 * i + k] = static_cast<std::uint8_t>(k == 1 ? 255 - i : i);
    // Two rows, from the bottom up.
    const LinearImage light = linear_image({codes.data() + 4 * 128, 128, 2, -4 * 128});
    REQUIRE(light.rgb.size() == 3 * 256);
    to_srgb8(light, {again.data() + 4 * 128, 128, 2, -4 * 128});
    CHECK(again == codes);
    CHECK(light.rgb[3 * 127] == Approx(1.0));
    CHECK(light.rgb[3 * 128] == 0.0F);
}

TEST_CASE("PSNR, mean and worst step are those of the one pixel that is off") {
    Pictures p(10, 10, 1.0F);  // white: code 255
    p.rgba[4 * 37 + 1] = 188;  // linear light 0.5029
    const double light = std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4);
    const PictureError error = picture_error(p.image(), p.exact);
    CHECK(error.psnr() == Approx(10 * std::log10(300 / ((1 - light) * (1 - light)))));
    CHECK(error.worst == Approx(67));
    CHECK(error.mean_steps() == Approx(67.0 / 300));
    CHECK(error.within_16() == Approx(0.99));
    PictureError both = error;
    both += picture_error(Pictures(10, 10, 1.0F).image(), p.exact);
    CHECK(both.pixels == 200);
    CHECK(both.within_16() == Approx(0.995));
    CHECK(both.worst == Approx(67));
}

TEST_CASE("identity errors leave true ties out, and depth counts where identity agrees") {
    GroundTruth exact;
    exact.resize(5);
    exact.object_ids = {0, 0, 1, 2, kSkyId};
    exact.depth = {10, 10, 20, 30, std::numeric_limits<double>::infinity()};
    GroundTruth answer = exact;
    answer.object_ids[1] = 3;  // wrong
    answer.object_ids[2] = 3;  // wrong, but a tie
    answer.depth = {10.01, 99, 99, 30.003, 5};
    const VisibilityError error = visibility_error(answer, exact, {0, 0, kTie, kTieInDepth, 0});
    CHECK(error.wrong == 1);
    CHECK(error.first_wrong == 1);
    CHECK(error.ties == 1);
    CHECK(error.drawn == 4);
    CHECK(error.depth == Approx(1e-3));
    CHECK(error.deepest == 0);
    answer.depth[3] = std::nan("");
    CHECK(std::isinf(visibility_error(answer, exact, {0, 0, kTie, 0, 0}).depth));
}
