/// Where rays meet a surface, and how far that point moves from pixel to pixel.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_SURFACE_POINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_SURFACE_POINT_INL_H_
#undef QUADRIG_SURFACE_POINT_INL_H_
#else
#define QUADRIG_SURFACE_POINT_INL_H_
#endif

#include "ig_core/shading/shade_job.h"
#include "ig_core/shading/vector_math-inl.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What lies beyond is drawn as if it were there, metres.
constexpr float kLargestDepth = 1e7F;

/// Where the rays of a few columns meet a surface, and what light needs to know there.
template <class V>
struct SurfacePoint {
    V depth;
    Vec3<V> normal;  ///< outward, not unit for quadrics
    V inverse_length;
    V against;  ///< -N.d, which for quadrics is sqrt(L)
    V a, limb;  ///< quadrics: A and L
};

/// Ray direction through a column of the job, scene axes.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vec3<V> ray_at(D d, const ShadeInput& in, V column) {
    return mul_add(column, splat(d, in.row->ray_step), splat(d, in.ray));
}

/// Where a ray enters a surface.
template <class V>
struct Entry {
    V depth;
    V against;  ///< -N.d, which for quadrics is sqrt(L)
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE V quadric_xi(D d, const ShadeInput& in, V column) {
    return hn::MulAdd(column, splat(d, in.row->xi_step), splat(d, in.xi));
}
template <class D, class V = hn::Vec<D>>
HWY_INLINE V quadric_a(D d, const ShadeInput& in, V xi) {
    return hn::MulAdd(xi, hn::MulAdd(xi, splat(d, in.a[2]), splat(d, in.a[1])), splat(d, in.a[0]));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE Entry<V> entry_into_quadric(D d, const ShadeInput& in, V column) {
    const V zero = hn::Zero(d), xi = quadric_xi(d, in, column);
    const V a = quadric_a(d, in, xi);
    const V b = hn::MulAdd(xi, splat(d, in.b[1]), splat(d, in.b[0]));
    const V limb =
        hn::Max(zero, hn::MulAdd(xi, hn::MulAdd(xi, splat(d, in.limb[2]), splat(d, in.limb[1])), splat(d, in.limb[0])));
    const V root = hn::Sqrt(limb);
    // Eq 4: the entry, in the form that does not cancel.
    const auto before = hn::Le(b, zero);
    const V numerator = hn::IfThenElse(before, splat(d, in.c), hn::Add(b, root));
    const V denominator = hn::IfThenElse(before, hn::Sub(root, b), hn::Neg(a));
    const V depth = hn::Div(numerator, denominator);
    return {hn::IfThenElse(hn::Gt(depth, zero), hn::Min(depth, hn::Set(d, kLargestDepth)), hn::Set(d, kLargestDepth)),
            root};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE SurfacePoint<V> on_quadric(D d, const ShadeInput& in, V column, const Vec3<V>& ray, const Entry<V>& entry) {
    const Vec3<V> q = mul_add(entry.depth, ray, splat(d, in.quadric->eye_from_anchor));
    const V xx = splat(d, in.quadric->m[0]), yy = splat(d, in.quadric->m[1]), zz = splat(d, in.quadric->m[2]);
    const V xy = splat(d, in.quadric->m[3]), xz = splat(d, in.quadric->m[4]), yz = splat(d, in.quadric->m[5]);
    const Vec3<V> normal{
        hn::MulAdd(xx, q.x, hn::MulAdd(xy, q.y, hn::MulAdd(xz, q.z, splat(d, in.quadric->gradient[0])))),
        hn::MulAdd(xy, q.x, hn::MulAdd(yy, q.y, hn::MulAdd(yz, q.z, splat(d, in.quadric->gradient[1])))),
        hn::MulAdd(xz, q.x, hn::MulAdd(yz, q.y, hn::MulAdd(zz, q.z, splat(d, in.quadric->gradient[2]))))};
    const V inverse_length = inverse_sqrt(d, hn::Max(dot(normal, normal), hn::Set(d, 1e-30F)));
    return {entry.depth,
            normal,
            inverse_length,
            entry.against,
            quadric_a(d, in, quadric_xi(d, in, column)),
            hn::Mul(entry.against, entry.against)};
}

/// g of the limb's threshold: -min Q(k d) / |Q(centre)| = L / (A |Q(centre)|), and 1 where Q has no minimum along the
/// ray or no centre.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V limb_share(D d, const ShadeInput& in, const SurfacePoint<V>& point) {
    const V one = hn::Set(d, 1.0F);
    if (in.kind != ShadeInput::Kind::quadric || !(in.quadric->inverse_centre_value > 0.0F)) return one;
    const V share = hn::Mul(point.limb, splat(d, in.quadric->inverse_centre_value));
    const V g = hn::Div(share, hn::Max(point.a, hn::Set(d, 1e-30F)));
    return hn::IfThenElse(hn::Gt(point.a, hn::Zero(d)), hn::Min(one, g), one);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE Entry<V> entry_at(D d, const ShadeInput& in, V column, const Vec3<V>& ray) {
    if (in.kind == ShadeInput::Kind::quadric) return entry_into_quadric(d, in, column);
    const V u = hn::MulAdd(column, splat(d, in.plane_u_step), splat(d, in.plane_u));
    return {hn::Div(hn::Set(d, 1.0F), hn::Max(u, hn::Set(d, 1.0F / kLargestDepth))),
            hn::Neg(dot(splat(d, in.normal), ray))};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE SurfacePoint<V> on_surface(D d, const ShadeInput& in, V column, const Vec3<V>& ray, const Entry<V>& entry) {
    if (in.kind == ShadeInput::Kind::quadric) return on_quadric(d, in, column, ray, entry);
    return {entry.depth, splat(d, in.normal), hn::Set(d, 1.0F), entry.against, hn::Zero(d), hn::Zero(d)};
}

/// Largest share of L that its change from sample to sample may be, for a cubic to follow a quadric's normal.
constexpr float kSteadyShare = 0.25F;
/// Whether it is no more at a column of a quadric: quickly, before samples are taken.
HWY_INLINE bool limb_is_far(const ShadeInput& in, float column, float stride) {
    const float xi = in.xi + column * in.row->xi_step;
    const float limb = in.limb[0] + xi * (in.limb[1] + xi * in.limb[2]), slope = in.limb[1] + 2.0F * xi * in.limb[2];
    return stride * std::abs(in.row->xi_step * slope) < kSteadyShare * limb;
}

/// Whether depth and normal change so little over `stride` columns that a cubic follows them: to 3e-4. L bends a
/// quadric's section with the row, so its share of change stands for the normal's.
template <class D, class V = hn::Vec<D>>
HWY_INLINE bool changes_little(D d, const ShadeInput& in, V column, float stride, const SurfacePoint<V>& point) {
    if (in.kind == ShadeInput::Kind::plane) {
        const V u = hn::MulAdd(column, splat(d, in.plane_u_step), splat(d, in.plane_u));
        return hn::AllTrue(d, hn::Gt(hn::Mul(hn::Set(d, 0.15F), u), hn::Set(d, stride * std::abs(in.plane_u_step))));
    }
    const V xi = hn::MulAdd(column, splat(d, in.row->xi_step), splat(d, in.xi));
    const V b = hn::MulAdd(xi, splat(d, in.b[1]), splat(d, in.b[0]));
    const V limb_slope = hn::MulAdd(xi, hn::Set(d, 2.0F * in.limb[2]), splat(d, in.limb[1]));
    const float step = stride * std::abs(in.row->xi_step);
    const auto steady =
        hn::Lt(hn::Mul(hn::Set(d, step), hn::Abs(limb_slope)), hn::Mul(hn::Set(d, kSteadyShare), point.limb));
    // Depth is C/(root - B) or (B + root)/-A (Eq 4), the one that does not cancel.
    const V reach = hn::Set(d, 0.15F);
    const auto near = hn::Lt(hn::Set(d, step * std::abs(in.b[1])), hn::Mul(reach, hn::Add(point.against, hn::Abs(b))));
    const V a_slope = hn::MulAdd(xi, hn::Set(d, 2.0F * in.a[2]), splat(d, in.a[1]));
    const auto by_a = hn::Lt(hn::Mul(hn::Set(d, step), hn::Abs(a_slope)), hn::Mul(reach, hn::Neg(point.a)));
    return hn::AllTrue(d, hn::And(hn::And(steady, near), hn::Or(hn::Le(b, hn::Zero(d)), by_a)));
}

/// Mean squared growth of the arguments of the two sine families, per unit frequency (m^2), for a step of the surface
/// point.
template <class V>
struct Footprint {
    V x, y;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE Footprint<V> footprint(D d, float vertical_variation, V x2, V y2, V z2) {
    // Mean squares of the phase functions' slopes: pi/4 cos and pi u/2 cos.
    const V across = hn::Set(d, 0.30842514F);
    const V up = hn::Mul(hn::Set(d, 1.2337006F * vertical_variation * vertical_variation), z2);
    return {hn::Add(x2, hn::MulAdd(across, y2, up)), hn::Add(y2, hn::MulAdd(across, x2, up))};
}

/// Footprints of a whole pixel, and of the step to the next column alone.
template <class V>
struct PixelFootprint {
    Footprint<V> pixel, column;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE PixelFootprint<V> pixel_footprint(D d, const ShadeInput& in, const SurfacePoint<V>& point,
                                             const Vec3<V>& ray, const Length<V>& length) {
    // How far the surface point moves from a column and from a row to the next: dP = k (e - d (N.e)/(N.d)).
    const Vec3<V> ray_step = splat(d, in.row->ray_step), along_row = splat(d, in.row->along_row);
    const V most = hn::Mul(hn::Mul(hn::Set(d, 1e3F), point.depth), hn::Mul(length.inverse, point.inverse_length));
    const V inverse = hn::CopySign(hn::Min(hn::Div(point.depth, hn::Abs(point.against)), most), hn::Neg(point.against));
    const V tilt_x = hn::Mul(dot(point.normal, ray_step), inverse),
            tilt_z = hn::Mul(dot(point.normal, along_row), inverse);
    const auto squared_step = [&](const Vec3<V>& step, V tilt) {
        const V x = hn::NegMulAdd(tilt, ray.x, hn::Mul(point.depth, step.x));
        const V y = hn::NegMulAdd(tilt, ray.y, hn::Mul(point.depth, step.y));
        const V z = hn::NegMulAdd(tilt, ray.z, hn::Mul(point.depth, step.z));
        return Vec3<V>{hn::Mul(x, x), hn::Mul(y, y), hn::Mul(z, z)};
    };
    const Vec3<V> column = squared_step(ray_step, tilt_x), row = squared_step(along_row, tilt_z);
    const float u = in.paint->texture->vertical;
    return {footprint(d, u, hn::Add(column.x, row.x), hn::Add(column.y, row.y), hn::Add(column.z, row.z)),
            footprint(d, u, column.x, column.y, column.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
