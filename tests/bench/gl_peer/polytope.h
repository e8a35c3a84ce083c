/// Polytopes about solids that are not ellipsoids: what an ellipsoid about a hill leaves too wide.
#pragma once

#include <vector>

#include "tests/bench/gl_peer/bounds.h"

namespace quadrig::gl_peer {

/// Corners of a polytope that holds the solid, scene axes, metres from the solid's anchor: its planes, tangent planes
/// of a hill, and the box about its ellipsoid.
std::vector<glm::dvec3> polytope_about(const Solid& solid, const Shape& shape, const BoundingEllipsoid& bounds);

/// What of the picture the polytope covers, no more than `extent`; nothing where it is out of view.
std::optional<Extent> narrowed(const Extent& extent, const View& view, const ScenePoint& anchor,
                               const std::vector<glm::dvec3>& corners);

}  // namespace quadrig::gl_peer
