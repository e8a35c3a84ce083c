/// The shading kernels, dispatched at run time to the best instruction set the machine has.
#pragma once

#include <span>
#include <string_view>

#include "ig_core/shading/shade_job.h"
#include "ig_core/spans/sweep.h"

namespace quadrig {

/// Shades the jobs of a row (image model: Eq 15, light, limb function, translucence, haze) into `buffer`, planar linear
/// light. Jobs stand there one behind the other; up to kShadePadding samples are written past the last one's end. Short
/// ones that follow one another and show one texture are shaded together. Returns how many terms of a texture it was
/// asked for at samples of their own, neither interpolated nor shared.
std::uint64_t shade(std::span<const ShadeInput> jobs, ShadeBuffer& buffer);

/// Evaluates the texturing function without filtering at scene points given relative to the eye, as shading does: for
/// tests.
void texture_values(const FrameTexture& texture, std::span<const float> x, std::span<const float> y,
                    std::span<const float> z, std::span<float> t);

/// Lays a whole run's layers over one another, front to back: samples[i] is where layer i's first column stands in
/// `buffer`.
void composite_whole(const ShadeBuffer& buffer, std::span<const std::uint32_t> samples, int count, ShadeBuffer& row,
                     std::size_t column);

/// A layer of a run of pixels that it covers in part: where its first column stands in the buffer, and its ends. What
/// it covers is told of cells, quarters of a sub-scan line of a pixel. Layers of one group lie side by side (surfaces
/// of one object, objects that abut).
inline constexpr int kCellsPerLine = 4;
inline constexpr int kMaxCells = kCellsPerLine * kMaxSubScanLines;
struct PartialLayer {
    std::uint32_t sample = 0;
    std::uint32_t group = 0;
    const RowSpan* span = nullptr;
};
/// Lays the layers of columns [from, to) over one another, front to back.
void composite_partial(const ShadeBuffer& buffer, std::span<const PartialLayer> layers, int from, int to, int sub_lines,
                       ShadeBuffer& row);

/// The same for layers that lie side by side in front of the last one, which is opaque and covers all of every pixel.
void composite_before_whole(const ShadeBuffer& buffer, std::span<const PartialLayer> layers, int from, int to,
                            int sub_lines, ShadeBuffer& row);

/// `lower` becomes the mean of 2 x 2 samples: of columns 2 i and 2 i + 1 of both rows, `count` of them, from the left.
void average_squares(const ShadeBuffer& upper, int count, ShadeBuffer& lower);

/// Linear light to 8-bit sRGB, R G B 255, `count` pixels of a row. Error against exact rounding below 0.02 of a step.
void pack_srgb8(const ShadeBuffer& row, int count, std::uint8_t* rgba);
/// The same where every sample fills 2 x 2 pixels: `count` pixels of two rows, the last column once if that is odd.
/// `lower` is null where there is no second row.
void pack_srgb8_doubled(const ShadeBuffer& row, int count, std::uint8_t* upper, std::uint8_t* lower);

std::string_view simd_target_name();

}  // namespace quadrig
