/// Blocks of columns on which light, haze, footprints and slow terms change so little that they are interpolated
/// between samples.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_BLOCK_INL_H_
#undef QUADRIG_BLOCK_INL_H_
#else
#define QUADRIG_BLOCK_INL_H_
#endif

#include <algorithm>
#include <numbers>

#include "ig_core/shading/interpolation-inl.h"
#include "ig_core/shading/surface_point-inl.h"
#include "ig_core/shading/texture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE int term_count(const ShadeInput& in) { return in.paint->texture == nullptr ? 0 : in.paint->texture->count; }

/// What light and haze make of a surface point, whatever its texture.
template <class V>
struct Setting {
    V lit;        ///< intensity without texture
    V kept;       ///< what the haze lets through
    V threshold;  ///< of translucence
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Setting<V> setting_at(D d, const ShadeInput& in, V length, const SurfacePoint<V>& point) {
    const V one = hn::Set(d, 1.0F);
    const FrameLight& light = *in.row->light;
    const FramePaint& paint = *in.paint;
    const V facing = hn::Max(hn::Zero(d), hn::Mul(dot(point.normal, splat(d, light.to_sun)), point.inverse_length));
    const V lit = hn::MulAdd(hn::Set(d, 1.0F - light.ambient), facing, splat(d, light.ambient));
    Setting<V> setting{lit, one, one};
    if (light.haze) setting.kept = exp2_minus(d, hn::Mul(hn::Mul(point.depth, length), splat(d, light.extinction)));
    if (paint.translucent)
        setting.threshold = hn::MulAdd(hn::Set(d, paint.limb_threshold - paint.threshold),
                                       hn::Sub(one, limb_share(d, in, point)), splat(d, paint.threshold));
    return setting;
}

/// Settings of many points.
struct Settings {
    Values lit, kept, threshold;

    template <class D, class V = hn::Vec<D>>
    HWY_INLINE void store(D d, const Setting<V>& setting, std::size_t i) {
        lit.store(d, setting.lit, i), kept.store(d, setting.kept, i), threshold.store(d, setting.threshold, i);
    }
    template <class D>
    [[nodiscard]] HWY_INLINE Setting<hn::Vec<D>> load(D d, std::size_t i) const {
        return {lit.load(d, i), kept.load(d, i), threshold.load(d, i)};
    }
    /// That of a block's columns c and on, these being its samples'.
    template <class D, class V = hn::Vec<D>>
    [[nodiscard]] HWY_INLINE Setting<V> between(D d, const ShadeInput& in, std::size_t c) const {
        const V one = hn::Set(d, 1.0F);
        return {between_coarse(d, lit, c), in.row->light->haze ? between_coarse(d, kept, c) : one,
                in.paint->translucent ? between_coarse(d, threshold, c) : one};
    }
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE void store_point(D d, const Vec3<V>& ray, V depth, TexturePoints& points, std::size_t i) {
    points.x.store(d, hn::Mul(depth, ray.x), i);
    points.y.store(d, hn::Mul(depth, ray.y), i);
    points.z.store(d, hn::Mul(depth, ray.z), i);
}
template <class D, class V = hn::Vec<D>>
HWY_INLINE void store_footprint(D d, const Footprint<V>& footprint, TexturePoints& points, std::size_t i) {
    points.footprint_x.store(d, footprint.x, i);
    points.footprint_y.store(d, footprint.y, i);
}

/// A block's samples, and what they tell about it.
struct BlockProbe {
    TexturePoints points;
    Settings settings;
    bool steady = false;        ///< settings and footprints may be interpolated
    float most_step2 = 0.0F;    ///< largest footprint of a step to the next column, m^2
    float least_pixel2 = 0.0F;  ///< least footprint of a pixel, m^2

    /// Terms that may be interpolated between samples so many columns apart, if the block is steady.
    [[nodiscard]] int slow_terms(const ShadeInput& in, std::size_t stride) const {
        const float reach2 = static_cast<float>(stride * stride) * most_step2;
        const int terms = term_count(in);
        int count = 0;
        for (; count < terms; ++count) {
            const FrameTexture::Term& term = in.paint->texture->terms[static_cast<std::size_t>(count)];
            const float w = 2.0F * std::numbers::pi_v<float> * term.turns_per_metre;
            // One that has been filtered away needs no samples.
            const float amplitude = std::max(0.0F, term.amplitude - term.fade * least_pixel2);
            if (cubic_error(amplitude, w * w * reach2) > kLargestError) break;
        }
        return count;
    }
};

/// Samples are taken a little beyond a surface's ends too, where its equation goes on; near a limb nothing is steady.
HWY_NOINLINE void probe_block(const ShadeInput& in, const BlockSamples& samples, BlockProbe& probe) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    constexpr auto stride = static_cast<float>(kCoarseStride);
    V step2 = hn::Zero(d), pixel2 = hn::Set(d, 1e30F);
    bool lit = true, in_shadow = true;
    probe.steady = true;
    for (std::size_t i = 0; i < BlockSamples::kCount; i += hn::Lanes(d)) {
        const V column = samples.column(d, i);
        const Vec3<V> ray = ray_at(d, in, column);
        const Length<V> length = length_of(d, ray);
        const SurfacePoint<V> point = on_surface(d, in, column, ray, entry_at(d, in, column, ray));
        probe.steady = probe.steady && changes_little(d, in, column, stride, point);
        const V facing = dot(point.normal, splat(d, in.row->light->to_sun));
        lit = lit && hn::AllTrue(d, hn::Ge(facing, hn::Zero(d)));
        in_shadow = in_shadow && hn::AllTrue(d, hn::Le(facing, hn::Zero(d)));
        PixelFootprint<V> f{{hn::Zero(d), hn::Zero(d)}, {hn::Zero(d), hn::Zero(d)}};
        if (term_count(in) > 0) f = pixel_footprint(d, in, point, ray, length);
        step2 = hn::Max(step2, hn::Max(f.column.x, f.column.y));
        pixel2 = hn::Min(pixel2, hn::Min(f.pixel.x, f.pixel.y));
        store_point(d, ray, point.depth, probe.points, i);
        store_footprint(d, f.pixel, probe.points, i);
        probe.settings.store(d, setting_at(d, in, length.value, point), i);
    }
    probe.most_step2 = hn::GetLane(hn::MaxOfLanes(d, step2));
    probe.least_pixel2 = hn::GetLane(hn::MinOfLanes(d, pixel2));
    // The shadow's border is a kink.
    probe.steady = probe.steady && (lit || in_shadow);
}

/// The same sums at four times as many places.
HWY_INLINE void refined(const TextureSums& sums, bool kept, void (*refine)(const Values&, Values&), TextureSums& more) {
    refine(sums.x, more.x);
    refine(sums.y, more.y);
    if (!kept) return;
    refine(sums.kept_x, more.kept_x);
    refine(sums.kept_y, more.kept_y);
}

/// Sums of a steady block's slow terms, as many as are returned, at all its columns: between fine samples, and the
/// slowest between the block's own.
HWY_NOINLINE int interpolate_slow_terms(const ShadeInput& in, const BlockSamples& samples, const BlockProbe& probe,
                                        TextureSums& sums) {
    const int terms = probe.slow_terms(in, kFineStride);
    if (terms == 0) return 0;
    const hn::ScalableTag<float> d;
    TexturePoints points;
    for (std::size_t i = 0; i < kFineCount; i += hn::Lanes(d)) {
        const auto column = samples.fine_column(d, i);
        const auto ray = ray_at(d, in, column);
        store_point(d, ray, entry_at(d, in, column, ray).depth, points, i);
    }
    to_fine(probe.points.footprint_x, points.footprint_x);
    to_fine(probe.points.footprint_y, points.footprint_y);
    const FrameTexture& texture = *in.paint->texture;
    const bool kept = in.paint->translucent;
    TextureSums coarse, fine;
    const int slowest = probe.slow_terms(in, kCoarseStride);
    if (slowest > 0) {
        add_terms(texture, kept, 0, slowest, probe.points, BlockSamples::kCount, coarse);
        refined(coarse, kept, to_fine, fine);
    }
    if (terms > slowest) add_terms(texture, kept, slowest, terms, points, kFineCount, fine);
    refined(fine, kept, to_columns, sums);
    return terms;
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
