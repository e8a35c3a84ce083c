/// How far an answer is from the exact one: what is seen at the pixel centres, and the picture.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "ig_core/reference/reference_renderer.h"

namespace quadrig::reference {

/// Over one or more pictures' pixel centres. Add up with +=.
struct VisibilityError {
    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

    std::int64_t pixels = 0;
    std::int64_t ties = 0;   ///< where more than one (object, surface) is right (kTie)
    std::int64_t drawn = 0;  ///< where an object is seen
    std::int64_t wrong = 0;  ///< another (object, surface) than the exact one, ties apart
    double depth = 0.0;      ///< largest |k - k_exact| / k_exact where identity agrees; infinite where k is no number
    std::size_t first_wrong = kNone, deepest = kNone;  ///< pixels: the first wrong one, and where `depth` was found

    /// Places are kept from the left.
    VisibilityError& operator+=(const VisibilityError& other);
};
VisibilityError visibility_error(const GroundTruth& answer, const GroundTruth& exact,
                                 const std::vector<std::uint8_t>& ties);

/// Over one or more pictures; a step is one of 255 in sRGB. Add up with +=.
struct PictureError {
    std::int64_t pixels = 0;
    double squares = 0.0;               ///< sum over the three colour values of every pixel, linear light
    double steps = 0.0;                 ///< the same sum, steps
    double worst = 0.0;                 ///< steps
    std::int64_t beyond_16 = 0;         ///< pixels with a value more than 16 steps off
    [[nodiscard]] double psnr() const;  ///< dB, linear light, peak 1; infinite where nothing differs
    [[nodiscard]] double mean_steps() const { return steps / (3.0 * static_cast<double>(pixels)); }
    [[nodiscard]] double within_16() const {
        return 1.0 - static_cast<double>(beyond_16) / static_cast<double>(pixels);
    }
    PictureError& operator+=(const PictureError& other);
};
/// The light that a picture's codes stand for (IEC 61966-2-1).
LinearImage linear_image(const FrameImage& picture);
/// `picture` has the exact one's size.
PictureError picture_error(const FrameImage& picture, const LinearImage& exact);

}  // namespace quadrig::reference
