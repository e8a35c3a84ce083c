/// Which objects may be in view: the first stage of a frame.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "ig_core/outline/image_bounds.h"
#include "ig_core/view.h"

namespace quadrig {

/// A half-space n.p >= offset of the scene, n of unit length.
struct Wall {
    glm::dvec3 normal;
    double offset;
};
/// What bounds a view: near plane and the four sides of the window.
using ViewWalls = std::array<Wall, 5>;

/// What holds eight solids, one a vector lane, apart from them: most objects of a large scene are never touched but by
/// this. Scene axes, metres.
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

/// An object in view; all of it in one line of the caches.
struct alignas(64) InView {
    ImageBounds bounds;
    std::uint32_t object = 0;
    std::uint32_t slot = ~0U;  ///< of its outline (objects_in_view.h)
    std::int32_t first_strip = 0, last_strip = 0;
};

/// Writes to `in_view` those objects that may show on the image, in their order, and returns how many: at most all of
/// them. Their bounds are image_bounds. The first lane of `extents` is that of object `first`.
std::size_t select(std::span<const SolidExtents> extents, std::uint32_t first, const View& view, InView* in_view);

}  // namespace quadrig
