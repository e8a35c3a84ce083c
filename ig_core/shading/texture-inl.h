/// The texturing function (Gardner 1984, Eq 15), filtered by what a pixel covers.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_TEXTURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_TEXTURE_INL_H_
#undef QUADRIG_TEXTURE_INL_H_
#else
#define QUADRIG_TEXTURE_INL_H_
#endif

#include "ig_core/shading/cosine-inl.h"
#include "ig_core/shading/samples-inl.h"
#include "ig_core/shading/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Points of a surface, metres from the eye in scene axes, and their footprints: the mean squared growth of the two
/// sine families' arguments per unit frequency over a pixel (m^2).
struct TexturePoints {
    Values x, y, z, footprint_x, footprint_y;
};

/// The two factors of Eq 15 and the squared amplitudes that filtering has left in each, over some of the terms.
struct TextureSums {
    Values x, y, kept_x, kept_y;

    /// T
    template <class D>
    [[nodiscard]] HWY_INLINE hn::Vec<D> value(D d, std::size_t i) const {
        return hn::Mul(x.load(d, i), y.load(d, i));
    }
    /// Of T: the variance of what filtering took out of it.
    template <class D, class V = hn::Vec<D>>
    [[nodiscard]] HWY_INLINE V lost_variance(D d, const FrameTexture& texture, std::size_t i) const {
        const V half = hn::Set(d, 0.5F), variance = splat(d, texture.variance);
        const V lost_x = hn::Max(hn::Zero(d), hn::NegMulAdd(half, kept_x.load(d, i), variance));
        const V lost_y = hn::Max(hn::Zero(d), hn::NegMulAdd(half, kept_y.load(d, i), variance));
        const V fx = x.load(d, i), fy = y.load(d, i);
        return hn::MulAdd(hn::Mul(fx, fx), lost_y, hn::Mul(hn::MulAdd(fy, fy, lost_y), lost_x));
    }
};

/// Terms [first, last) of the texturing function (Eq 15) at `count` points, added to `sums`, which the first term
/// begins. Each sine is faded as 1 - w^2 footprint / kFilteredAway.
template <SineMethod kMethod, bool kVertical, bool kKept>
HWY_NOINLINE void add_terms_by(const FrameTexture& texture, int first, int last, const TexturePoints& points,
                               std::size_t count, TextureSums& sums) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const V zero = hn::Zero(d), half = hn::Set(d, 0.5F);
    const Cosine<V, kMethod> sine(d, 1.0F), across(d, 0.25F), up(d, 0.5F * texture.vertical);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const V px = points.x.load(d, i), py = points.y.load(d, i);
        const V half_x = hn::Mul(half, px), half_y = hn::Mul(half, py), half_z = hn::Mul(half, points.z.load(d, i));
        const V footprint_x = points.footprint_x.load(d, i), footprint_y = points.footprint_y.load(d, i);
        // All phases, then all their sines: again for the sake of short chains.
        V amplitude_x[kMaxTextureTerms], amplitude_y[kMaxTextureTerms];
        V phase_x[kMaxTextureTerms], phase_y[kMaxTextureTerms];
        std::size_t terms = 0;
        for (int k = first; k < last; ++k, ++terms) {
            const FrameTexture::Term& term = texture.terms[static_cast<std::size_t>(k)];
            const V full = splat(d, term.amplitude), fade = splat(d, term.fade);
            amplitude_x[terms] = hn::Max(zero, hn::NegMulAdd(fade, footprint_x, full));
            amplitude_y[terms] = hn::Max(zero, hn::NegMulAdd(fade, footprint_y, full));
            if (hn::AllTrue(d, hn::Eq(hn::Max(amplitude_x[terms], amplitude_y[terms]), zero))) break;
            const V w = splat(d, term.turns_per_metre);
            V x = hn::MulAdd(w, px, splat(d, term.along_x)), y = hn::MulAdd(w, py, splat(d, term.along_y));
            x = across.add(hn::MulAdd(w, half_y, splat(d, term.half_y)), x);
            y = across.add(hn::MulAdd(w, half_x, splat(d, term.half_x)), y);
            if constexpr (kVertical) {
                x = up.add(hn::MulAdd(w, half_z, splat(d, term.up_x)), x);
                y = up.add(hn::MulAdd(w, half_z, splat(d, term.up_y)), y);
            }
            phase_x[terms] = x;
            phase_y[terms] = y;
        }
        V x = first > 0 ? sums.x.load(d, i) : half, y = first > 0 ? sums.y.load(d, i) : half;
        V kept_x = first > 0 && kKept ? sums.kept_x.load(d, i) : zero;
        V kept_y = first > 0 && kKept ? sums.kept_y.load(d, i) : zero;
        for (std::size_t k = 0; k < terms; ++k) {
            if constexpr (kKept) {
                kept_x = hn::MulAdd(amplitude_x[k], amplitude_x[k], kept_x);
                kept_y = hn::MulAdd(amplitude_y[k], amplitude_y[k], kept_y);
            }
            x = sine.add(phase_x[k], amplitude_x[k], x);
            y = sine.add(phase_y[k], amplitude_y[k], y);
        }
        sums.x.store(d, x, i), sums.y.store(d, y, i);
        if constexpr (kKept) sums.kept_x.store(d, kept_x, i), sums.kept_y.store(d, kept_y, i);
    }
}

/// add_terms_by() as the texture, its use (`kept`: whether the kept amplitudes are asked for) and the frame's quality
/// need it.
HWY_INLINE void add_terms(const FrameTexture& texture, bool kept, int first, int last, const TexturePoints& points,
                          std::size_t count, TextureSums& sums) {
    const auto add = [&]<SineMethod kMethod>(std::integral_constant<SineMethod, kMethod>) HWY_ATTR {
        if (texture.vertical != 0.0F) {
            if (kept)
                add_terms_by<kMethod, true, true>(texture, first, last, points, count, sums);
            else
                add_terms_by<kMethod, true, false>(texture, first, last, points, count, sums);
        } else if (kept) {
            add_terms_by<kMethod, false, true>(texture, first, last, points, count, sums);
        } else {
            add_terms_by<kMethod, false, false>(texture, first, last, points, count, sums);
        }
    };
    switch (texture.sine) {
        case SineMethod::polynomial:
            return add(std::integral_constant<SineMethod, SineMethod::polynomial>());
        case SineMethod::parabola:
            return add(std::integral_constant<SineMethod, SineMethod::parabola>());
        case SineMethod::table:
            return add(std::integral_constant<SineMethod, SineMethod::table>());
        case SineMethod::library:
            return add(std::integral_constant<SineMethod, SineMethod::library>());
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
