/// Blocks of columns on which light, haze, footprints and slow terms change so little that they are interpolated
/// between samples.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_BLOCK_INL_H_
#undef QUADRIG_BLOCK_INL_H_
#else
#define QUADRIG_BLOCK_INL_H_
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

/// Settings of a block's samples.
struct Settings {
    SampleValues lit, kept, footprint_x, footprint_y, threshold;

    template <class D>
    [[nodiscard]] HWY_INLINE Footprint<hn::Vec<D>> footprint(D d, std::size_t i) const {
        return {footprint_x.load(d, i), footprint_y.load(d, i)};
    }
    template <class D>
    [[nodiscard]] HWY_INLINE Setting<hn::Vec<D>> load(D d, std::size_t i) const {
        return {lit.load(d, i), kept.load(d, i), footprint(d, i), threshold.load(d, i)};
    }
    template <class D, class V = hn::Vec<D>>
    HWY_INLINE void store(D d, const Setting<V>& setting, std::size_t i) {
        lit.store(d, setting.lit, i), kept.store(d, setting.kept, i), threshold.store(d, setting.threshold, i);
        footprint_x.store(d, setting.footprint.x, i), footprint_y.store(d, setting.footprint.y, i);
    }
    /// Columns c and on of the block.
    template <class D, class V = hn::Vec<D>>
    [[nodiscard]] HWY_INLINE Setting<V> between(D d, const ShadeInput& in, std::size_t c) const {
        const V one = hn::Set(d, 1.0F);
        return {between_coarse(d, lit, c),
                in.light->haze ? between_coarse(d, kept, c) : one,
                {between_coarse(d, footprint_x, c), between_coarse(d, footprint_y, c)},
                in.paint->translucent ? between_coarse(d, threshold, c) : one};
    }
};

/// Sums of a texture's terms, of many points.
template <class Values>
struct SumsOfTerms {
    Values x, y, kept_x, kept_y;

    template <class D>
    [[nodiscard]] HWY_INLINE TextureSums<hn::Vec<D>> load(D d, std::size_t i, bool kept) const {
        if (!kept) return {x.load(d, i), y.load(d, i), hn::Zero(d), hn::Zero(d)};
        return {x.load(d, i), y.load(d, i), kept_x.load(d, i), kept_y.load(d, i)};
    }
    template <class D, class V = hn::Vec<D>>
    HWY_INLINE void store(D d, const TextureSums<V>& sums, std::size_t i) {
        x.store(d, sums.x, i), y.store(d, sums.y, i), kept_x.store(d, sums.kept_x, i), kept_y.store(d, sums.kept_y, i);
    }
};

/// What is known of a block of columns by interpolation: the sums of the texture's first terms and, if it is steady,
/// the setting.
struct KnownBlock {
    int terms = 0;
    SumsOfTerms<BlockValues> sums;
    const Settings* setting = nullptr;  ///< of samples
};

/// Terms [first, last) of the surface's texture at a point, added to `sums`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void add_terms_at(D d, const ShadeInput& in, int first, int last, const Vec3<V>& ray, V depth,
                             const Footprint<V>& footprint, TextureSums<V>& sums) {
    if (first >= last) return;
    const Vec3<V> p{hn::Mul(depth, ray.x), hn::Mul(depth, ray.y), hn::Mul(depth, ray.z)};
    add_terms(d, *in.paint->texture, in.paint->translucent, first, last, p, footprint.x, footprint.y, sums);
}

/// A block's samples, and what they tell about it.
struct BlockProbe {
    SampleValues depth;
    Settings setting;
    bool steady = false;        ///< the setting may be interpolated
    float most_step2 = 0.0F;    ///< largest footprint of a step to the next column, m^2
    float least_pixel2 = 0.0F;  ///< least footprint of a pixel, m^2

    /// Terms that may be interpolated between samples so many columns apart, if the block is steady.
    [[nodiscard]] int slow_terms(const ShadeInput& in, std::size_t stride) const {
        const float reach2 = static_cast<float>(stride * stride) * most_step2;
        const int terms = term_count(in);
        int count = 0;
        for (; count < terms; ++count) {
            const float w = in.paint->texture->terms[static_cast<std::size_t>(count)].turns_per_metre;
            const float w2 = 4.0F * 9.8696044F * w * w;
            // A term that has been filtered away needs no samples.
            const bool slow = w2 * reach2 <= kLargestPhaseStep * kLargestPhaseStep, gone = w2 * least_pixel2 >= 48.0F;
            if (!slow && !gone) break;
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
        const V length = vector_length(d, ray);
        const SurfacePoint<V> point = on_surface(d, in, column, ray);
        probe.steady = probe.steady && changes_little(d, in, column, stride, point);
        const V facing = dot(point.normal, splat(d, in.light->to_sun));
        lit = lit && hn::AllTrue(d, hn::Ge(facing, hn::Zero(d)));
        in_shadow = in_shadow && hn::AllTrue(d, hn::Le(facing, hn::Zero(d)));
        PixelFootprint<V> f{{hn::Zero(d), hn::Zero(d)}, {hn::Zero(d), hn::Zero(d)}};
        if (term_count(in) > 0) f = pixel_footprint(d, in, point, ray, length);
        step2 = hn::Max(step2, hn::Max(f.column.x, f.column.y));
        pixel2 = hn::Min(pixel2, hn::Min(f.pixel.x, f.pixel.y));
        probe.depth.store(d, point.depth, i);
        probe.setting.store(d, setting_at(d, in, length, point, f.pixel), i);
    }
    probe.most_step2 = hn::GetLane(hn::MaxOfLanes(d, step2));
    probe.least_pixel2 = hn::GetLane(hn::MinOfLanes(d, pixel2));
    // The shadow's border is a kink.
    probe.steady = probe.steady && (lit || in_shadow);
}

/// Interpolates what may be in a steady block: the slow terms from fine samples between its own.
HWY_NOINLINE void interpolate_block(const ShadeInput& in, const BlockSamples& samples, const BlockProbe& probe,
                                    KnownBlock& known) {
    const hn::ScalableTag<float> d;
    known.setting = &probe.setting;
    known.terms = probe.slow_terms(in, kFineStride);
    if (known.terms == 0) return;
    FineValues footprint_x, footprint_y;
    to_fine(probe.setting.footprint_x, footprint_x);
    to_fine(probe.setting.footprint_y, footprint_y);
    SumsOfTerms<FineValues> at;
    for (std::size_t i = 0; i < kFineCount; i += hn::Lanes(d)) {
        const auto column = samples.fine_column(d, i);
        const auto ray = ray_at(d, in, column);
        auto sums = TextureSums<hn::Vec<decltype(d)>>::none(d);
        add_terms_at(d, in, 0, known.terms, ray, on_surface(d, in, column, ray).depth,
                     {footprint_x.load(d, i), footprint_y.load(d, i)}, sums);
        at.store(d, sums, i);
    }
    to_columns(at.x, known.sums.x);
    to_columns(at.y, known.sums.y);
    if (!in.paint->translucent) return;
    to_columns(at.kept_x, known.sums.kept_x);
    to_columns(at.kept_y, known.sums.kept_y);
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
