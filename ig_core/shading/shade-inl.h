/// One surface on one pixel row: texture, light, haze, opacity.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_SHADE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_SHADE_INL_H_
#undef QUADRIG_SHADE_INL_H_
#else
#define QUADRIG_SHADE_INL_H_
#endif

#include "ig_core/shading/block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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
        const V t = sums.value();
        seen.light = hn::MulAdd(hn::Set(d, paint.texture_weight), hn::Sub(t, setting.lit), setting.lit);
        if (paint.translucent) {
            // What filtering took away still blurs the edge of a hole: a ramp of width s has the variance s^2/12.
            const V ramp2 = hn::MulAdd(hn::Set(d, 12.0F), sums.lost_variance(*paint.texture),
                                       hn::Set(d, paint.softness * paint.softness));
            seen.edge = hn::MulAdd(hn::Sub(t, setting.threshold), inverse_sqrt(d, ramp2), hn::Set(d, 0.5F));
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
        setting = known.setting->between(d, in, in_block);
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
    const auto interpolate = [&](const SampleValues& from, BlockValues& to) HWY_ATTR {
        FineValues fine;
        to_fine(from, fine);
        to_columns(fine, to);
    };
    interpolate(light, all_light);
    if (in.light->haze) interpolate(kept, all_kept);
    if (in.paint->translucent) interpolate(edge, all_edge);
    for (std::size_t i = 0; i < count; i += n) {
        Appearance<V> seen{all_light.load(d, i), hn::Set(d, 1.0F), hn::Set(d, 1.0F)};
        if (in.light->haze) seen.kept = all_kept.load(d, i);
        if (in.paint->translucent) seen.edge = all_edge.load(d, i);
        store(d, in, seen, buffer, offset + i);
    }
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

/// Whether a block is worth probing: on a quadric limbs have to be far.
HWY_INLINE bool may_be_steady(const ShadeInput& in, const BlockSamples& samples) {
    return in.kind == ShadeInput::Kind::plane ||
           (limb_is_far(in, samples.first(), kCoarseStride) && limb_is_far(in, samples.last(), kCoarseStride));
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
    std::uint64_t terms = 0;
    for (std::size_t i = 0; i < total;) {
        const std::size_t left = total - i;
        std::size_t count = std::min(left, BlockSamples::kColumns / 2);
        known.terms = 0, known.setting = nullptr;
        const BlockSamples samples{i};
        // A block much shorter than its samples reach is as soon done without.
        if (left >= BlockSamples::kColumns / 2 && in.smooth_stretches && may_be_steady(in, samples)) {
            probe_block(in, samples, probe);
            if (probe.steady) {
                count = std::min(left, BlockSamples::kColumns);
                if (probe.slow_terms(in, kCoarseStride) == term_count(in)) {
                    shade_smooth(in, samples, probe, count, buffer, offset + i);
                    i += count;
                    continue;
                }
                interpolate_block(in, samples, probe, known);
            }
        }
        terms += count * static_cast<std::uint64_t>(term_count(in) - known.terms);
        for (std::size_t c = 0; c < count; c += hn::Lanes(d)) {
            const V column = hn::Clamp(hn::Iota(d, static_cast<float>(i + c)), least, most);
            const Appearance<V> seen = known.setting != nullptr ? appearance<true>(d, in, column, known, c)
                                                                : appearance<false>(d, in, column, known, c);
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
