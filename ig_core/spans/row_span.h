/// The span: part of a pixel row on which one surface may be seen. The narrow waist of the image generator: everything
/// that draws makes spans, and everything after the sweep sees nothing else.
///
/// A pixel row is sampled on a few sub-scan lines. A span knows its exact ends on each of them, in columns (column c of
/// the image covers c to c+1); it covers a pixel by as much as its sub-scan lines do.
#pragma once

#include <array>
#include <cstdint>

#include "ig_core/outline/outline.h"

namespace quadrig {

inline constexpr int kMaxSubScanLines = 8;

/// Inverse depth 1/k of a plane over the image, at + x along_x + z along_z: positive in front of the eye.
struct PlaneDepth {
    double at = 0, along_x = 0, along_z = 0;
};

/// A light point on the image: a disc, all of it at one depth.
struct SeenLight {
    std::uint32_t light = 0;       ///< index in the scene
    double x = 0, z = 0;           ///< centre, image plane
    double columns = 0, rows = 0;  ///< radius in pixels, across and down
    double u = 0;                  ///< 1/k
};

/// What a span shows.
struct Surface {
    enum class Kind : std::uint8_t { quadric, face, light, marking, ground, deck, sky };
    Kind kind = Kind::sky;
    bool opaque = true;
    int surface = 0;             ///< surface id in the object
    std::uint32_t index = 0;     ///< of the object, the ground polygon, the light or the cloud deck
    std::uint32_t priority = 0;  ///< wins a tie in depth if smaller: file order, then markings, ground, decks, sky
    const Outline* outline = nullptr;  ///< for quadrics and faces
    const SeenLight* light = nullptr;  ///< for lights
    PlaneDepth plane;                  ///< for markings, ground, decks and (constant) lights
    double near_u = 1.0 / kNearDepth;  ///< bounds of 1/k over all of the span
    double far_u = 0.0;
};

struct RowSpan {
    RowSpan() {}  // NOLINT(modernize-use-equals-default): ends are for their maker to set, not for zeroing first
    Surface surface;
    std::array<double, kMaxSubScanLines> from, to;  ///< columns; from >= to where the sub-scan line misses it
    int outer_from = 0, outer_to = 0;               ///< columns touched
    int inner_from = 0, inner_to = 0;               ///< columns covered whole; empty if from >= to
    int splits = 0;                                 ///< how often the sweep has cut it where surfaces cross
    int depths = -1;                                ///< its place in RowDepths; -1 before it is asked for
};

/// One pixel row and its sub-scan lines.
struct PixelRow {
    int row = 0;
    int sub_lines = 1;
    bool point_samples = false;  ///< a column counts as covered if its centre is: for ids and depth
    DistanceRule distance = DistanceRule::exact;
    int columns = 0;
    double left = 0, column_step = 1;          ///< x = left + column * column_step
    double row_step = 1;                       ///< image-plane height of the row
    std::array<double, kMaxSubScanLines> z{};  ///< image-plane z of each sub-scan line
    [[nodiscard]] double x(double column) const { return left + column * column_step; }
    [[nodiscard]] double column(double at_x) const { return (at_x - left) / column_step; }
};

}  // namespace quadrig
