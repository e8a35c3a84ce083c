/// Spans of one pixel row: of what has no outline, and what spans of every kind need.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "ig_core/spans/row_span.h"

namespace quadrig {

/// Planes that are not objects, as the frame's eye sees them.
struct PlaneSurfaces {
    PlaneDepth ground;        ///< Z = 0, which markings are painted on
    bool has_ground = false;  ///< whether it is drawn itself
    std::vector<PlaneDepth> decks;
};

/// A polygon of the ground on the image: d' edge >= 0 for all its edges, where the ground is in front of the eye.
struct SeenPolygon {
    std::uint32_t polygon = 0;  ///< index in the scene
    std::array<glm::dvec3, kMaxCorners> edges;
    std::size_t edge_count = 0;
    double z_from = 0, z_to = 0;  ///< rows outside show nothing
};

/// Appends the spans of ground and cloud decks, and the sky behind everything.
void add_plane_spans(const PlaneSurfaces& planes, std::span<const std::uint8_t> deck_opaque, const PixelRow& row,
                     std::vector<RowSpan>& spans);

/// Appends the span of a polygon of the ground, if the row shows any of it. `ground` is the plane Z = 0.
void add_polygon_span(const SeenPolygon& polygon, const PlaneDepth& ground, const PixelRow& row,
                      std::vector<RowSpan>& spans);

/// Appends the span of a light, if the row shows any of it: on each sub-scan line as wide as its disc is on the mean
/// over the line's share of the row, so that all of them together are as bright as the disc is large.
void add_light_span(const SeenLight& light, const PixelRow& row, std::vector<RowSpan>& spans);

/// Gives a span its ends on the sub-scan lines, clipped to the image, and fits outer and inner columns to them. False
/// if nothing is left.
bool fit_columns(const PixelRow& row, const double* from, const double* to, RowSpan& span);
/// The same with the ends it has.
inline bool fit_columns(const PixelRow& row, RowSpan& span) {
    return fit_columns(row, span.from.data(), span.to.data(), span);
}

/// Narrows the bounds of 1/k from the whole object's to the fitted span's own, by its first and last sub-scan line.
/// (What the lines between could add is less than a sub-scan line high.) What is shallow to begin with is left as it
/// is.
void bound_depth(const PixelRow& row, RowSpan& span);
/// Whether bounds of 1/k are so close that nothing is gained by narrower ones.
inline bool is_shallow(double near_u, double far_u) { return near_u < 1.1 * far_u; }

/// The next of the row's spans, empty on all sub-scan lines.
inline RowSpan& empty_span(const PixelRow& row, std::vector<RowSpan>& spans) {
    RowSpan& span = spans.emplace_back();
    std::fill_n(span.from.begin(), row.sub_lines, 0.0);
    std::fill_n(span.to.begin(), row.sub_lines, 0.0);
    return span;
}

}  // namespace quadrig
