/// One surface on one pixel row: texture, light, haze, opacity.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_SHADE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_SHADE_INL_H_
#undef QUADRIG_SHADE_INL_H_
#else
#define QUADRIG_SHADE_INL_H_
#endif

#include <span>

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
        seen.light = hn::MulAdd(splat(d, paint.texture_weight), hn::Sub(t, setting.lit), setting.lit);
        if (paint.translucent) {
            // What filtering took away still blurs the edge of a hole: a ramp of width s has the variance s^2/12.
            const V ramp2 = hn::MulAdd(hn::Set(d, 12.0F), sums.lost_variance(d, *paint.texture, i),
                                       hn::Set(d, paint.softness * paint.softness));
            seen.edge = hn::MulAdd(hn::Sub(t, setting.threshold), inverse_sqrt(d, ramp2), hn::Set(d, 0.5F));
        }
    }
    if (in.row->light->haze) seen.light = hn::Mul(seen.light, setting.kept);
    return seen;
}

/// `kPixels` neighbours are given each sample.
template <int kPixels = 1, class D, class V = hn::Vec<D>>
HWY_INLINE void store(D d, const ShadeInput& in, const Appearance<V>& seen, ShadeBuffer& buffer, std::size_t at) {
    const Vec3<V> base = splat(d, in.paint->colour);
    Vec3<V> colour{hn::Mul(base.x, seen.light), hn::Mul(base.y, seen.light), hn::Mul(base.z, seen.light)};
    if (in.row->light->haze)
        colour = mul_add(hn::Sub(hn::Set(d, 1.0F), seen.kept), splat(d, in.row->light->haze_colour), colour);
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
    if (in.row->light->haze) interpolate(kept, all_kept);
    if (in.paint->translucent) interpolate(edge, all_edge);
    for (std::size_t i = 0; i < count; i += n) {
        Appearance<V> seen{all_light.load(d, i), hn::Set(d, 1.0F), hn::Set(d, 1.0F)};
        if (in.row->light->haze) seen.kept = all_kept.load(d, i);
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
                         splat(d, in.least_column), splat(d, in.most_column));
    }
};

/// Such columns of a surface, and where their samples stand among those that are worked on together.
template <std::size_t kPixels>
struct Stretch {
    const ShadeInput* in;
    SampledColumns<kPixels> columns;
    std::size_t at;
};

/// Does `step(d, i)` for samples i and on until there are `count`: a last few in a vector of no more.
template <class Step>
HWY_INLINE void for_samples(std::size_t count, Step&& step) {
    const hn::ScalableTag<float> d;
    const hn::CappedTag<float, kFewSamples> few;
    std::size_t i = 0;
    for (; i + hn::Lanes(few) < count; i += hn::Lanes(d)) step(d, i);
    if (i < count) step(few, i);
}

/// Columns each computed by itself: near limbs, and where there are too few for a block. The stretches show one texture
/// and stand one behind the other, here as in the buffer: what is stored past the end of one the next overwrites. So
/// the terms, most of the work, are computed in full vectors however short a stretch is.
template <std::size_t kPixels>
HWY_NOINLINE void shade_each(std::span<const Stretch<kPixels>> stretches, ShadeBuffer& buffer) {
    Values depth, against;
    for (const auto& stretch : stretches) {
        const ShadeInput& in = *stretch.in;
        for_samples(stretch.columns.samples(), [&](auto d, std::size_t i) HWY_ATTR {
            const auto column = stretch.columns.at(d, in, i);
            const auto entry = entry_at(d, in, column, ray_at(d, in, column));
            depth.store(d, entry.depth, stretch.at + i), against.store(d, entry.against, stretch.at + i);
        });
    }
    TexturePoints points;
    Settings settings;
    for (const auto& stretch : stretches) {
        const ShadeInput& in = *stretch.in;
        for_samples(stretch.columns.samples(), [&](auto d, std::size_t i) HWY_ATTR {
            using V = hn::Vec<decltype(d)>;
            const std::size_t at = stretch.at + i;
            const V column = stretch.columns.at(d, in, i);
            const Vec3<V> ray = ray_at(d, in, column);
            const Length<V> length = length_of(d, ray);
            const SurfacePoint<V> point = on_surface(d, in, column, ray, {depth.load(d, at), against.load(d, at)});
            settings.store(d, setting_at(d, in, length.value, point), at);
            if (in.paint->texture == nullptr) return;
            store_point(d, ray, point.depth, points, at);
            store_footprint(d, pixel_footprint(d, in, point, ray, length).pixel, points, at);
        });
    }
    TextureSums sums;
    add_terms(*stretches.back().in, 0, points, stretches.back().at + stretches.back().columns.samples(), sums);
    for (const auto& stretch : stretches) {
        const ShadeInput& in = *stretch.in;
        for_samples(stretch.columns.samples(), [&](auto d, std::size_t i) HWY_ATTR {
            const std::size_t at = stretch.at + i;
            store<kPixels>(d, in, painted(d, in, settings.load(d, at), sums, at), buffer,
                           in.buffer + stretch.columns.first + kPixels * i);
        });
    }
}

/// Stretches put off until there are enough of them to be shaded together.
template <std::size_t kPixels>
class StretchBatch {
  public:
    void add(const ShadeInput& in, const SampledColumns<kPixels>& columns, ShadeBuffer& buffer) {
        if (count_ > 0 && (samples_ + columns.samples() > kMostSamples || !alike(in, *stretches_[0].in))) shade(buffer);
        stretches_[count_++] = {&in, columns, samples_};
        samples_ += columns.samples();
    }
    void shade(ShadeBuffer& buffer) {
        if (count_ > 0) shade_each(std::span<const Stretch<kPixels>>(stretches_, count_), buffer);
        count_ = samples_ = 0;
    }

  private:
    /// Whether the same is asked of the same texture.
    static bool alike(const ShadeInput& a, const ShadeInput& b) {
        return a.paint->texture == b.paint->texture && a.paint->translucent == b.paint->translucent;
    }
    Stretch<kPixels> stretches_[kMostSamples];
    std::size_t count_ = 0, samples_ = 0;
};

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

/// Two columns a sample.
HWY_INLINE void shade_pairs(const ShadeInput& in, StretchBatch<2>& batch, ShadeBuffer& buffer) {
    const auto total = static_cast<std::size_t>(in.count);
    for (std::size_t i = 0; i < total; i += kMostSamples) batch.add(in, {i, std::min(total - i, kMostSamples)}, buffer);
}

/// Returns how many terms were, or will be with the batch, evaluated at columns themselves.
HWY_INLINE std::uint64_t shade_columns(const ShadeInput& in, StretchBatch<1>& batch, ShadeBuffer& buffer) {
    const auto total = static_cast<std::size_t>(in.count);
    BlockProbe probe;
    std::uint64_t terms = 0;
    for (std::size_t i = 0; i < total;) {
        const std::size_t left = total - i;
        const BlockSamples samples{i};
        // A block much shorter than its samples reach is as soon done without.
        probe.steady = false;
        if (left >= kMostSamples / 2 && in.row->smooth_stretches && may_be_steady(in, samples))
            probe_block(in, samples, probe);
        const SampledColumns<> columns{i, std::min(left, probe.steady ? kMostSamples : kMostSamples / 2)};
        int known_terms = 0;
        if (!probe.steady) {
            batch.add(in, columns, buffer);
        } else if (batch.shade(buffer); probe.slow_terms(in, kCoarseStride) == term_count(in)) {
            known_terms = term_count(in);
            shade_smooth(in, probe, columns.count, buffer, in.buffer + i);
        } else {
            TextureSums sums;
            known_terms = interpolate_slow_terms(in, samples, probe, sums);
            shade_steady(in, probe, columns, known_terms, sums, buffer, in.buffer + i);
        }
        terms += columns.count * static_cast<std::uint64_t>(term_count(in) - known_terms);
        i += columns.count;
    }
    return terms;
}

HWY_INLINE void shade_light(const ShadeInput& in, ShadeBuffer& buffer) {
    const auto fill = [&](std::vector<float>& plane, float value) {
        std::fill_n(plane.begin() + static_cast<std::ptrdiff_t>(in.buffer), in.count, value);
    };
    fill(buffer.red, in.colour[0]);
    fill(buffer.green, in.colour[1]);
    fill(buffer.blue, in.colour[2]);
    fill(buffer.opacity, 1.0F);
}

HWY_INLINE void shade_sky(const ShadeInput& in, ShadeBuffer& buffer) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const Vec3<V> horizon = splat(d, in.row->light->horizon), zenith = splat(d, in.row->light->zenith);
    for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); i += hn::Lanes(d)) {
        const Vec3<V> ray = ray_at(d, in, hn::Iota(d, static_cast<float>(i)));
        const V sine = hn::Max(hn::Zero(d), hn::Mul(ray.z, inverse_sqrt(d, dot(ray, ray))));
        const std::size_t at = in.buffer + i;
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
