#include "ig_core/outline/image_bounds.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace quadrig {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

/// How far a solid reaches from its anchor along n: sqrt(n'En), in eye axes.
Sym3 extent_form(const Solid& solid, const glm::dmat3& scene_from_eye) {
    if (solid.ellipsoid) return congruent((-solid.c / solid.determinant) * solid.adjugate, scene_from_eye);
    const double square = solid.radius * solid.radius;
    return {square, square, square, 0, 0, 0};
}

/// Tangents through the eye across one axis of the image: (centre - t depth)^2 = E_cc - 2 t E_cd + t^2 E_dd.
std::pair<double, double> tangents(double centre, double depth, double cc, double cd, double dd) {
    const double a = depth * depth - dd, b = centre * depth - cd, c = centre * centre - cc;
    const double root = std::sqrt(std::max(0.0, b * b - a * c) + kTangentRounding * b * b);
    return {(b - root) / a, (b + root) / a};
}

}  // namespace

ImageBounds image_bounds(const Solid& solid, const ScenePoint& eye, const glm::dmat3& eye_from_scene) {
    ImageBounds bounds;
    if (solid.ellipsoid && !(solid.c < 0.0)) {
        bounds.farthest = -kNoEnd;  // a point, or nothing
        return bounds;
    }
    if (!solid.ellipsoid && !std::isfinite(solid.radius)) return bounds;
    const glm::dvec3 centre = eye_from_scene * (solid.anchor.metres - eye.metres);
    Sym3 extent = extent_form(solid, glm::transpose(eye_from_scene));
    const double slack = kAnchorRounding * (glm::length(solid.anchor.metres) + glm::length(eye.metres));
    extent = (1.0 + kAnchorShare) * extent;
    const double more = slack * slack / kAnchorShare;
    extent.xx += more, extent.yy += more, extent.zz += more;

    const double reach = std::sqrt(extent.yy);
    bounds.nearest = centre.y - reach, bounds.farthest = centre.y + reach;
    if (!bounds.in_front()) return bounds;
    std::tie(bounds.x_from, bounds.x_to) = tangents(centre.x, centre.y, extent.xx, extent.xy, extent.yy);
    std::tie(bounds.z_from, bounds.z_to) = tangents(centre.z, centre.y, extent.zz, extent.yz, extent.yy);
    return bounds;
}

}  // namespace quadrig
