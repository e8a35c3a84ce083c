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

/// What light, haze and filtering make of a surface point, whatever its texture.
template <class V>
struct Setting {
    V lit;   ///< intensity without texture
    V kept;  ///< what the haze lets through
    Footprint<V> footprint;
    V threshold;  ///< of translucence
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Setting<V> setting_at(D d, const ShadeInput& in, V length, const SurfacePoint<V>& point,
                                 const Footprint<V>& footprint) {
    const V one = hn::Set(d, 1.0F);
    const FrameLight& light = *in.light;
    const FramePaint& paint = *in.paint;
    const V facing = hn::Max(hn::Zero(d), hn::Mul(dot(point.normal, splat(d, light.to_sun)), point.inverse_length));
    const V lit = hn::MulAdd(hn::Set(d, 1.0F - light.ambient), facing, hn::Set(d, light.ambient));
    Setting<V> setting{lit, one, footprint, one};
    if (light.haze) setting.kept = exp2_minus(d, hn::Mul(hn::Mul(point.depth, length), hn::Set(d, light.extinction)));
    if (paint.translucent)
        setting.threshold = hn::MulAdd(hn::Set(d, paint.limb_threshold - paint.threshold),
                                       hn::Sub(one, limb_share(d, in, point)), hn::Set(d, paint.threshold));
    return setting;
}

/// Settings of many points.
template <class Values>
struct Settings {
    Values lit, kept, footprint_x, footprint_y, threshold;

    template <class D>
    [[nodiscard]] HWY_INLINE Setting<hn::Vec<D>> load(D d, std::size_t i) const {
        return {
            lit.load(d, i), kept.load(d, i), {footprint_x.load(d, i), footprint_y.load(d, i)}, threshold.load(d, i)};
    }
    template <class D, class V = hn::Vec<D>>
    HWY_INLINE void store(D d, const Setting<V>& setting, std::size_t i) {
        lit.store(d, setting.lit, i), kept.store(d, setting.kept, i), threshold.store(d, setting.threshold, i);
        footprint_x.store(d, setting.footprint.x, i), footprint_y.store(d, setting.footprint.y, i);
    }
};

/// Sums of a texture's terms, of many points.
template <class Values>
struct SumsOfTerms {
    Values x, y, lost_x, lost_y;

    template <class D>
    [[nodiscard]] HWY_INLINE TextureSums<hn::Vec<D>> load(D d, std::size_t i, bool lost_variance) const {
        if (!lost_variance) return {x.load(d, i), y.load(d, i), hn::Zero(d), hn::Zero(d)};
        return {x.load(d, i), y.load(d, i), lost_x.load(d, i), lost_y.load(d, i)};
    }
    template <class D, class V = hn::Vec<D>>
    HWY_INLINE void store(D d, const TextureSums<V>& sums, std::size_t i) {
        x.store(d, sums.x, i), y.store(d, sums.y, i), lost_x.store(d, sums.lost_x, i), lost_y.store(d, sums.lost_y, i);
    }
};

/// What is known of a block of columns by interpolation: the sums of the texture's first terms, and, if it is steady,
/// the setting.
struct KnownBlock {
    int terms = 0;
    bool steady = false;
    SumsOfTerms<BlockValues> sums;
    Settings<BlockValues> setting;
};

/// Terms [first, last) of the surface's texture at a point, added to `sums`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void add_terms_at(D d, const ShadeInput& in, int first, int last, const Vec3<V>& ray, V depth,
                             const Footprint<V>& footprint, TextureSums<V>& sums) {
    if (first >= last) return;
    const Vec3<V> p{hn::Mul(depth, ray.x), hn::Mul(depth, ray.y), hn::Mul(depth, ray.z)};
    add_terms(d, *in.paint->texture, in.paint->translucent, first, last, p, footprint.x, footprint.y, sums);
}

/// What varies over a surface.
template <class V>
struct Appearance {
    V light;  ///< intensity, times `kept`
    V kept;   ///< what the haze lets through
    V edge;   ///< opacity, before it is cut to 0..1
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Appearance<V> painted(D d, const ShadeInput& in, const Setting<V>& setting, const TextureSums<V>& sums) {
    const FramePaint& paint = *in.paint;
    Appearance<V> seen{setting.lit, setting.kept, hn::Set(d, 1.0F)};
    if (paint.texture != nullptr) {
        const TextureSample<V> t = sums.sample();
        seen.light = hn::MulAdd(hn::Set(d, paint.texture_weight), hn::Sub(t.value, setting.lit), setting.lit);
        if (paint.translucent) {
            // What filtering took away still blurs the edge of a hole: a ramp of width s has the variance s^2/12.
            const V ramp2 = hn::MulAdd(hn::Set(d, 12.0F), t.lost_variance, hn::Set(d, paint.softness * paint.softness));
            seen.edge = hn::MulAdd(hn::Sub(t.value, setting.threshold), inverse_sqrt(d, ramp2), hn::Set(d, 0.5F));
        }
    }
    if (in.light->haze) seen.light = hn::Mul(seen.light, setting.kept);
    return seen;
}

/// Appearance of a surface at a few columns, at `in_block` and on of what is known of a block already.
template <bool kSteady, class D, class V = hn::Vec<D>>
HWY_INLINE Appearance<V> appearance(D d, const ShadeInput& in, V column, const KnownBlock& known,
                                    std::size_t in_block) {
    const Vec3<V> ray = ray_at(d, in, column);
    const SurfacePoint<V> point = on_surface(d, in, column, ray);
    Setting<V> setting;
    if constexpr (kSteady) {
        setting = known.setting.load(d, in_block);
    } else {
        const V length = vector_length(d, ray);
        Footprint<V> footprint{hn::Zero(d), hn::Zero(d)};
        if (in.paint->texture != nullptr) footprint = pixel_footprint(d, in, point, ray, length).pixel;
        setting = setting_at(d, in, length, point, footprint);
    }
    auto sums = known.terms > 0 ? known.sums.load(d, in_block, in.paint->translucent) : TextureSums<V>::none(d);
    add_terms_at(d, in, known.terms, term_count(in), ray, point.depth, setting.footprint, sums);
    return painted(d, in, setting, sums);
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

/// A block's samples, and what they tell about it.
struct BlockProbe {
    SampleValues depth;
    Settings<SampleValues> setting;
    int slow_terms = 0;   ///< terms that may be interpolated between samples
    bool steady = false;  ///< the setting may be, too
    bool smooth = false;  ///< all of that
};

/// Samples are taken a little beyond a surface's ends too, where its equation goes on; near a limb nothing is steady.
HWY_NOINLINE void probe_block(const ShadeInput& in, const BlockSamples& samples, BlockProbe& probe) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const auto stride = static_cast<float>(samples.stride);
    const int terms = term_count(in);
    V step2 = hn::Zero(d), pixel2 = hn::Set(d, 1e30F);
    bool lit = true, in_shadow = true;
    probe.steady = true;
    for (std::size_t i = 0; i < BlockSamples::kCount; i += hn::Lanes(d)) {
        const V column = samples.column(d, i);
        const Vec3<V> ray = ray_at(d, in, column);
        const V length = vector_length(d, ray);
        const SurfacePoint<V> point = on_surface(d, in, column, ray);
        probe.steady = probe.steady && changes_little(d, in, column, stride, point);
        const V facing = dot(point.normal, splat(d, in.light->to_sun));
        lit = lit && hn::AllTrue(d, hn::Ge(facing, hn::Zero(d)));
        in_shadow = in_shadow && hn::AllTrue(d, hn::Le(facing, hn::Zero(d)));
        PixelFootprint<V> f{{hn::Zero(d), hn::Zero(d)}, {hn::Zero(d), hn::Zero(d)}};
        if (terms > 0) f = pixel_footprint(d, in, point, ray, length);
        step2 = hn::Max(step2, hn::Max(f.column.x, f.column.y));
        pixel2 = hn::Min(pixel2, hn::Min(f.pixel.x, f.pixel.y));
        probe.depth.store(d, point.depth, i);
        probe.setting.store(d, setting_at(d, in, length, point, f.pixel), i);
    }
    const float most_step2 = hn::GetLane(hn::MaxOfLanes(d, step2)),
                least_pixel2 = hn::GetLane(hn::MinOfLanes(d, pixel2));
    const auto is_slow = [&](const FrameTexture::Term& term) {
        const float w2 = 4.0F * 9.8696044F * term.turns_per_metre * term.turns_per_metre;
        // A term that has been filtered away needs no samples, if that does not change from one to the next.
        return w2 * most_step2 * stride * stride <= kLargestPhaseStep * kLargestPhaseStep ||
               (probe.steady && w2 * least_pixel2 >= 48.0F);
    };
    probe.slow_terms = 0;
    while (probe.slow_terms < terms && is_slow(in.paint->texture->terms[static_cast<std::size_t>(probe.slow_terms)]))
        ++probe.slow_terms;
    // The shadow's border is a kink.
    probe.steady = probe.steady && (lit || in_shadow);
    probe.smooth = probe.steady && probe.slow_terms == terms;
}

/// A smooth block: its samples shaded, the rest interpolated.
HWY_NOINLINE void shade_smooth(const ShadeInput& in, const BlockSamples& samples, const BlockProbe& probe,
                               std::size_t count, ShadeBuffer& buffer, std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d);
    SampleValues light, kept, edge;
    for (std::size_t i = 0; i < BlockSamples::kCount; i += n) {
        const Setting<V> setting = probe.setting.load(d, i);
        auto sums = TextureSums<V>::none(d);
        add_terms_at(d, in, 0, term_count(in), ray_at(d, in, samples.column(d, i)), probe.depth.load(d, i),
                     setting.footprint, sums);
        const Appearance<V> seen = painted(d, in, setting, sums);
        light.store(d, seen.light, i), kept.store(d, seen.kept, i), edge.store(d, seen.edge, i);
    }
    BlockValues all_light, all_kept, all_edge;
    samples.interpolate(light, all_light);
    if (in.light->haze) samples.interpolate(kept, all_kept);
    if (in.paint->translucent) samples.interpolate(edge, all_edge);
    for (std::size_t i = 0; i < count; i += n) {
        Appearance<V> seen{all_light.load(d, i), hn::Set(d, 1.0F), hn::Set(d, 1.0F)};
        if (in.light->haze) seen.kept = all_kept.load(d, i);
        if (in.paint->translucent) seen.edge = all_edge.load(d, i);
        store(d, in, seen, buffer, offset + i);
    }
}

/// Interpolates what may be between the samples of a block.
HWY_NOINLINE void interpolate_block(const ShadeInput& in, const BlockSamples& samples, const BlockProbe& probe,
                                    KnownBlock& known) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    known.terms = probe.slow_terms;
    known.steady = probe.steady;
    if (known.terms > 0) {
        SumsOfTerms<SampleValues> at;
        for (std::size_t i = 0; i < BlockSamples::kCount; i += hn::Lanes(d)) {
            auto sums = TextureSums<V>::none(d);
            add_terms_at(d, in, 0, known.terms, ray_at(d, in, samples.column(d, i)), probe.depth.load(d, i),
                         probe.setting.load(d, i).footprint, sums);
            at.store(d, sums, i);
        }
        samples.interpolate(at.x, known.sums.x);
        samples.interpolate(at.y, known.sums.y);
        if (in.paint->translucent) {
            samples.interpolate(at.lost_x, known.sums.lost_x);
            samples.interpolate(at.lost_y, known.sums.lost_y);
        }
    }
    if (!known.steady) return;
    samples.interpolate(probe.setting.lit, known.setting.lit);
    samples.interpolate(probe.setting.footprint_x, known.setting.footprint_x);
    samples.interpolate(probe.setting.footprint_y, known.setting.footprint_y);
    if (in.light->haze) samples.interpolate(probe.setting.kept, known.setting.kept);
    if (in.paint->translucent) samples.interpolate(probe.setting.threshold, known.setting.threshold);
}

/// One sample for every two pixels, taken where they meet.
HWY_NOINLINE void shade_pairs(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d);
    const V least = hn::Set(d, in.least_column), most = hn::Set(d, in.most_column);
    KnownBlock none;
    for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); i += 2 * n) {
        const V column = hn::MulAdd(hn::Iota(d, 0.0F), hn::Set(d, 2.0F), hn::Set(d, static_cast<float>(i) + 0.5F));
        const auto seen = appearance<false>(d, in, hn::Clamp(column, least, most), none, 0);
        store<2>(d, in, seen, buffer, offset + i);
    }
}

HWY_INLINE std::uint64_t shade_surface(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    if (in.pairs) {
        shade_pairs(in, buffer, offset);
        return 0;
    }
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const auto total = static_cast<std::size_t>(in.count);
    const V least = hn::Set(d, in.least_column), most = hn::Set(d, in.most_column);
    KnownBlock known;
    BlockProbe probe;
    bool coarse = in.smooth_stretches && in.kind == ShadeInput::Kind::plane;  // worth trying the longer stride
    std::uint64_t terms = 0;
    bool rough = !in.smooth_stretches;  // the last block had nothing to interpolate
    for (std::size_t i = 0; i < total;) {
        const std::size_t left = total - i;
        // A block much shorter than its samples reach is as soon done without.
        if (coarse && left >= BlockSamples::columns(kCoarseStride) / 2) {
            const BlockSamples samples{i, kCoarseStride};
            probe_block(in, samples, probe);
            if (probe.smooth) {
                const std::size_t count = std::min(left, BlockSamples::columns(kCoarseStride));
                shade_smooth(in, samples, probe, count, buffer, offset + i);
                i += count;
                continue;
            }
        }
        coarse = false;
        known.terms = 0, known.steady = false;
        const std::size_t count = std::min(left, BlockSamples::columns(kFineStride));
        if (!rough && left >= BlockSamples::columns(kFineStride) * 2 / 3) {
            const BlockSamples samples{i, kFineStride};
            probe_block(in, samples, probe);
            if (probe.smooth) {
                coarse = true;
                shade_smooth(in, samples, probe, count, buffer, offset + i);
                i += count;
                continue;
            }
            interpolate_block(in, samples, probe, known);
            rough = probe.slow_terms == 0 && !probe.steady;
        } else {
            rough = !in.smooth_stretches;
        }
        terms += count * static_cast<std::uint64_t>(term_count(in) - known.terms);
        for (std::size_t c = 0; c < count; c += hn::Lanes(d)) {
            const V column = hn::Clamp(hn::Iota(d, static_cast<float>(i + c)), least, most);
            const Appearance<V> seen =
                known.steady ? appearance<true>(d, in, column, known, c) : appearance<false>(d, in, column, known, c);
            store(d, in, seen, buffer, offset + i + c);
        }
        i += count;
    }
    return terms;
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
