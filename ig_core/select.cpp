#include "ig_core/select.h"

#include <bit>

#include "ig_core/strip_index.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/select.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ig_core/outline/image_bounds-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {

/// Whether spheres reach into a view; errs on the side of yes.
HWY_INLINE Mask reach_into(const ViewFrustum& frustum, const Vector& centre, Number radius) {
    Mask reaching = radius == radius;
    for (const HalfSpace& half_space : frustum) {
        const Number along = dot(half_space.normal, centre);
        const Number rounding = -1e-9 * (magnitude(along) + std::abs(half_space.offset));
        reaching = hn::And(reaching, along - half_space.offset + radius >= rounding);
    }
    return reaching;
}

HWY_INLINE Mask may_show_on(const ImagePlane& image, const BoundsLanes& bounds, std::size_t at) {
    const Mask across =
        hn::And(Number(bounds.x_to, at) >= image.left, Number(bounds.x_from, at) <= image.x(image.width));
    const Mask down = hn::And(Number(bounds.z_to, at) >= image.z(image.height), Number(bounds.z_from, at) <= image.top);
    return hn::And(Number(bounds.farthest, at) > kNearDepth, hn::And(across, down));
}

std::size_t Select(std::span<const SolidExtents> extents, std::uint32_t first, const View& view,
                   const ViewFrustum& frustum, InView* in_view) {
    BoundsLanes bounds;
    std::size_t count = 0;
    for (const SolidExtents& of : extents) {
        for (std::size_t at = 0; at < SolidExtents::kSolids; at += hn::Lanes(D())) {
            const Mask near = reach_into(frustum, {of.anchor, at}, {of.radius, at});
            if (hn::AllFalse(D(), near)) continue;
            find_bounds(of, at, view.eye, view.eye_from_scene, bounds);
            std::uint8_t bits = 0;
            hn::StoreMaskBits(D(), hn::And(near, may_show_on(view.image, bounds, at)), &bits);
            for (unsigned rest = bits & ((1U << hn::Lanes(D())) - 1); rest != 0; rest &= rest - 1) {
                const auto i = at + static_cast<std::size_t>(std::countr_zero(rest));
                InView& found = in_view[count++];
                found.bounds = bounds.of(i);
                found.object = first + static_cast<std::uint32_t>(i);
                const auto [from, to] = strips_between(view.image, found.bounds.z_from, found.bounds.z_to);
                found.first_strip = from, found.last_strip = to;
            }
        }
        first += SolidExtents::kSolids;
    }
    return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {

HWY_EXPORT(Select);

std::size_t select(std::span<const SolidExtents> extents, std::uint32_t first, const View& view, InView* in_view) {
    return HWY_DYNAMIC_DISPATCH(Select)(extents, first, view, view_frustum(view), in_view);
}

}  // namespace quadrig
#endif
