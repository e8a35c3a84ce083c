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

/// Sample i of those that `sums` are of.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Appearance<V> painted(D d, const ShadeInput& in, const Setting<V>& setting, const TextureSums& sums,
                                 std::size_t i) {
    const FramePaint& paint = *in.paint;
    Appearance<V> seen{setting.lit, setting.kept, hn::Set(d, 1.0F)};
    if (paint.texture != nullptr) {
        const V t = sums.value(d, i);
        seen.light = hn::MulAdd(hn::Set(d, paint.texture_weight), hn::Sub(t, setting.lit), setting.lit);
        if (paint.translucent) {
            // What filtering took away still blurs the edge of a hole: a ramp of width s has the variance s^2/12.
            const V ramp2 = hn::MulAdd(hn::Set(d, 12.0F), sums.lost_variance(d, *paint.texture, i),
                                       hn::Set(d, paint.softness * paint.softness));
            seen.edge = hn::MulAdd(hn::Sub(t, setting.threshold), inverse_sqrt(d, ramp2), hn::Set(d, 0.5F));
        }
    }
    if (in.light->haze) seen.light = hn::Mul(seen.light, setting.kept);
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

/// All terms of the surface's texture from `first` on.
HWY_INLINE void add_terms(const ShadeInput& in, int first, const TexturePoints& points, std::size_t count,
                          TextureSums& sums) {
    if (in.paint->texture != nullptr)
        add_terms(*in.paint->texture, in.paint->translucent, first, term_count(in), points, count, sums);
}

/// A smooth block: its samples shaded, the rest interpolated.
HWY_NOINLINE void shade_smooth(const ShadeInput& in, const BlockProbe& probe, std::size_t count, ShadeBuffer& buffer,
                               std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d);
    TextureSums sums;
    add_terms(in, 0, probe.points, BlockSamples::kCount, sums);
    Values light, kept, edge;
    for (std::size_t i = 0; i < BlockSamples::kCount; i += n) {
        const Appearance<V> seen = painted(d, in, probe.settings.load(d, i), sums, i);
        light.store(d, seen.light, i), kept.store(d, seen.kept, i), edge.store(d, seen.edge, i);
    }
    Values all_light, all_kept, all_edge;
    const auto interpolate = [&](const Values& from, Values& to) HWY_ATTR {
        Values fine;
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

/// Samples of a surface that stand for `kPixels` columns each, in their middle: for `count` columns from `first` on.
template <std::size_t kPixels = 1>
struct SampledColumns {
    std::size_t first, count;
    [[nodiscard]] std::size_t samples() const { return (count + kPixels - 1) / kPixels; }
    template <class D, class V = hn::Vec<D>>
    [[nodiscard]] HWY_INLINE V at(D d, const ShadeInput& in, std::size_t i) const {
        const V middle = hn::Set(d, static_cast<float>(first + kPixels * i) + 0.5F * static_cast<float>(kPixels - 1));
        return hn::Clamp(hn::MulAdd(hn::Iota(d, 0.0F), hn::Set(d, static_cast<float>(kPixels)), middle),
                         hn::Set(d, in.least_column), hn::Set(d, in.most_column));
    }
};

/// Columns each computed by itself: near limbs, and where there are too few for a block.
template <std::size_t kPixels>
HWY_NOINLINE void shade_each(const ShadeInput& in, const SampledColumns<kPixels>& columns, ShadeBuffer& buffer,
                             std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d), samples = columns.samples();
    Values depth, against;
    for (std::size_t i = 0; i < samples; i += n) {
        const V column = columns.at(d, in, i);
        const Entry<V> entry = entry_at(d, in, column, ray_at(d, in, column));
        depth.store(d, entry.depth, i), against.store(d, entry.against, i);
    }
    TexturePoints points;
    Settings settings;
    for (std::size_t i = 0; i < samples; i += n) {
        const V column = columns.at(d, in, i);
        const Vec3<V> ray = ray_at(d, in, column);
        const Length<V> length = length_of(d, ray);
        const SurfacePoint<V> point = on_surface(d, in, column, ray, {depth.load(d, i), against.load(d, i)});
        settings.store(d, setting_at(d, in, length.value, point), i);
        if (in.paint->texture == nullptr) continue;
        store_point(d, ray, point.depth, points, i);
        store_footprint(d, pixel_footprint(d, in, point, ray, length).pixel, points, i);
    }
    TextureSums sums;
    add_terms(in, 0, points, samples, sums);
    for (std::size_t i = 0; i < samples; i += n)
        store<kPixels>(d, in, painted(d, in, settings.load(d, i), sums, i), buffer, offset + kPixels * i);
}

/// Columns of a steady block, whose first terms `sums` has already.
HWY_NOINLINE void shade_steady(const ShadeInput& in, const BlockProbe& probe, const SampledColumns<>& columns,
                               int known_terms, TextureSums& sums, ShadeBuffer& buffer, std::size_t offset) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t n = hn::Lanes(d);
    TexturePoints points;
    for (std::size_t i = 0; i < columns.count; i += n) {
        const V column = columns.at(d, in, i);
        const Vec3<V> ray = ray_at(d, in, column);
        store_point(d, ray, entry_at(d, in, column, ray).depth, points, i);
        points.footprint_x.store(d, between_coarse(d, probe.points.footprint_x, i), i);
        points.footprint_y.store(d, between_coarse(d, probe.points.footprint_y, i), i);
    }
    add_terms(in, known_terms, points, columns.count, sums);
    for (std::size_t i = 0; i < columns.count; i += n)
        store(d, in, painted(d, in, probe.settings.between(d, in, i), sums, i), buffer, offset + i);
}

/// Whether a block is worth probing: on a quadric limbs have to be far.
HWY_INLINE bool may_be_steady(const ShadeInput& in, const BlockSamples& samples) {
    return in.kind == ShadeInput::Kind::plane ||
           (limb_is_far(in, samples.first(), kCoarseStride) && limb_is_far(in, samples.last(), kCoarseStride));
}

/// Returns how many terms were evaluated at columns themselves.
HWY_INLINE std::uint64_t shade_surface(const ShadeInput& in, ShadeBuffer& buffer, std::size_t offset) {
    const auto total = static_cast<std::size_t>(in.count);
    if (in.pairs) {
        for (std::size_t i = 0; i < total; i += kMostSamples)
            shade_each(in, SampledColumns<2>{i, std::min(total - i, kMostSamples)}, buffer, offset + i);
        return 0;
    }
    BlockProbe probe;
    std::uint64_t terms = 0;
    for (std::size_t i = 0; i < total;) {
        const std::size_t left = total - i;
        const BlockSamples samples{i};
        // A block much shorter than its samples reach is as soon done without.
        probe.steady = false;
        if (left >= kMostSamples / 2 && in.smooth_stretches && may_be_steady(in, samples))
            probe_block(in, samples, probe);
        const SampledColumns<> columns{i, std::min(left, probe.steady ? kMostSamples : kMostSamples / 2)};
        int known_terms = 0;
        if (!probe.steady) {
            shade_each(in, columns, buffer, offset + i);
        } else if (probe.slow_terms(in, kCoarseStride) == term_count(in)) {
            known_terms = term_count(in);
            shade_smooth(in, probe, columns.count, buffer, offset + i);
        } else {
            TextureSums sums;
            known_terms = interpolate_slow_terms(in, samples, probe, sums);
            shade_steady(in, probe, columns, known_terms, sums, buffer, offset + i);
        }
        terms += columns.count * static_cast<std::uint64_t>(term_count(in) - known_terms);
        i += columns.count;
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
