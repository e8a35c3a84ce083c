/// Spans of one pixel row: every object's cuts on the row's sub-scan lines, gathered by surface.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ig_core/spans/row_span.h"

namespace quadrig {

/// Planes that are not objects, as the frame's eye sees them.
struct PlaneSurfaces {
    std::optional<PlaneDepth> ground;
    std::vector<PlaneDepth> decks;
};

/// Appends the spans of one object to `spans`. `opaque` is false for an object with holes.
void add_object_spans(const Outline& outline, std::uint32_t index, bool opaque, const PixelRow& row,
                      std::vector<RowSpan>& spans);

/// Appends the spans of ground and cloud decks, and the sky behind everything.
void add_plane_spans(const PlaneSurfaces& planes, std::span<const std::uint8_t> deck_opaque, const PixelRow& row,
                     std::vector<RowSpan>& spans);

/// Fits outer and inner columns to the ends on the sub-scan lines, clipped to the image. False if nothing is left.
bool fit_columns(const PixelRow& row, RowSpan& span);

}  // namespace quadrig
