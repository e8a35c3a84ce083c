#include "ig_core/outline/image_bounds.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/outline/image_bounds.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ig_core/outline/image_bounds-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {

ImageBounds FirstBounds(const SolidExtents& extents, const ScenePoint& eye, const glm::dmat3& eye_from_scene) {
    BoundsLanes bounds;
    find_bounds(extents, 0, eye, eye_from_scene, bounds);
    return bounds.of(0);
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {

HWY_EXPORT(FirstBounds);

void SolidExtents::set(std::size_t lane, const Solid& solid) {
    for (std::size_t i = 0; i < 3; ++i) anchor[i][lane] = solid.anchor.metres[static_cast<int>(i)];
    const bool is_point = solid.ellipsoid && !(solid.c < 0.0);
    radius[lane] = is_point ? kNowhere : solid.radius;
    const Sym3 e = (-solid.c / solid.determinant) * solid.adjugate;
    const std::array entries{e.xx, e.yy, e.zz, e.xy, e.xz, e.yz};
    for (std::size_t i = 0; i < entries.size(); ++i) extent[i][lane] = entries[i];
    is_ellipsoid[lane] = solid.ellipsoid ? 1.0 : 0.0;
}

ImageBounds image_bounds(const Solid& solid, const ScenePoint& eye, const glm::dmat3& eye_from_scene) {
    SolidExtents extents;
    extents.set(0, solid);
    ImageBounds bounds = HWY_DYNAMIC_DISPATCH(FirstBounds)(extents, eye, eye_from_scene);
    if (extents.radius[0] == SolidExtents::kNowhere) bounds.farthest = SolidExtents::kNowhere;
    return bounds;
}

}  // namespace quadrig
#endif
