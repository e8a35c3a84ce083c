#include "ig_core/select.h"

#include <bit>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "ig_core/strip_index.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/select.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, SolidExtents::kSolids>;
using V = hn::Vec<D>;
using Mask = hn::Mask<D>;

/// Sums of three products, rounded as GLM's are.
HWY_INLINE V dot(const V* a, const V* b) {
    return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
}
HWY_INLINE V dot(const glm::dvec3& a, const V* b) {
    const V of_all[] = {hn::Set(D(), a.x), hn::Set(D(), a.y), hn::Set(D(), a.z)};
    return dot(of_all, b);
}

/// Whether the spheres reach into a view; errs on the side of yes.
HWY_INLINE Mask reaches_into(const ViewWalls& walls, const V* anchor, V radius) {
    const D d;
    const V rounding = hn::Set(d, -1e-9);
    Mask reaches = hn::Eq(radius, radius);
    for (const Wall& wall : walls) {
        const V along = dot(wall.normal, anchor), offset = hn::Set(d, wall.offset);
        const V least = hn::Mul(rounding, hn::Add(hn::Abs(along), hn::Abs(offset)));
        reaches = hn::And(reaches, hn::Ge(hn::Add(hn::Sub(along, offset), radius), least));
    }
    return reaches;
}

struct BoundsLanes {
    HWY_ALIGN SolidExtents::Lanes x_from, x_to, z_from, z_to, nearest, farthest;
    [[nodiscard]] ImageBounds of(std::size_t i) const {
        return {x_from[i], x_to[i], z_from[i], z_to[i], nearest[i], farthest[i]};
    }
};

struct Range {
    V from, to;
};

/// As in image_bounds.cpp.
HWY_INLINE Range tangents(V centre, V depth, V cc, V cd, V dd) {
    const D d;
    const V a = hn::Sub(hn::Mul(depth, depth), dd), b = hn::Sub(hn::Mul(centre, depth), cd);
    const V c = hn::Sub(hn::Mul(centre, centre), cc);
    const V square = hn::Max(hn::Sub(hn::Mul(b, b), hn::Mul(a, c)), hn::Zero(d));
    const V root = hn::Sqrt(hn::Add(square, hn::Mul(hn::Mul(hn::Set(d, kTangentRounding), b), b)));
    return {hn::Div(hn::Sub(b, root), a), hn::Div(hn::Add(b, root), a)};
}

/// image_bounds, bit for bit; tells which may show on the image.
HWY_INLINE Mask find_bounds(const SolidExtents& of, std::size_t at, const V* anchor, const View& view, V eye_distance,
                            BoundsLanes& out) {
    const D d;
    const V no_end = hn::Inf(d);
    const glm::dmat3 axes = glm::transpose(view.eye_from_scene);  // of the eye, in the scene
    const glm::dvec3& eye = view.eye.metres;
    const V from_eye[] = {hn::Sub(anchor[0], hn::Set(d, eye.x)), hn::Sub(anchor[1], hn::Set(d, eye.y)),
                          hn::Sub(anchor[2], hn::Set(d, eye.z))};
    const V centre_x = dot(axes[0], from_eye), centre_y = dot(axes[1], from_eye), centre_z = dot(axes[2], from_eye);

    const auto lane = [&](std::size_t i) HWY_ATTR { return hn::Load(d, &of.extent[i][at]); };
    const V xx = lane(0), yy = lane(1), zz = lane(2), xy = lane(3), xz = lane(4), yz = lane(5);
    const V rows[3][3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
    const Mask is_ellipsoid = hn::Ne(hn::Load(d, &of.is_ellipsoid[at]), hn::Zero(d));
    const V radius = hn::Load(d, &of.radius[at]), sphere = hn::Mul(radius, radius);
    V along[3][3];  // E times each axis
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 3; ++i) {
            const V of_axis[] = {hn::Set(d, axes[axis].x), hn::Set(d, axes[axis].y), hn::Set(d, axes[axis].z)};
            along[axis][i] = dot(rows[i], of_axis);
        }
    const V share = hn::Set(d, 1.0 + kAnchorShare);
    const V slack = hn::Mul(hn::Set(d, kAnchorRounding), hn::Add(hn::Sqrt(dot(anchor, anchor)), eye_distance));
    const V more = hn::Div(hn::Mul(slack, slack), hn::Set(d, kAnchorShare));
    const auto square = [&](int axis) HWY_ATTR {
        return hn::Add(hn::Mul(share, hn::IfThenElse(is_ellipsoid, dot(axes[axis], along[axis]), sphere)), more);
    };
    const auto mixed = [&](int axis, int other) HWY_ATTR {
        return hn::Mul(share, hn::IfThenElseZero(is_ellipsoid, dot(axes[axis], along[other])));
    };
    const V depth2 = square(1), reach = hn::Sqrt(depth2);
    const V nearest = hn::Sub(centre_y, reach), farthest = hn::Add(centre_y, reach);
    const Mask in_front = hn::Gt(nearest, hn::Set(d, kNearDepth));
    const auto put = [&](Range range, SolidExtents::Lanes& from, SolidExtents::Lanes& to) HWY_ATTR {
        range = {hn::IfThenElse(in_front, range.from, hn::Neg(no_end)), hn::IfThenElse(in_front, range.to, no_end)};
        hn::Store(range.from, d, &from[at]), hn::Store(range.to, d, &to[at]);
        return range;
    };
    const Range x = put(tangents(centre_x, centre_y, square(0), mixed(0, 1), depth2), out.x_from, out.x_to);
    const Range z = put(tangents(centre_z, centre_y, square(2), mixed(1, 2), depth2), out.z_from, out.z_to);
    hn::Store(nearest, d, &out.nearest[at]), hn::Store(farthest, d, &out.farthest[at]);

    const ImagePlane& image = view.image;
    const Mask across = hn::And(hn::Ge(x.to, hn::Set(d, image.left)), hn::Le(x.from, hn::Set(d, image.x(image.width))));
    const Mask down = hn::And(hn::Le(z.from, hn::Set(d, image.top)), hn::Ge(z.to, hn::Set(d, image.z(image.height))));
    return hn::And(hn::Gt(farthest, hn::Set(d, kNearDepth)), hn::And(across, down));
}

std::size_t Select(std::span<const SolidExtents> extents, std::uint32_t first, const View& view, const ViewWalls& walls,
                   InView* in_view) {
    const D d;
    const V eye_distance = hn::Set(d, glm::length(view.eye.metres));  // from the scene's origin
    BoundsLanes bounds;
    std::size_t count = 0;
    for (const SolidExtents& of : extents) {
        for (std::size_t at = 0; at < SolidExtents::kSolids; at += hn::Lanes(d)) {
            const V anchor[] = {hn::Load(d, &of.anchor[0][at]), hn::Load(d, &of.anchor[1][at]),
                                hn::Load(d, &of.anchor[2][at])};
            Mask seen = reaches_into(walls, anchor, hn::Load(d, &of.radius[at]));
            if (hn::AllFalse(d, seen)) continue;
            seen = hn::And(seen, find_bounds(of, at, anchor, view, eye_distance, bounds));
            std::uint8_t bits = 0;
            hn::StoreMaskBits(d, seen, &bits);
            for (unsigned rest = bits & ((1U << hn::Lanes(d)) - 1); rest != 0; rest &= rest - 1) {
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

namespace {

ViewWalls walls_of(const View& view) {
    const ImagePlane& image = view.image;
    const glm::dmat3 scene_from_eye = glm::transpose(view.eye_from_scene);
    const auto wall = [&](const glm::dvec3& n, double distance) {
        const glm::dvec3 normal = scene_from_eye * glm::normalize(n);
        return Wall{normal, glm::dot(normal, view.eye.metres) + distance};
    };
    return {wall({0, 1, 0}, kNearDepth), wall({1, -image.left, 0}, 0), wall({-1, image.x(image.width), 0}, 0),
            wall({0, -image.z(image.height), 1}, 0), wall({0, image.top, -1}, 0)};
}

}  // namespace

void SolidExtents::set(std::size_t lane, const Solid& solid) {
    for (std::size_t i = 0; i < 3; ++i) anchor[i][lane] = solid.anchor.metres[static_cast<int>(i)];
    const bool is_point = solid.ellipsoid && !(solid.c < 0.0);
    radius[lane] = is_point ? kNowhere : solid.radius;
    const Sym3 e = (-solid.c / solid.determinant) * solid.adjugate;
    const std::array entries{e.xx, e.yy, e.zz, e.xy, e.xz, e.yz};
    for (std::size_t i = 0; i < entries.size(); ++i) extent[i][lane] = entries[i];
    is_ellipsoid[lane] = solid.ellipsoid ? 1.0 : 0.0;
}

std::size_t select(std::span<const SolidExtents> extents, std::uint32_t first, const View& view, InView* in_view) {
    return HWY_DYNAMIC_DISPATCH(Select)(extents, first, view, walls_of(view), in_view);
}

}  // namespace quadrig
#endif
