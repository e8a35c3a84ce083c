/// Polygons of the ground and light points as one eye sees them.
#pragma once

#include <vector>

#include "ig_core/spans/row_spans.h"
#include "ig_core/view.h"

namespace quadrig {

/// Replaces `seen` by those that may show; keeps its memory. Corners behind the eye are no matter: an edge is the plane
/// through it and the eye.
void look_at(const std::vector<GroundPolygon>& polygons, const View& view, std::vector<SeenPolygon>& seen);

/// Replaces `seen` by the lights in front of the eye whose beams reach it and whose discs touch the image. No disc is
/// smaller than `least_diameter` (image plane).
void look_at(const std::vector<LightPoint>& lights, const View& view, double least_diameter,
             std::vector<SeenLight>& seen);

}  // namespace quadrig
