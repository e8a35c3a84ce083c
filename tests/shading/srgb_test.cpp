#include <catch2/catch.hpp>
#include <limits>

#include "ig_core/shading/compositing.h"
#include "tests/ig_core/rendering.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// `light` in red; green its complement, blue 0.
std::vector<std::uint8_t> packed(const std::vector<float>& light) {
    ShadeBuffer row;
    row.resize(light.size() + kShadePadding);
    for (std::size_t i = 0; i < light.size(); ++i) row.red[i] = light[i], row.green[i] = 1 - light[i], row.blue[i] = 0;
    std::vector<std::uint8_t> rgba(4 * light.size() + 4, 77);
    pack_srgb8(row, static_cast<int>(light.size()), rgba.data());
    return rgba;
}

}  // namespace

TEST_CASE("8-bit sRGB is within 0.52 of a step of the exact curve over all of 0..1, on every instruction set") {
    constexpr int kSteps = 300'000;
    std::vector<float> light;
    for (int i = 0; i <= kSteps; ++i) light.push_back(static_cast<float>(i) / kSteps);
    for (int i = 0; i < 2000; ++i) light.push_back(0.006F * static_cast<float>(i) / 2000);  // about the toe
    for (const std::int64_t target : simd_targets()) {
        const SimdTarget held(target);
        CAPTURE(hwy::TargetName(target));
        const auto rgba = packed(light);
        double worst = 0;
        for (std::size_t i = 0; i < light.size(); ++i) {
            worst = std::max({worst, std::abs(rgba[4 * i] - srgb_steps(light[i])),
                              std::abs(rgba[4 * i + 1] - srgb_steps(1.0F - light[i])), 1.0 * rgba[4 * i + 2]});
            if (rgba[4 * i + 3] != 255) FAIL("alpha at " << i);
        }
        CHECK(worst < 0.52);
        CHECK(worst > 0.45);  // rounding to nearest is half a step off somewhere
    }
}

TEST_CASE("light out of range is clamped, and nothing is written past the row") {
    for (std::size_t count : {1u, 2u, 3u, 7u, 15u, 16u, 17u, 33u}) {
        std::vector<float> light(count, 0.5F);
        light.front() = -3.0F;
        light.back() = std::numeric_limits<float>::infinity();
        if (count > 1) light[count / 2] = count > 2 ? 1.5F : light[count / 2];
        for (const std::int64_t target : simd_targets()) {
            const SimdTarget held(target);
            const auto rgba = packed(light);
            CAPTURE(count, hwy::TargetName(target));
            if (count > 1) CHECK(rgba[0] == 0);
            CHECK(rgba[4 * (count - 1)] == 255);
            if (count > 2) CHECK(rgba[4 * (count / 2)] == 255);
            for (std::size_t i = 4 * count; i < rgba.size(); ++i) CHECK(rgba[i] == 77);
        }
    }
}

TEST_CASE("doubled, every sample fills two columns of two rows, and nothing is written past them") {
    for (const int count : {1, 2, 3, 8, 15, 16, 31, 32, 33, 66, 131}) {
        const auto width = static_cast<std::size_t>(count), samples = (width + 1) / 2;
        ShadeBuffer row;
        row.resize(samples + kShadePadding);
        for (std::size_t i = 0; i < samples; ++i)
            row.red[i] = static_cast<float>(i) / 70, row.green[i] = 1 - row.red[i], row.blue[i] = 0.1F;
        for (const std::int64_t target : simd_targets()) {
            const SimdTarget held(target);
            CAPTURE(count, hwy::TargetName(target));
            std::vector<std::uint8_t> single(4 * samples), expected, upper(4 * width + 8, 77), lower = upper;
            pack_srgb8(row, static_cast<int>(samples), single.data());
            for (std::size_t i = 0; i < 4 * width; ++i) expected.push_back(single[i / 8 * 4 + i % 4]);
            expected.insert(expected.end(), 8, 77);
            pack_srgb8_doubled(row, count, upper.data(), lower.data());
            CHECK(upper == expected);
            CHECK(lower == expected);
            std::fill(upper.begin(), upper.end(), 77);
            pack_srgb8_doubled(row, count, upper.data(), nullptr);
            CHECK(upper == expected);
        }
    }
}

TEST_CASE("every 8-bit code comes back from the light it stands for") {
    std::vector<float> light;
    for (int code = 0; code < 256; ++code)
        light.push_back(static_cast<float>(linear_light(static_cast<std::uint8_t>(code))));
    const auto rgba = packed(light);
    for (std::size_t code = 0; code < 256; ++code) CHECK(rgba[4 * code] == code);
}
