/// Ellipsoids that hold solids, and their exact extent on the picture.
#pragma once

#include <optional>

#include "ig_core/scene/solid.h"
#include "ig_core/view.h"

namespace quadrig::gl_peer {

/// {p : |n.(p - centre)| <= sqrt(n' S n) for every n}, scene axes, metres.
struct BoundingEllipsoid {
    ScenePoint centre;
    Sym3 spread;  ///< S, positive definite
};

/// The smallest found, by trace of S; none where the solid has no end or none was found. Q <= 0 and P_i, P_j > 0 in
/// the solid, so Q - t P_i P_j <= 0 there for every t >= 0, which closes hills, cylinders and cones between two planes.
/// A hill is given the tangent plane of its apex too.
std::optional<BoundingEllipsoid> bounding_ellipsoid(const Solid& solid, const Shape& shape);

/// A rectangle of the picture, -1..1 each way (GL's clip space), and the largest inverse depth, 1/m.
struct Extent {
    float left = -1, bottom = -1, right = 1, top = 1;
    double inverse_depth = 1.0 / kNearDepth;
};
/// What of the picture an ellipsoid covers: the roots of its limb's dual conic (Sigg et al. 2006, "GPU-based
/// ray-casting of quadratic surfaces"); the whole picture if it reaches behind the eye; nothing if it is out of view.
std::optional<Extent> extent_on(const View& view, const BoundingEllipsoid& bounds);

}  // namespace quadrig::gl_peer
