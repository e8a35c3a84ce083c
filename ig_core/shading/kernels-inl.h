// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_SHADING_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_SHADING_KERNELS_INL_H_
#undef QUADRIG_SHADING_KERNELS_INL_H_
#else
#define QUADRIG_SHADING_KERNELS_INL_H_
#endif

#include <hwy/highway.h>

#include "ig_core/shading/shade_job.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Vec3 {
    V x, y, z;
};

template <class V>
HWY_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vec3<V> splat(D d, const std::array<float, 3>& v) {
    return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}
/// a + f b
template <class V>
HWY_INLINE Vec3<V> mul_add(V f, const Vec3<V>& b, const Vec3<V>& a) {
    return {hn::MulAdd(f, b.x, a.x), hn::MulAdd(f, b.y, a.y), hn::MulAdd(f, b.z, a.z)};
}

/// sin(2 pi t), |error| <= 1e-5 for |t| up to about 1e3: on the nearest half turn, a quadratic in the parabola r (1 - 2
/// |r|) that has the sine's zeros; minimax.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V sin_turns(D d, V t) {
    const V r = hn::Sub(t, hn::Round(t));
    const V parabola = hn::Mul(r, hn::NegMulAdd(hn::Set(d, 2.0F), hn::Abs(r), hn::Set(d, 1.0F)));
    const V size = hn::Abs(parabola);
    const V p = hn::MulAdd(size, hn::Set(d, 9.742415539F), hn::Set(d, 12.506223365F));
    return hn::Mul(parabola, hn::MulAdd(size, p, hn::Set(d, 6.284434297F)));
}

/// 2^-y for y >= 0, relative error <= 3e-6; 0 beyond 126.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exp2_minus(D d, V y) {
    const hn::RebindToSigned<D> di;
    const V x = hn::Neg(hn::Min(y, hn::Set(d, 126.0F)));
    const V whole = hn::Round(x);
    const V r = hn::Sub(x, whole);
    V p = hn::MulAdd(r, hn::Set(d, 0.00956992228F), hn::Set(d, 0.05591770886F));
    p = hn::MulAdd(r, p, hn::Set(d, 0.24024747254F));
    p = hn::MulAdd(r, p, hn::Set(d, 0.69312183686F));
    p = hn::MulAdd(r, p, hn::Set(d, 0.99999926155F));
    const auto exponent = hn::ShiftLeft<23>(hn::ConvertTo(di, whole));
    return hn::BitCast(d, hn::Add(hn::BitCast(di, p), exponent));
}

/// 8-bit sRGB of linear light (IEC 61966-2-1): a quartic in x^(1/4), within 0.01 of a step; the linear toe below it.
template <class D>
HWY_INLINE auto srgb8(D d, hn::Vec<D> linear) {
    const hn::RebindToSigned<D> di;
    const auto x = hn::Clamp(linear, hn::Zero(d), hn::Set(d, 1.0F));
    const auto q = hn::Sqrt(hn::Sqrt(x));
    auto p = hn::MulAdd(q, hn::Set(d, 20.73650632582F), hn::Set(d, -85.54567783457F));
    p = hn::MulAdd(q, p, hn::Set(d, 286.27678208318F));
    p = hn::MulAdd(q, p, hn::Set(d, 50.01750037572F));
    p = hn::MulAdd(q, p, hn::Set(d, -16.47634412907F));
    const auto toe = hn::Mul(x, hn::Set(d, 12.92F * 255.0F));
    const auto value = hn::IfThenElse(hn::Lt(x, hn::Set(d, 0.0031308F)), toe, p);
    return hn::ConvertTo(di, hn::Add(value, hn::Set(d, 0.5F)));
}

/// T, and the variance of what filtering took out of it.
template <class V>
struct TextureSample {
    V value, lost_variance;
};

/// The texturing function (Eq 15) at points p, metres from the eye in scene axes. `footprint_x` and `footprint_y` are
/// the mean squared growth of the two sine families' arguments per unit frequency over a pixel (m^2): each sine is
/// faded as (1 - w^2 footprint / 48)^2, which follows the box filter's exp(-w^2 footprint / 24) and ends a little above
/// the sampling frequency, where the term is dropped.
template <bool kVertical, bool kLostVariance, class D, class V = hn::Vec<D>>
HWY_INLINE TextureSample<V> texturing_terms(D d, const FrameTexture& texture, const Vec3<V>& p, V footprint_x,
                                            V footprint_y) {
    constexpr float kFade = 4.0F * 9.8696044F / 48.0F;  // (2 pi)^2 / 48, for frequencies in turns
    const V one = hn::Set(d, 1.0F), zero = hn::Zero(d), quarter = hn::Set(d, 0.25F), half = hn::Set(d, 0.5F);
    const V half_u = hn::Set(d, 0.5F * texture.vertical);
    V sum_x = half, sum_y = half, lost_x = zero, lost_y = zero;
    for (int i = 0; i < texture.count; ++i) {
        const FrameTexture::Term& term = texture.terms[static_cast<std::size_t>(i)];
        const float w = term.turns_per_metre;
        const V fade = hn::Set(d, w * w * kFade);
        const V keep_x = hn::Max(zero, hn::NegMulAdd(fade, footprint_x, one));
        const V keep_y = hn::Max(zero, hn::NegMulAdd(fade, footprint_y, one));
        const V filter_x = hn::Mul(keep_x, keep_x), filter_y = hn::Mul(keep_y, keep_y);
        if constexpr (kLostVariance) {
            const V variance = hn::Set(d, 0.125F * term.weight * term.weight);
            lost_x = hn::MulAdd(variance, hn::NegMulAdd(filter_x, filter_x, one), lost_x);
            lost_y = hn::MulAdd(variance, hn::NegMulAdd(filter_y, filter_y, one), lost_y);
        }
        if (hn::AllTrue(d, hn::Eq(hn::Max(keep_x, keep_y), zero))) {
            for (++i; i < texture.count; ++i) {
                const float rest = texture.terms[static_cast<std::size_t>(i)].weight;
                lost_x = hn::Add(lost_x, hn::Set(d, 0.125F * rest * rest));
                lost_y = hn::Add(lost_y, hn::Set(d, 0.125F * rest * rest));
            }
            break;
        }
        const V full = hn::Set(d, w), halved = hn::Set(d, 0.5F * w);
        V phase_x = hn::MulAdd(full, p.x, hn::Set(d, term.along_x));
        V phase_y = hn::MulAdd(full, p.y, hn::Set(d, term.along_y));
        phase_x = hn::MulAdd(quarter, sin_turns(d, hn::MulAdd(halved, p.y, hn::Set(d, term.half_y))), phase_x);
        phase_y = hn::MulAdd(quarter, sin_turns(d, hn::MulAdd(halved, p.x, hn::Set(d, term.half_x))), phase_y);
        if constexpr (kVertical) {
            const V up = hn::MulAdd(halved, p.z, hn::Set(d, term.half_z));
            phase_x = hn::MulAdd(half_u, sin_turns(d, up), phase_x);
            phase_y = hn::MulAdd(half_u, sin_turns(d, hn::Add(up, quarter)), phase_y);
        }
        const V half_weight = hn::Set(d, 0.5F * term.weight);
        sum_x = hn::MulAdd(hn::Mul(half_weight, filter_x), sin_turns(d, phase_x), sum_x);
        sum_y = hn::MulAdd(hn::Mul(half_weight, filter_y), sin_turns(d, phase_y), sum_y);
    }
    const V lost = hn::MulAdd(hn::Mul(sum_x, sum_x), lost_y, hn::Mul(hn::MulAdd(sum_y, sum_y, lost_y), lost_x));
    return {hn::Mul(sum_x, sum_y), lost};
}

template <bool kLostVariance, class D, class V = hn::Vec<D>>
HWY_INLINE TextureSample<V> texturing_function(D d, const FrameTexture& texture, const Vec3<V>& p, V footprint_x,
                                               V footprint_y) {
    return texture.vertical != 0.0F ? texturing_terms<true, kLostVariance>(d, texture, p, footprint_x, footprint_y)
                                    : texturing_terms<false, kLostVariance>(d, texture, p, footprint_x, footprint_y);
}

/// Where the rays of a few columns meet a surface, and what light needs to know there.
template <class V>
struct SurfacePoint {
    V depth;
    Vec3<V> normal;  ///< outward, not unit for quadrics
    V inverse_length, limb;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE SurfacePoint<V> on_quadric(D d, const ShadeInput& in, V column, const Vec3<V>& ray) {
    const V zero = hn::Zero(d), tiny = hn::Set(d, 1e-30F);
    const V xi = hn::MulAdd(column, hn::Set(d, in.xi_step), hn::Set(d, in.xi));
    const V a = hn::MulAdd(xi, hn::MulAdd(xi, hn::Set(d, in.a[2]), hn::Set(d, in.a[1])), hn::Set(d, in.a[0]));
    const V b = hn::MulAdd(xi, hn::Set(d, in.b[1]), hn::Set(d, in.b[0]));
    const V limb = hn::Max(
        zero, hn::MulAdd(xi, hn::MulAdd(xi, hn::Set(d, in.limb[2]), hn::Set(d, in.limb[1])), hn::Set(d, in.limb[0])));
    const V root = hn::Sqrt(limb);
    // Eq 4: the entry, in the form that does not cancel.
    const auto before = hn::Le(b, zero);
    const V numerator = hn::IfThenElse(before, hn::Set(d, in.c), hn::Add(b, root));
    const V denominator = hn::IfThenElse(before, hn::Sub(root, b), hn::Neg(a));
    V depth = hn::Div(numerator, denominator);
    depth =
        hn::IfThenElse(hn::Gt(depth, zero), hn::Min(depth, hn::Set(d, in.largest_depth)), hn::Set(d, in.largest_depth));
    const Vec3<V> q = mul_add(depth, ray, splat(d, in.eye_from_anchor));
    const V xx = hn::Set(d, in.m[0]), yy = hn::Set(d, in.m[1]), zz = hn::Set(d, in.m[2]);
    const V xy = hn::Set(d, in.m[3]), xz = hn::Set(d, in.m[4]), yz = hn::Set(d, in.m[5]);
    const Vec3<V> normal{hn::MulAdd(xx, q.x, hn::MulAdd(xy, q.y, hn::MulAdd(xz, q.z, hn::Set(d, in.gradient[0])))),
                         hn::MulAdd(xy, q.x, hn::MulAdd(yy, q.y, hn::MulAdd(yz, q.z, hn::Set(d, in.gradient[1])))),
                         hn::MulAdd(xz, q.x, hn::MulAdd(yz, q.y, hn::MulAdd(zz, q.z, hn::Set(d, in.gradient[2]))))};
    const V inverse_length = hn::Div(hn::Set(d, 1.0F), hn::Sqrt(hn::Max(dot(normal, normal), tiny)));
    // g = -min Q(k d) / |Q(centre)| = L / (A |Q(centre)|), and 1 where Q has no minimum along the ray.
    const V g = hn::Div(hn::Mul(limb, hn::Set(d, in.inverse_centre_value)), hn::Max(a, tiny));
    const bool has_limb = in.inverse_centre_value > 0.0F;
    const V one = hn::Set(d, 1.0F);
    return {depth, normal, inverse_length, has_limb ? hn::IfThenElse(hn::Gt(a, zero), hn::Min(one, g), one) : one};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE SurfacePoint<V> on_plane(D d, const ShadeInput& in, V column) {
    const V u = hn::MulAdd(column, hn::Set(d, in.plane_u_step), hn::Set(d, in.plane_u));
    const V depth = hn::Div(hn::Set(d, 1.0F), hn::Max(u, hn::Set(d, 1.0F / in.largest_depth)));
    return {depth, splat(d, in.normal), hn::Set(d, 1.0F), hn::Set(d, 1.0F)};
}

HWY_INLINE void shade_columns(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d);
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0F), half = hn::Set(d, 0.5F);
    const FrameLight& light = *in.light;
    const V least = hn::Set(d, in.least_column), most = hn::Set(d, in.most_column);
    const Vec3<V> ray_start = splat(d, in.ray), ray_step = splat(d, in.ray_step), along_row = splat(d, in.along_row);
    for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); i += n) {
        const V column = hn::Clamp(hn::Iota(d, static_cast<float>(i)), least, most);
        const Vec3<V> ray = mul_add(column, ray_step, ray_start);
        const V length = hn::Sqrt(dot(ray, ray));
        Vec3<V> colour;
        V opacity = one;
        if (in.kind == ShadeInput::Kind::sky) {
            const V sine = hn::Max(zero, hn::Div(ray.z, length));
            const Vec3<V> horizon = splat(d, light.horizon), zenith = splat(d, light.zenith);
            colour = {hn::MulAdd(sine, hn::Sub(zenith.x, horizon.x), horizon.x),
                      hn::MulAdd(sine, hn::Sub(zenith.y, horizon.y), horizon.y),
                      hn::MulAdd(sine, hn::Sub(zenith.z, horizon.z), horizon.z)};
        } else {
            const SurfacePoint<V> point =
                in.kind == ShadeInput::Kind::quadric ? on_quadric(d, in, column, ray) : on_plane(d, in, column);
            const FramePaint& paint = *in.paint;
            const V facing = hn::Max(zero, hn::Mul(dot(point.normal, splat(d, light.to_sun)), point.inverse_length));
            const V lit = hn::MulAdd(hn::Set(d, 1.0F - light.ambient), facing, hn::Set(d, light.ambient));
            V intensity = lit;
            if (paint.texture != nullptr) {
                // How far the surface point moves from a column and from a row to the next: dP = k (e - d (N.e)/(N.d)).
                const V against = dot(point.normal, ray);
                const V least_against = hn::Mul(hn::Set(d, 1e-3F), hn::Div(length, point.inverse_length));
                const V inverse = hn::Div(one, hn::Max(hn::Abs(against), least_against));
                const V signed_inverse = hn::CopySign(inverse, against);
                const V tilt_x = hn::Mul(dot(point.normal, ray_step), signed_inverse);
                const V tilt_z = hn::Mul(dot(point.normal, along_row), signed_inverse);
                const Vec3<V> dx{hn::NegMulAdd(tilt_x, ray.x, ray_step.x), hn::NegMulAdd(tilt_x, ray.y, ray_step.y),
                                 hn::NegMulAdd(tilt_x, ray.z, ray_step.z)};
                const Vec3<V> dz{hn::NegMulAdd(tilt_z, ray.x, along_row.x), hn::NegMulAdd(tilt_z, ray.y, along_row.y),
                                 hn::NegMulAdd(tilt_z, ray.z, along_row.z)};
                const V depth2 = hn::Mul(point.depth, point.depth);
                const V in_x = hn::Mul(depth2, hn::MulAdd(dx.x, dx.x, hn::Mul(dz.x, dz.x)));
                const V in_y = hn::Mul(depth2, hn::MulAdd(dx.y, dx.y, hn::Mul(dz.y, dz.y)));
                const V in_z = hn::Mul(depth2, hn::MulAdd(dx.z, dx.z, hn::Mul(dz.z, dz.z)));
                // Mean squares of the phase functions' slopes: pi/4 cos and pi u/2 cos.
                const float u = paint.texture->vertical;
                const V across = hn::Set(d, 0.30842514F), vertical = hn::Set(d, 1.2337006F * u * u);
                const V up = hn::Mul(vertical, in_z);
                const V footprint_x = hn::Add(in_x, hn::MulAdd(across, in_y, up));
                const V footprint_y = hn::Add(in_y, hn::MulAdd(across, in_x, up));
                const Vec3<V> p{hn::Mul(point.depth, ray.x), hn::Mul(point.depth, ray.y), hn::Mul(point.depth, ray.z)};
                const TextureSample<V> t =
                    paint.translucent ? texturing_function<true>(d, *paint.texture, p, footprint_x, footprint_y)
                                      : texturing_function<false>(d, *paint.texture, p, footprint_x, footprint_y);
                intensity = hn::MulAdd(hn::Set(d, paint.texture_weight), hn::Sub(t.value, lit), lit);
                if (paint.translucent) {
                    const V threshold = hn::MulAdd(hn::Set(d, paint.limb_threshold - paint.threshold),
                                                   hn::Sub(one, point.limb), hn::Set(d, paint.threshold));
                    // What filtering took away still blurs the edge of a hole: a ramp of width s has the variance
                    // s^2/12.
                    const V ramp2 =
                        hn::MulAdd(hn::Set(d, 12.0F), t.lost_variance, hn::Set(d, paint.softness * paint.softness));
                    const V edge = hn::Div(hn::Sub(t.value, threshold), hn::Sqrt(ramp2));
                    opacity = hn::Clamp(hn::Add(edge, half), zero, one);
                }
            }
            const Vec3<V> base = splat(d, paint.colour);
            colour = {hn::Mul(base.x, intensity), hn::Mul(base.y, intensity), hn::Mul(base.z, intensity)};
            if (light.haze) {
                const V range = hn::Mul(point.depth, length);
                const V kept = exp2_minus(d, hn::Mul(range, hn::Set(d, light.extinction)));
                const Vec3<V> haze = splat(d, light.haze_colour);
                colour = {hn::MulAdd(kept, hn::Sub(colour.x, haze.x), haze.x),
                          hn::MulAdd(kept, hn::Sub(colour.y, haze.y), haze.y),
                          hn::MulAdd(kept, hn::Sub(colour.z, haze.z), haze.z)};
            }
        }
        hn::StoreU(colour.x, d, buffer.red.data() + offset + i);
        hn::StoreU(colour.y, d, buffer.green.data() + offset + i);
        hn::StoreU(colour.z, d, buffer.blue.data() + offset + i);
        hn::StoreU(opacity, d, buffer.opacity.data() + offset + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
