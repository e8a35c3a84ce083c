/// Where a solid can be on the image, and how deep: bounds that are known before any outline is made.
#pragma once

#include <array>
#include <cstddef>
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

/// What bounds of eight solids are made of, one a vector lane, apart from the solids: most objects of a large scene are
/// never touched but by this. Scene axes, metres.
struct alignas(64) SolidExtents {
    static constexpr std::size_t kSolids = 8;
    using Lanes = std::array<double, kSolids>;

    std::array<Lanes, 3> anchor{};
    /// Of a sphere about the anchor, may be infinite. A lane without a solid reaches nowhere, as does a solid that is a
    /// point or nothing.
    Lanes radius;
    /// Of an ellipsoid: how far it reaches from its anchor along n, squared, is n'En. Other than 0 in `is_ellipsoid`.
    std::array<Lanes, 6> extent{};
    Lanes is_ellipsoid{};

    static constexpr double kNowhere = -std::numeric_limits<double>::infinity();
    SolidExtents() { radius.fill(kNowhere); }
    void set(std::size_t lane, const Solid& solid);
    void clear(std::size_t lane) { radius[lane] = kNowhere; }
};

/// Bounds of a single solid.
ImageBounds image_bounds(const Solid& solid, const ScenePoint& eye, const glm::dmat3& eye_from_scene);

}  // namespace quadrig
