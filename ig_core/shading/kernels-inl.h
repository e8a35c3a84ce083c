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

template <class D, class V = hn::Vec<D>>
HWY_INLINE SurfacePoint<V> on_surface(D d, const ShadeInput& in, V column, const Vec3<V>& ray) {
    return in.kind == ShadeInput::Kind::quadric ? on_quadric(d, in, column, ray) : on_plane(d, in, column);
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
                                             const Vec3<V>& ray, V length) {
    // How far the surface point moves from a column and from a row to the next: dP = k (e - d (N.e)/(N.d)).
    const Vec3<V> ray_step = splat(d, in.ray_step), along_row = splat(d, in.along_row);
    const V against = dot(point.normal, ray);
    const V least_against = hn::Mul(hn::Set(d, 1e-3F), hn::Div(length, point.inverse_length));
    const V inverse = hn::CopySign(hn::Div(point.depth, hn::Max(hn::Abs(against), least_against)), against);
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

template <class D, class V = hn::Vec<D>>
HWY_INLINE TextureSample<V> texture_at(D d, const ShadeInput& in, const SurfacePoint<V>& point, const Vec3<V>& ray,
                                       V length) {
    const Footprint<V> f = pixel_footprint(d, in, point, ray, length).pixel;
    const Vec3<V> p{hn::Mul(point.depth, ray.x), hn::Mul(point.depth, ray.y), hn::Mul(point.depth, ray.z)};
    return in.paint->translucent ? texturing_function<true>(d, *in.paint->texture, p, f.x, f.y)
                                 : texturing_function<false>(d, *in.paint->texture, p, f.x, f.y);
}

/// Texture of a block of columns, where it is smooth enough to be sampled at every second or fourth and interpolated.
constexpr int kTextureBlock = 64;
struct TextureBlock {
    alignas(64) float value[kTextureBlock + kShadePadding], lost_variance[kTextureBlock + kShadePadding];
    float last_value, last_lost_variance;  ///< at the column after the block
    bool continues = false;                ///< the two above are the next block's first sample
};
/// Largest growth of a sine's argument between samples, rad rms: linear interpolation is then wrong by 1.1 % of that
/// sine, and less of the slower ones.
constexpr float kLargestPhaseStep = 0.3F;

/// How many columns apart the texture may be sampled on a block: 1, 2 or 4.
HWY_INLINE int texture_stride(const ShadeInput& in, int first) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    if (hn::Lanes(d) < 4) return 1;  // too few probes to judge a block by
    const float spacing = static_cast<float>(kTextureBlock) / static_cast<float>(hn::Lanes(d) - 1);
    const V column =
        hn::Clamp(hn::MulAdd(hn::Iota(d, 0.0F), hn::Set(d, spacing), hn::Set(d, static_cast<float>(first))),
                  hn::Set(d, in.least_column), hn::Set(d, in.most_column));
    const Vec3<V> ray = mul_add(column, splat(d, in.ray_step), splat(d, in.ray));
    const V length = hn::Sqrt(dot(ray, ray));
    const PixelFootprint<V> f = pixel_footprint(d, in, on_surface(d, in, column, ray), ray, length);
    const float sharpest = hn::GetLane(hn::MinOfLanes(d, hn::Min(f.pixel.x, f.pixel.y)));
    const float steepest = hn::GetLane(hn::MaxOfLanes(d, hn::Max(f.column.x, f.column.y)));
    const FrameTexture& texture = *in.paint->texture;
    int alive = texture.count;
    constexpr float kTurn2 = 4.0F * 9.8696044F;
    const auto squared = [&](int term) {
        const float w = texture.terms[static_cast<std::size_t>(term)].turns_per_metre;
        return kTurn2 * w * w;
    };
    while (alive > 0 && squared(alive - 1) * sharpest > 48.0F) --alive;
    if (alive == 0) return 4;
    const float step2 = squared(alive - 1) * steepest;
    constexpr float kLimit2 = kLargestPhaseStep * kLargestPhaseStep;
    return step2 * 16.0F <= kLimit2 ? 4 : step2 * 4.0F <= kLimit2 ? 2 : 1;
}

/// Fills a block by interpolation between samples `stride` (2 or 4) columns apart.
HWY_INLINE void interpolate_texture(const ShadeInput& in, int first, int stride, TextureBlock& block) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d), samples = static_cast<std::size_t>(kTextureBlock / stride);
    alignas(64) float value[kTextureBlock / 2 + 2 * kShadePadding], lost[kTextureBlock / 2 + 2 * kShadePadding];
    // Sample 0 is the block's first column, known from the block before it if that one was interpolated too.
    const auto sample = [&](std::size_t from) {
        const V index = hn::Iota(d, static_cast<float>(from));
        const V column =
            hn::Clamp(hn::MulAdd(index, hn::Set(d, static_cast<float>(stride)), hn::Set(d, static_cast<float>(first))),
                      hn::Set(d, in.least_column), hn::Set(d, in.most_column));
        const Vec3<V> ray = mul_add(column, splat(d, in.ray_step), splat(d, in.ray));
        const TextureSample<V> t = texture_at(d, in, on_surface(d, in, column, ray), ray, hn::Sqrt(dot(ray, ray)));
        hn::StoreU(t.value, d, value + from);
        hn::StoreU(t.lost_variance, d, lost + from);
    };
    if (block.continues)
        value[0] = block.last_value, lost[0] = block.last_lost_variance;
    else
        sample(0);
    for (std::size_t i = block.continues ? 1 : n; i <= samples; i += n) sample(i);
    const V quarter = hn::Set(d, 0.25F), half = hn::Set(d, 0.5F), three_quarters = hn::Set(d, 0.75F);
    const auto spread = [&](const float* from, float* to) {
        for (std::size_t i = 0; i < samples; i += n) {
            const V here = hn::LoadU(d, from + i), rise = hn::Sub(hn::LoadU(d, from + i + 1), here);
            const V middle = hn::MulAdd(half, rise, here);
            if (stride == 2)
                hn::StoreInterleaved2(here, middle, d, to + 2 * i);
            else
                hn::StoreInterleaved4(here, hn::MulAdd(quarter, rise, here), middle,
                                      hn::MulAdd(three_quarters, rise, here), d, to + 4 * i);
        }
    };
    spread(value, block.value);
    spread(lost, block.lost_variance);
    block.last_value = value[samples], block.last_lost_variance = lost[samples];
    block.continues = true;
}

HWY_INLINE void shade_columns(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d);
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0F), half = hn::Set(d, 0.5F);
    const FrameLight& light = *in.light;
    const V least = hn::Set(d, in.least_column), most = hn::Set(d, in.most_column);
    const bool textured = in.kind != ShadeInput::Kind::sky && in.paint->texture != nullptr;
    TextureBlock block;
    int stride = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); i += n) {
        const std::size_t in_block = i % kTextureBlock;
        if (textured && in_block == 0) {
            const bool long_enough = in.count - static_cast<int>(i) >= kTextureBlock / 2;
            stride = long_enough ? texture_stride(in, static_cast<int>(i)) : 1;
            if (stride > 1)
                interpolate_texture(in, static_cast<int>(i), stride, block);
            else
                block.continues = false;
        }
        const V column = hn::Clamp(hn::Iota(d, static_cast<float>(i)), least, most);
        const Vec3<V> ray = mul_add(column, splat(d, in.ray_step), splat(d, in.ray));
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
            const SurfacePoint<V> point = on_surface(d, in, column, ray);
            const FramePaint& paint = *in.paint;
            const V facing = hn::Max(zero, hn::Mul(dot(point.normal, splat(d, light.to_sun)), point.inverse_length));
            const V lit = hn::MulAdd(hn::Set(d, 1.0F - light.ambient), facing, hn::Set(d, light.ambient));
            V intensity = lit;
            if (textured) {
                const TextureSample<V> t = stride > 1 ? TextureSample<V>{hn::Load(d, block.value + in_block),
                                                                         hn::Load(d, block.lost_variance + in_block)}
                                                      : texture_at(d, in, point, ray, length);
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
