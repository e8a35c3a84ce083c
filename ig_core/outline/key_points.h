/// Which curves and lines can bound a solid's picture, and the key points on them (Gardner 1984, 2.1).
#pragma once

#include "ig_core/outline/curve_lanes.h"
#include "ig_core/outline/outline.h"

namespace quadrig {

/// Adds to `outline` the intersection curves of all planes that cut, in lanes also to `curves`, and the solid's edges
/// as they are seen from the eye whose attitude is given; edges between two planes that face away are hidden and left
/// out. Expects EyeSolid and limb in place.
void find_boundaries(const Solid& solid, const glm::dmat3& eye_from_scene, Outline& outline, CurveLanes& curves);

/// Adds the key points that lie on the solid (to within a tolerance that errs towards keeping one). Expects both as
/// find_boundaries leaves them.
void find_key_points(CurveLanes& curves, Outline& outline);

}  // namespace quadrig
