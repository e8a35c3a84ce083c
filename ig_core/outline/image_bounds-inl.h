/// Bounds of some solids on the image at a time, one a vector lane.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_IMAGE_BOUNDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_IMAGE_BOUNDS_INL_H_
#undef QUADRIG_IMAGE_BOUNDS_INL_H_
#else
#define QUADRIG_IMAGE_BOUNDS_INL_H_
#endif

#include "ig_core/outline/image_bounds.h"
#include "ig_core/outline/image_forms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {

/// Bounds allow for the rounding of the tangents' b^2 - a c, whose terms cancel for what is small and far away; and for
/// an anchor known to a few units in its last place, by (e + s)^2 <= (1 + d) e^2 + (1 + 1/d) s^2.
constexpr double kTangentRounding = 1e-14, kAnchorRounding = 1e-15, kAnchorShare = 1e-8;

/// Tangents through the eye across one axis of the image: (centre - t depth)^2 = E_cc - 2 t E_cd + t^2 E_dd.
struct Tangents {
    Number from, to;
};
HWY_INLINE Tangents find_tangents(Number centre, Number depth, Number cc, Number cd, Number dd) {
    const Number a = depth * depth - dd, b = centre * depth - cd, c = centre * centre - cc;
    const Number root = square_root(larger(b * b - a * c, 0.0) + kTangentRounding * b * b);
    return {(b - root) / a, (b + root) / a};
}

/// ImageBounds, one a lane.
struct BoundsLanes {
    SolidExtents::Lanes x_from, x_to, z_from, z_to, nearest, farthest;
    [[nodiscard]] ImageBounds of(std::size_t lane) const {
        return {x_from[lane], x_to[lane], z_from[lane], z_to[lane], nearest[lane], farthest[lane]};
    }
};

/// An ellipsoid is bounded by its own extent, everything else by its bounding sphere; errs on the side of more.
HWY_INLINE void find_bounds(const SolidExtents& of, std::size_t at, const ScenePoint& eye,
                            const glm::dmat3& eye_from_scene, BoundsLanes& bounds) {
    const glm::dmat3 axes = glm::transpose(eye_from_scene);  // of the eye, in the scene
    const Vector anchor(of.anchor, at), to_anchor = anchor - Vector(eye.metres);
    const Number depth = dot(axes[1], to_anchor);
    const Number xx(of.extent[0], at), yy(of.extent[1], at), zz(of.extent[2], at);
    const Number xy(of.extent[3], at), xz(of.extent[4], at), yz(of.extent[5], at);
    const auto extent_along = [&](const Vector& n) HWY_ATTR {
        return Vector(dot({xx, xy, xz}, n), dot({xy, yy, yz}, n), dot({xz, yz, zz}, n));
    };
    const Vector across(axes[0]), along(axes[1]), up(axes[2]);
    const Vector of_across = extent_along(across), of_along = extent_along(along), of_up = extent_along(up);

    const Mask is_ellipsoid = Number(of.is_ellipsoid, at) != 0.0;
    const Number radius(of.radius, at), sphere = radius * radius;
    const Number slack = kAnchorRounding * (square_root(dot(anchor, anchor)) + glm::length(eye.metres));
    const Number more = slack * slack / kAnchorShare;
    const auto square = [&](Number of_ellipsoid) HWY_ATTR {
        return (1.0 + kAnchorShare) * either(is_ellipsoid, of_ellipsoid, sphere) + more;
    };
    const auto mixed = [&](Number of_ellipsoid)
                           HWY_ATTR { return (1.0 + kAnchorShare) * either(is_ellipsoid, of_ellipsoid, 0.0); };
    const Number dd = square(dot(along, of_along)), reach = square_root(dd), nearest = depth - reach;
    const Tangents x =
        find_tangents(dot(across, to_anchor), depth, square(dot(across, of_across)), mixed(dot(across, of_along)), dd);
    const Tangents z = find_tangents(dot(up, to_anchor), depth, square(dot(up, of_up)), mixed(dot(along, of_up)), dd);

    constexpr double kNoEnd = std::numeric_limits<double>::infinity();
    const Mask in_front = nearest > kNearPlane;
    either(in_front, x.from, -kNoEnd).store(bounds.x_from, at), either(in_front, x.to, kNoEnd).store(bounds.x_to, at);
    either(in_front, z.from, -kNoEnd).store(bounds.z_from, at), either(in_front, z.to, kNoEnd).store(bounds.z_to, at);
    nearest.store(bounds.nearest, at), (depth + reach).store(bounds.farthest, at);
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
