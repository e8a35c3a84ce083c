/// The exact renderer: one ray at a time in extended precision, straight from the numbers of the scene file.
/// It shares only value types with the fast path, so that either can be used to judge the other.
#pragma once

#include <cstdint>
#include <vector>

#include "ig_core/view.h"

namespace quadrig::reference {

/// A picture in linear light, row-major, row 0 at the top, three values a pixel.
struct LinearImage {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;
};

/// More than one answer is right where it changes when the ray moves by 1e-6 pixel. Where it does not, but two depths
/// agree within 1e-9 relative, file order decides, if rounding lets it.
inline constexpr std::uint8_t kTie = 1, kTieInDepth = 2;

/// Ids and depth at the pixel centres. `ties`, where given, is set to kTie, kTieInDepth or 0 at each.
GroundTruth ground_truth(const Scene& scene, const View& view, std::vector<std::uint8_t>* ties = nullptr);

/// The picture by supersampling: `samples` x `samples` rays a pixel, regular grid, mean in linear light.
LinearImage picture(const Scene& scene, const View& view, const Environment& environment, int samples);

/// The limit of supersampling: each pixel by itself, in squares that are quartered wherever their corners and middle
/// show other surfaces or colours, until its mean changes by less than `tolerance` (linear light) from one quartering
/// to the next, or `deepest` quarterings are done. All pixels are quartered three times: what is too thin to be met by
/// any of those 145 rays is not found.
struct ConvergedPicture {
    LinearImage image;
    int open_pixels = 0;    ///< those whose mean still changed by `tolerance` or more at the deepest quartering
    std::int64_t rays = 0;  ///< what it cost
};
ConvergedPicture converged_picture(const Scene& scene, const View& view, const Environment& environment,
                                   double tolerance = 1e-4, int deepest = 9);

/// Linear light to 8-bit sRGB, rounded to nearest (IEC 61966-2-1), into an image of the same size.
void to_srgb8(const LinearImage& linear, const FrameImage& image);

}  // namespace quadrig::reference
