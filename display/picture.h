/// A picture that owns its memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ig_core/view.h"

namespace quadrig::display {

/// RGBA8, row 0 at the top, rows without padding. `image()` stays valid until the picture is moved from or destroyed.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;

    Picture() = default;
    Picture(int w, int h)
        : width(w), height(h), pixels(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    [[nodiscard]] FrameImage image() { return {pixels.data(), width, height, std::ptrdiff_t{4} * width}; }
};

/// The four bytes of a pixel.
inline std::uint8_t* pixel(const FrameImage& image, int row, int column) {
    return image.row(row) + std::ptrdiff_t{4} * column;
}

/// Copies the visible pixels. Both have one size.
void copy_pixels(const FrameImage& from, const FrameImage& to);

}  // namespace quadrig::display
