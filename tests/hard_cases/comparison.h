/// The image generator judged by the reference renderer, on one scene from one eye.
#pragma once

#include <cstdint>
#include <string>

#include "ig_core/image_generator.h"
#include "ig_core/reference/reference_renderer.h"

namespace quadrig::test {

/// Ids and depth at the pixel centres.
struct VisibilityErrors {
    int pixels = 0;
    int ties = 0;               ///< pixels at which the answer changes when the ray moves by 1e-6 pixel
    int drawn = 0;              ///< pixels that show an object
    int wrong = 0;              ///< other (object, surface) than the reference's, ties apart
    double depth = 0.0;         ///< largest |k - k_exact| / k_exact where identity agrees
    std::string first_wrong;    ///< where, and what was seen there; empty if nothing is wrong
    std::string deepest_error;  ///< where `depth` was found
};
VisibilityErrors visibility_errors(const GroundTruth& answer, const GroundTruth& exact,
                                   const std::vector<std::uint8_t>& ties, int width);
VisibilityErrors visibility_errors(const Scene& scene, const View& view);

/// The drawn picture against the supersampled one, in 8-bit sRGB steps. A value that is not a number, or infinite,
/// shows as a black or white speck: `outlier` is how far the worst pixel lies outside the range of colours that the
/// reference has in the 3 x 3 pixels about it.
struct PictureErrors {
    double mean = 0.0;  ///< against 3 x 3 rays a pixel (16 x 16 for pictures of less than 1000 pixels)
    int outlier = 0;    ///< against 16 x 16 rays a pixel
    std::string worst_pixel;
};
PictureErrors picture_errors(const Scene& scene, const View& view);

}  // namespace quadrig::test
