/// Pictures to look at, pixel by pixel.
#pragma once

#include <cmath>
#include <vector>

#include "ig_core/image_generator.h"

namespace quadrig::test {

struct Picture {
    int width, height;
    std::vector<std::uint8_t> rgba;

    [[nodiscard]] const std::uint8_t* at(int column, int row) const {
        return &rgba[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(column))];
    }
    friend bool operator==(const Picture&, const Picture&) = default;
};

inline Picture render(ImageGenerator& generator, const View& view, const Environment& environment = {},
                      const Quality& quality = {}) {
    const int width = view.image.width, height = view.image.height;
    Picture picture{width, height,
                    std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
    generator.render(view, environment, quality, {picture.rgba.data(), width, height, 4 * width});
    return picture;
}
inline Picture render(const Scene& scene, const View& view, const Environment& environment = {},
                      const Quality& quality = {}) {
    ImageGenerator generator(scene);
    return render(generator, view, environment, quality);
}

/// 8-bit sRGB of linear light before rounding (IEC 61966-2-1).
inline double srgb_steps(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return 255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}
inline double linear_light(std::uint8_t code) {
    const double s = code / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// Largest difference in 8-bit steps between a pixel and a colour in linear light.
inline double steps_off(const std::uint8_t* pixel, const Colour& expected) {
    double most = 0;
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(pixel[c] - srgb_steps(expected[c])));
    return most;
}

}  // namespace quadrig::test
