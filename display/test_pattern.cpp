#include "display/test_pattern.h"

#include <array>
#include <cstring>

#include "display/picture.h"

namespace quadrig::display {

namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr int kBars = 8, kGreys = 16;
constexpr Rgb kWhite{255, 255, 255};

/// Bars count down from white in binary: green is the highest bit, then red, then blue.
Rgb bar_colour(int bar) {
    const auto on = [&](int bit) { return static_cast<std::uint8_t>((kBars - 1 - bar) & bit ? 255 : 0); };
    return {on(2), on(4), on(1)};
}

void put(std::uint8_t* pixel, const Rgb& colour) {
    std::memcpy(pixel, colour.data(), colour.size());
    pixel[3] = 255;
}

}  // namespace

void draw_test_pattern(const FrameImage& picture) {
    const int width = picture.width, height = picture.height, greys_from = 2 * height / 3;
    const auto row_bytes = 4 * static_cast<std::size_t>(width);
    for (int r = 0; r < height; ++r) {
        // Within a band all rows are alike.
        if (r != 0 && r != 1 && r != greys_from && r != height - 1) {
            std::memcpy(picture.row(r), picture.row(r - 1), row_bytes);
            continue;
        }
        for (int c = 0; c < width; ++c) {
            const auto grey = static_cast<std::uint8_t>(17 * (c * kGreys / width));
            const bool edge = r == 0 || r == height - 1 || c == 0 || c == width - 1;
            const Rgb inner = r < greys_from ? bar_colour(c * kBars / width) : Rgb{grey, grey, grey};
            put(pixel(picture, r, c), edge ? kWhite : inner);
        }
    }
}

}  // namespace quadrig::display
