/// One surface on one pixel row: texture, light, haze, opacity.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_SHADE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_SHADE_INL_H_
#undef QUADRIG_SHADE_INL_H_
#else
#define QUADRIG_SHADE_INL_H_
#endif

#include "ig_core/shading/interpolation-inl.h"
#include "ig_core/shading/surface_point-inl.h"
#include "ig_core/shading/texture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE int term_count(const ShadeInput& in) { return in.paint->texture == nullptr ? 0 : in.paint->texture->count; }

/// Sums of the slower terms of a texture on a block of columns.
struct SlowTerms {
    int count = 0;  ///< terms taken care of
    BlockValues x, y, lost_x, lost_y;
};

/// What varies over a surface.
template <class V>
struct Appearance {
    V light;  ///< intensity, times `kept`
    V kept;   ///< what the haze lets through
    V edge;   ///< opacity, before it is cut to 0..1
};

/// Appearance of a surface at a few columns. `slow` has the texture's first terms, at `in_block` and on.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Appearance<V> appearance(D d, const ShadeInput& in, V column, const SlowTerms& slow, std::size_t in_block) {
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    const FrameLight& light = *in.light;
    const FramePaint& paint = *in.paint;
    const Vec3<V> ray = ray_at(d, in, column);
    const V length = vector_length(d, ray);
    const SurfacePoint<V> point = on_surface(d, in, column, ray);
    const V facing = hn::Max(zero, hn::Mul(dot(point.normal, splat(d, light.to_sun)), point.inverse_length));
    const V lit = hn::MulAdd(hn::Set(d, 1.0F - light.ambient), facing, hn::Set(d, light.ambient));
    Appearance<V> seen{lit, one, one};
    if (paint.texture != nullptr) {
        const FrameTexture& texture = *paint.texture;
        auto sums = TextureSums<V>::none(d);
        if (slow.count > 0) {
            sums.x = slow.x.load(d, in_block), sums.y = slow.y.load(d, in_block);
            if (paint.translucent)
                sums.lost_x = slow.lost_x.load(d, in_block), sums.lost_y = slow.lost_y.load(d, in_block);
        }
        if (slow.count < texture.count) {
            const Footprint<V> f = pixel_footprint(d, in, point, ray, length).pixel;
            const Vec3<V> p{hn::Mul(point.depth, ray.x), hn::Mul(point.depth, ray.y), hn::Mul(point.depth, ray.z)};
            add_terms(d, texture, paint.translucent, slow.count, texture.count, p, f.x, f.y, sums);
        }
        const TextureSample<V> t = sums.sample();
        seen.light = hn::MulAdd(hn::Set(d, paint.texture_weight), hn::Sub(t.value, lit), lit);
        if (paint.translucent) {
            const V threshold = hn::MulAdd(hn::Set(d, paint.limb_threshold - paint.threshold),
                                           hn::Sub(one, limb_share(d, in, point)), hn::Set(d, paint.threshold));
            // What filtering took away still blurs the edge of a hole: a ramp of width s has the variance s^2/12.
            const V ramp2 = hn::MulAdd(hn::Set(d, 12.0F), t.lost_variance, hn::Set(d, paint.softness * paint.softness));
            seen.edge = hn::MulAdd(hn::Sub(t.value, threshold), inverse_sqrt(d, ramp2), hn::Set(d, 0.5F));
        }
    }
    if (light.haze) {
        seen.kept = exp2_minus(d, hn::Mul(hn::Mul(point.depth, length), hn::Set(d, light.extinction)));
        seen.light = hn::Mul(seen.light, seen.kept);
    }
    return seen;
}

/// `kPixels` neighbours are given each sample.
template <int kPixels = 1, class D, class V = hn::Vec<D>>
HWY_INLINE void store(D d, const ShadeInput& in, const Appearance<V>& seen, ShadeBuffer& buffer, std::size_t at) {
    const Vec3<V> base = splat(d, in.paint->colour);
    Vec3<V> colour{hn::Mul(base.x, seen.light), hn::Mul(base.y, seen.light), hn::Mul(base.z, seen.light)};
    if (in.light->haze) colour = mul_add(hn::Sub(hn::Set(d, 1.0F), seen.kept), splat(d, in.light->haze_colour), colour);
    const auto write = [&](V value, std::vector<float>& plane) HWY_ATTR {
        if constexpr (kPixels == 1)
            hn::StoreU(value, d, plane.data() + at);
        else
            hn::StoreInterleaved2(value, value, d, plane.data() + at);
    };
    write(colour.x, buffer.red);
    write(colour.y, buffer.green);
    write(colour.z, buffer.blue);
    write(hn::Clamp(seen.edge, hn::Zero(d), hn::Set(d, 1.0F)), buffer.opacity);
}

/// What the samples of a block tell about it.
struct BlockProbe {
    int slow_terms = 0;   ///< terms that may be interpolated between samples
    bool smooth = false;  ///< all of them, and light, haze and opacity too
};

/// Samples are taken a little beyond a surface's ends too, where its equation goes on; near a limb nothing is smooth.
HWY_NOINLINE BlockProbe probe_block(const ShadeInput& in, const BlockSamples& samples) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const auto stride = static_cast<float>(samples.stride);
    const int terms = term_count(in);
    constexpr float kTurn2 = 4.0F * 9.8696044F;
    V growth2[kMaxTextureTerms];
    for (int i = 0; i < terms; ++i) growth2[i] = hn::Zero(d);
    float least_facing = 1.0F, most_facing = -1.0F;
    bool smooth = true;
    for (std::size_t i = 0; i < BlockSamples::kCount; i += hn::Lanes(d)) {
        const V column = samples.column(d, i);
        const Vec3<V> ray = ray_at(d, in, column);
        const SurfacePoint<V> point = on_surface(d, in, column, ray);
        const bool steady = changes_little(d, in, column, stride, point);
        smooth = smooth && steady;
        const V facing = dot(point.normal, splat(d, in.light->to_sun));
        least_facing = std::min(least_facing, hn::GetLane(hn::MinOfLanes(d, facing)));
        most_facing = std::max(most_facing, hn::GetLane(hn::MaxOfLanes(d, facing)));
        if (terms == 0) continue;
        const PixelFootprint<V> f = pixel_footprint(d, in, point, ray, vector_length(d, ray));
        const V step2 = hn::Max(f.column.x, f.column.y), pixel2 = hn::Min(f.pixel.x, f.pixel.y);
        for (int t = 0; t < terms; ++t) {
            const float w = in.paint->texture->terms[static_cast<std::size_t>(t)].turns_per_metre;
            const V w2 = hn::Set(d, kTurn2 * w * w);
            // A term that has been filtered away needs no samples, if that does not change from one to the next.
            const auto counts = hn::Lt(hn::Mul(w2, pixel2), hn::Set(d, steady ? 48.0F : 1e30F));
            growth2[t] = hn::Max(growth2[t], hn::IfThenElseZero(counts, hn::Mul(w2, step2)));
        }
    }
    BlockProbe probe;
    const V most = hn::Set(d, kLargestPhaseStep * kLargestPhaseStep / (stride * stride));
    while (probe.slow_terms < terms && hn::AllTrue(d, hn::Le(growth2[probe.slow_terms], most))) ++probe.slow_terms;
    // The shadow's border is a kink.
    probe.smooth = smooth && probe.slow_terms == terms && (least_facing >= 0.0F || most_facing <= 0.0F);
    return probe;
}

/// A smooth block: its samples shaded, the rest interpolated.
HWY_NOINLINE void shade_smooth(const ShadeInput& in, const BlockSamples& samples, std::size_t count,
                               ShadeBuffer& buffer, std::size_t offset) {
    const hn::ScalableTag<float> d;
    const std::size_t n = hn::Lanes(d);
    SlowTerms none;
    none.count = 0;
    SampleValues light, kept, edge;
    for (std::size_t i = 0; i < BlockSamples::kCount; i += n) {
        const auto seen = appearance(d, in, samples.column(d, i), none, 0);
        hn::Store(seen.light, d, light.at + i);
        hn::Store(seen.kept, d, kept.at + i);
        hn::Store(seen.edge, d, edge.at + i);
    }
    BlockValues all_light, all_kept, all_edge;
    samples.interpolate(light, all_light);
    if (in.light->haze) samples.interpolate(kept, all_kept);
    if (in.paint->translucent) samples.interpolate(edge, all_edge);
    for (std::size_t i = 0; i < count; i += n) {
        Appearance<hn::Vec<decltype(d)>> seen{all_light.load(d, i), hn::Set(d, 1.0F), hn::Set(d, 1.0F)};
        if (in.light->haze) seen.kept = all_kept.load(d, i);
        if (in.paint->translucent) seen.edge = all_edge.load(d, i);
        store(d, in, seen, buffer, offset + i);
    }
}

/// Sums of the texture's first `terms` terms on a block.
HWY_NOINLINE void sample_slow_terms(const ShadeInput& in, const BlockSamples& samples, int terms, SlowTerms& slow) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    slow.count = terms;
    if (terms == 0) return;
    SampleValues x, y, lost_x, lost_y;
    for (std::size_t i = 0; i < BlockSamples::kCount; i += hn::Lanes(d)) {
        const V column = samples.column(d, i);
        const Vec3<V> ray = ray_at(d, in, column);
        const SurfacePoint<V> point = on_surface(d, in, column, ray);
        const Footprint<V> f = pixel_footprint(d, in, point, ray, vector_length(d, ray)).pixel;
        const Vec3<V> p{hn::Mul(point.depth, ray.x), hn::Mul(point.depth, ray.y), hn::Mul(point.depth, ray.z)};
        auto sums = TextureSums<V>::none(d);
        add_terms(d, *in.paint->texture, in.paint->translucent, 0, terms, p, f.x, f.y, sums);
        hn::Store(sums.x, d, x.at + i);
        hn::Store(sums.y, d, y.at + i);
        hn::Store(sums.lost_x, d, lost_x.at + i);
        hn::Store(sums.lost_y, d, lost_y.at + i);
    }
    samples.interpolate(x, slow.x);
    samples.interpolate(y, slow.y);
    if (!in.paint->translucent) return;
    samples.interpolate(lost_x, slow.lost_x);
    samples.interpolate(lost_y, slow.lost_y);
}

/// One sample for every two pixels, taken where they meet.
HWY_NOINLINE void shade_pairs(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d);
    const V least = hn::Set(d, in.least_column), most = hn::Set(d, in.most_column);
    SlowTerms none;
    none.count = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); i += 2 * n) {
        const V column = hn::MulAdd(hn::Iota(d, 0.0F), hn::Set(d, 2.0F), hn::Set(d, static_cast<float>(i) + 0.5F));
        const auto seen = appearance(d, in, hn::Clamp(column, least, most), none, 0);
        store<2>(d, in, seen, buffer, offset + i);
    }
}

HWY_INLINE void shade_surface(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    if (in.pairs) return shade_pairs(in, buffer, offset);
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const auto total = static_cast<std::size_t>(in.count);
    const V least = hn::Set(d, in.least_column), most = hn::Set(d, in.most_column);
    SlowTerms slow;
    bool coarse = in.smooth_stretches && in.kind == ShadeInput::Kind::plane;  // worth trying the longer stride
    bool rough = !in.smooth_stretches;  // the last block had nothing to interpolate
    for (std::size_t i = 0; i < total;) {
        const std::size_t left = total - i;
        // A block much shorter than its samples reach is as soon done without.
        if (coarse && left >= BlockSamples::columns(kCoarseStride) / 2) {
            const BlockSamples samples{i, kCoarseStride};
            if (probe_block(in, samples).smooth) {
                const std::size_t count = std::min(left, BlockSamples::columns(kCoarseStride));
                shade_smooth(in, samples, count, buffer, offset + i);
                i += count;
                continue;
            }
        }
        coarse = false;
        slow.count = 0;
        const std::size_t count = std::min(left, BlockSamples::columns(kFineStride));
        if (!rough && left >= BlockSamples::columns(kFineStride) * 2 / 3) {
            const BlockSamples samples{i, kFineStride};
            const BlockProbe probe = probe_block(in, samples);
            if (probe.smooth) {
                coarse = true;
                shade_smooth(in, samples, count, buffer, offset + i);
                i += count;
                continue;
            }
            sample_slow_terms(in, samples, probe.slow_terms, slow);
            rough = probe.slow_terms == 0;
        } else {
            rough = !in.smooth_stretches;
        }
        for (std::size_t c = 0; c < count; c += hn::Lanes(d)) {
            const V column = hn::Clamp(hn::Iota(d, static_cast<float>(i + c)), least, most);
            store(d, in, appearance(d, in, column, slow, c), buffer, offset + i + c);
        }
        i += count;
    }
}

HWY_INLINE void shade_light(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    const auto fill = [&](std::vector<float>& plane, float value) {
        std::fill_n(plane.begin() + static_cast<std::ptrdiff_t>(offset), in.count, value);
    };
    fill(buffer.red, in.colour[0]);
    fill(buffer.green, in.colour[1]);
    fill(buffer.blue, in.colour[2]);
    fill(buffer.opacity, 1.0F);
}

HWY_INLINE void shade_sky(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const Vec3<V> horizon = splat(d, in.light->horizon), zenith = splat(d, in.light->zenith);
    for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); i += hn::Lanes(d)) {
        const Vec3<V> ray = ray_at(d, in, hn::Iota(d, static_cast<float>(i)));
        const V sine = hn::Max(hn::Zero(d), hn::Mul(ray.z, inverse_sqrt(d, dot(ray, ray))));
        const std::size_t at = offset + i;
        hn::StoreU(hn::MulAdd(sine, hn::Sub(zenith.x, horizon.x), horizon.x), d, buffer.red.data() + at);
        hn::StoreU(hn::MulAdd(sine, hn::Sub(zenith.y, horizon.y), horizon.y), d, buffer.green.data() + at);
        hn::StoreU(hn::MulAdd(sine, hn::Sub(zenith.z, horizon.z), horizon.z), d, buffer.blue.data() + at);
        hn::StoreU(hn::Set(d, 1.0F), d, buffer.opacity.data() + at);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
