#include "ig_core/reference/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadrig::reference {
namespace {

/// IEC 61966-2-1, both ways.
double linear_light(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }
double srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

const std::array<double, 256>& linear_light_of_codes() {
    static const std::array<double, 256> light = [] {
        std::array<double, 256> table{};
        for (std::size_t code = 0; code < table.size(); ++code)
            table[code] = linear_light(static_cast<double>(code) / 255.0);
        return table;
    }();
    return light;
}

}  // namespace

VisibilityError& VisibilityError::operator+=(const VisibilityError& other) {
    pixels += other.pixels, ties += other.ties, drawn += other.drawn, wrong += other.wrong;
    depth = std::max(depth, other.depth);
    return *this;
}

VisibilityError visibility_error(const GroundTruth& answer, const GroundTruth& exact,
                                 const std::vector<std::uint8_t>& ties) {
    VisibilityError error;
    error.pixels = static_cast<std::int64_t>(exact.object_ids.size());
    for (std::size_t pixel = 0; pixel < exact.object_ids.size(); ++pixel) {
        if (exact.object_ids[pixel] >= 0) ++error.drawn;
        if (ties[pixel] == kTie) ++error.ties;
        const bool same = answer.object_ids[pixel] == exact.object_ids[pixel] &&
                          answer.surface_ids[pixel] == exact.surface_ids[pixel];
        if (!same && ties[pixel] != kTie && error.wrong++ == 0) error.first_wrong = pixel;
        if (!same || exact.object_ids[pixel] == kSkyId) continue;
        const double off = std::abs(answer.depth[pixel] - exact.depth[pixel]) / exact.depth[pixel];
        const double depth = std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
        if (depth > error.depth) error.depth = depth, error.deepest = pixel;
    }
    return error;
}

double PictureError::psnr() const { return 10.0 * std::log10(3.0 * static_cast<double>(pixels) / squares); }

PictureError& PictureError::operator+=(const PictureError& other) {
    pixels += other.pixels, squares += other.squares, steps += other.steps, beyond_16 += other.beyond_16;
    worst = std::max(worst, other.worst);
    return *this;
}

LinearImage linear_image(const FrameImage& picture) {
    const std::array<double, 256>& light = linear_light_of_codes();
    LinearImage linear{picture.width, picture.height, {}};
    linear.rgb.reserve(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    for (int r = 0; r < picture.height; ++r)
        for (int c = 0; c < picture.width; ++c)
            for (int k = 0; k < 3; ++k) linear.rgb.push_back(static_cast<float>(light[picture.row(r)[4 * c + k]]));
    return linear;
}

PictureError picture_error(const FrameImage& picture, const LinearImage& exact) {
    const std::array<double, 256>& light = linear_light_of_codes();
    PictureError error;
    for (int r = 0; r < exact.height; ++r) {
        for (int c = 0; c < exact.width; ++c) {
            double most = 0.0;
            for (int k = 0; k < 3; ++k) {
                const std::uint8_t code = picture.row(r)[4 * c + k];
                const double right = std::clamp<double>(
                    exact.rgb[3 * static_cast<std::size_t>(r * exact.width + c) + static_cast<std::size_t>(k)], 0.0,
                    1.0);
                const double off = light[code] - right, steps = std::abs(code - 255.0 * srgb(right));
                error.squares += off * off;
                error.steps += steps;
                most = std::max(most, steps);
            }
            error.worst = std::max(error.worst, most);
            error.beyond_16 += most > 16.0 ? 1 : 0;
            ++error.pixels;
        }
    }
    return error;
}

}  // namespace quadrig::reference
