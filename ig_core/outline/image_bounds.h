/// Where a solid can be on the image, and how deep: bounds that are known before any outline is made.
#pragma once

#include <limits>

#include "ig_core/scene/solid.h"

namespace quadrig {

/// Where outlines have the near plane: behind k_near by more than rounding, so that nothing shows of a surface that
/// lies at k_near.
inline constexpr double kNearPlane = kNearDepth * (1.0 + 1e-12);

/// Holds all of a solid that lies in front of the near plane. Image-plane units (distance 1) and metres along the look
/// direction; a solid that reaches behind the near plane, or without end, may be anywhere on the image.
struct ImageBounds {
    double x_from = -std::numeric_limits<double>::infinity(), x_to = std::numeric_limits<double>::infinity();
    double z_from = -std::numeric_limits<double>::infinity(), z_to = std::numeric_limits<double>::infinity();
    double nearest = -std::numeric_limits<double>::infinity(), farthest = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool in_front() const { return nearest > kNearPlane; }  ///< all of it
    /// 1/k is nowhere greater.
    [[nodiscard]] double near_u() const { return 1.0 / (in_front() ? nearest : kNearDepth); }
    [[nodiscard]] bool behind() const { return !(farthest > kNearDepth); }  ///< all of it: nothing is seen
};

/// What bounds allow for: rounding of the tangents' b^2 - a c, whose terms cancel for what is small and far away; and
/// an anchor known to a few units in its last place, by (e + s)^2 <= (1 + d) e^2 + (1 + 1/d) s^2.
inline constexpr double kTangentRounding = 1e-14, kAnchorRounding = 1e-15, kAnchorShare = 1e-8;

/// An ellipsoid is bounded by its own extent, everything else by its bounding sphere; errs on the side of more.
ImageBounds image_bounds(const Solid& solid, const ScenePoint& eye, const glm::dmat3& eye_from_scene);

}  // namespace quadrig
