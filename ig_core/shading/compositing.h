/// From shaded samples to pixels: the layers of a row laid over one another, and linear light as 8-bit sRGB. Dispatched
/// at run time to the best instruction set the machine has.
#pragma once

#include <cstdint>
#include <span>

#include "ig_core/shading/shade_job.h"

namespace quadrig {

/// What partly covered pixels are told of: cells, quarters of a sub-scan line of a pixel.
inline constexpr int kCellsPerLine = 4;
inline constexpr int kMaxCells = kCellsPerLine * kMaxSubScanLines;

/// A layer of a run: where column 0 of the row would stand in the buffer (it need not), and its ends, which only pixels
/// covered in part ask for. Layers of one group lie side by side (surfaces of one object, objects that abut).
struct CompositeLayer {
    std::uint32_t origin = 0;
    std::uint32_t group = 0;
    const RowSpan* span = nullptr;
    [[nodiscard]] std::size_t sample(std::size_t column) const { return origin + static_cast<std::uint32_t>(column); }
};

/// Columns [from, to) of a row that show the same layers, front to back.
struct CompositeRun {
    int from = 0, to = 0;
    std::span<const CompositeLayer> layers;
};

/// Lays layers over one another that each cover all of every pixel. Runs go from left to right; what is drawn past the
/// end of one belongs to others, which are drawn later.
void composite_whole(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, ShadeBuffer& row);
/// The same for layers that cover pixels in part.
void composite_partial(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, int sub_lines, ShadeBuffer& row);
/// The same for layers that lie side by side in front of the last one, which is opaque and covers all of every pixel.
void composite_before_whole(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, int sub_lines,
                            ShadeBuffer& row);

/// `lower` becomes the mean of 2 x 2 samples: of columns 2 i and 2 i + 1 of both rows, `count` of them, from the left.
void average_squares(const ShadeBuffer& upper, int count, ShadeBuffer& lower);

/// Linear light to 8-bit sRGB, R G B 255, `count` pixels of a row. Error against exact rounding below 0.02 of a step.
void pack_srgb8(const ShadeBuffer& row, int count, std::uint8_t* rgba);
/// The same; whole runs that are not in `row`, the last layer of each opaque, are laid over one another here.
void pack_srgb8(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, const ShadeBuffer& row, int count,
                std::uint8_t* rgba);
/// The same where every sample fills 2 x 2 pixels: `count` pixels of two rows, the last column once if that is odd.
/// `lower` is null where there is no second row.
void pack_srgb8_doubled(const ShadeBuffer& row, int count, std::uint8_t* upper, std::uint8_t* lower);

}  // namespace quadrig
