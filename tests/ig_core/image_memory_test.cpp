#include <catch2/catch.hpp>

#include "tests/ig_core/painted_scene.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

TEST_CASE("rows of an image may be padded, and may run from the bottom up") {
    Randomness random(9);
    ImageGenerator generator(painted_scene(random, 20), 2);
    const auto [width, height] =
        GENERATE(table<int, int>({{97, 53}, {1, 1}, {1, 40}, {40, 1}, {16, 16}, {15, 9}, {333, 8}}));
    for (const ShadingRate rate : {ShadingRate::one, ShadingRate::quarter, ShadingRate::eighth, ShadingRate::four}) {
        const View view = look({0, -80, 20}, {{0}, {-10}, {0}}, width, height, 60);
        const Quality quality{.shading = rate};
        const Picture plain = render(generator, view, {}, quality);
        const auto row_bytes = static_cast<std::size_t>(4 * width + 20);
        for (const bool bottom_up : {false, true}) {
            std::vector<std::uint8_t> memory(row_bytes * static_cast<std::size_t>(height), 99);
            const auto step = static_cast<std::ptrdiff_t>(row_bytes);
            FrameImage image{memory.data(), width, height, step};
            if (bottom_up) image = {memory.data() + (height - 1) * step, width, height, -step};
            generator.render(view, {}, quality, image);
            CAPTURE(width, height, static_cast<int>(rate), bottom_up);
            for (int r = 0; r < height; ++r) {
                REQUIRE(std::equal(image.row(r), image.row(r) + 4 * width, plain.at(0, r)));
                const std::uint8_t* padding = image.row(r) + 4 * width;
                REQUIRE(std::all_of(padding, padding + 20, [](std::uint8_t byte) { return byte == 99; }));
            }
        }
        for (std::size_t i = 3; i < plain.rgba.size(); i += 4) REQUIRE(plain.rgba[i] == 255);
    }
}

TEST_CASE("stage times add up to no more than the frame took") {
    Randomness random(9);
    ImageGenerator generator(painted_scene(random, 50), 2);
    const View view = look({0, -80, 20}, {{0}, {-10}, {0}}, 320, 240, 60);
    std::vector<std::uint8_t> memory(4 * 320 * 240);
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const StageTimes times = generator.render(view, {}, {}, {memory.data(), 320, 240, 4 * 320});
        const auto took = std::chrono::steady_clock::now() - start;
        std::chrono::nanoseconds sum{0};
        for (const auto& time : times) {
            CHECK(time.count() >= 0);
            sum += time;
        }
        CHECK(sum <= took);
        CHECK(sum.count() > 0);
    }
}
