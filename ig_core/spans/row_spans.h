/// Spans of one pixel row: every object's cuts on the row's sub-scan lines, gathered by surface.
#pragma once

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

/// Appends the spans of one object to `spans`. `opaque` is false for an object with holes; `band` is kept from row to
/// row.
void add_object_spans(const Outline& outline, std::uint32_t index, bool opaque, const PixelRow& row, BandPlace& band,
                      std::vector<RowSpan>& spans);

/// Appends the spans of ground and cloud decks, and the sky behind everything.
void add_plane_spans(const PlaneSurfaces& planes, std::span<const std::uint8_t> deck_opaque, const PixelRow& row,
                     std::vector<RowSpan>& spans);

/// Appends the span of a polygon of the ground, if the row shows any of it. `ground` is the plane Z = 0.
void add_polygon_span(const SeenPolygon& polygon, const PlaneDepth& ground, const PixelRow& row,
                      std::vector<RowSpan>& spans);

/// Appends the span of a light, if the row shows any of it: on each sub-scan line as wide as its disc is on the mean
/// over the line's share of the row, so that all of them together are as bright as the disc is large.
void add_light_span(const SeenLight& light, const PixelRow& row, std::vector<RowSpan>& spans);

/// Columns [from, to) that a convex object which lies all in front of the near plane covers whole by its spans on a
/// row, and a bound of 1/k on them: 1/k is concave over such an object's picture, so that the ends of spans bound what
/// lies between.
struct CoveredColumns {
    int from = 0, to = 0;
    double far_u = 0;
};
CoveredColumns columns_covered(std::span<const RowSpan> spans);

/// Fits outer and inner columns to the ends on the sub-scan lines, clipped to the image. False if nothing is left.
bool fit_columns(const PixelRow& row, RowSpan& span);

}  // namespace quadrig
