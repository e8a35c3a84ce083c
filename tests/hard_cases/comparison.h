/// The image generator judged by the reference renderer, on one scene from one eye.
#pragma once

#include <string>

#include "ig_core/image_generator.h"
#include "ig_core/reference/error.h"

namespace quadrig::test {

/// Ids and depth at the pixel centres, and in words where they are wrong.
struct VisibilityErrors : reference::VisibilityError {
    std::string first_wrong_text;  ///< empty if nothing is wrong
    std::string deepest_text;      ///< where `depth` was found
};
VisibilityErrors visibility_errors(const Scene& scene, const View& view, const Quality& quality = {});

/// The drawn picture against the supersampled one, in 8-bit sRGB steps. A value that is not a number, or infinite,
/// shows as a black or white speck: `outlier` is how far the worst pixel lies outside the range of colours that the
/// reference has in the 3 x 3 pixels about it.
struct PictureErrors {
    double mean = 0.0;  ///< against 3 x 3 rays a pixel (16 x 16 for pictures of less than 1000 pixels)
    int outlier = 0;    ///< against 16 x 16 rays a pixel
    std::string worst_pixel;
};
PictureErrors picture_errors(const Scene& scene, const View& view);

/// Draws the picture that picture_errors() judges, and nothing more: for builds that look for faults of another kind.
void draw_picture(const Scene& scene, const View& view);

}  // namespace quadrig::test
