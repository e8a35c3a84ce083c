/// The texturing function (Gardner 1984, Eq 15), filtered by what a pixel covers.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_TEXTURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_TEXTURE_INL_H_
#undef QUADRIG_TEXTURE_INL_H_
#else
#define QUADRIG_TEXTURE_INL_H_
#endif

#include "ig_core/shading/shade_job.h"
#include "ig_core/shading/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The two factors of Eq 15 and the squared amplitudes that filtering has left in each, over some of the terms.
template <class V>
struct TextureSums {
    V x, y, kept_x, kept_y;
    template <class D>
    static HWY_INLINE TextureSums none(D d) {
        return {hn::Set(d, 0.5F), hn::Set(d, 0.5F), hn::Zero(d), hn::Zero(d)};
    }
    /// T
    [[nodiscard]] HWY_INLINE V value() const { return hn::Mul(x, y); }
    /// Of T: the variance of what filtering took out of it.
    [[nodiscard]] HWY_INLINE V lost_variance(const FrameTexture& texture) const {
        const hn::DFromV<V> d;
        const V half = hn::Set(d, 0.5F), variance = hn::Set(d, texture.variance);
        const V lost_x = hn::Max(hn::Zero(d), hn::NegMulAdd(half, kept_x, variance));
        const V lost_y = hn::Max(hn::Zero(d), hn::NegMulAdd(half, kept_y, variance));
        return hn::MulAdd(hn::Mul(x, x), lost_y, hn::Mul(hn::MulAdd(y, y, lost_y), lost_x));
    }
};

/// Terms [first, last) of the texturing function (Eq 15) at points p, metres from the eye in scene axes, added to
/// `sums`. `footprint_x` and `footprint_y` are the mean squared growth of the two sine families' arguments per unit
/// frequency over a pixel (m^2): each sine is faded as (1 - w^2 footprint / 48)^2, which follows the box filter's
/// exp(-w^2 footprint / 24) and ends a little above the sampling frequency, where the term is dropped.
template <SineMethod kMethod, bool kVertical, bool kKept, class D, class V = hn::Vec<D>>
HWY_INLINE void add_terms(D d, const FrameTexture& texture, int first, int last, const Vec3<V>& p, V footprint_x,
                          V footprint_y, TextureSums<V>& sums) {
    const V zero = hn::Zero(d), quarter = hn::Set(d, 0.25F), half = hn::Set(d, 0.5F);
    using SineOf = Sine<V, kMethod>;
    const SineOf sine(d, 1.0F), across(d, 0.25F), up(d, 0.5F * texture.vertical);
    const V px = p.x, py = p.y, half_x = hn::Mul(half, p.x), half_y = hn::Mul(half, p.y), half_z = hn::Mul(half, p.z);
    // All phases, then all their sines: two short chains of dependent instructions instead of a long one, so that a
    // core sees the next term's in time.
    V amplitude_x[kMaxTextureTerms], amplitude_y[kMaxTextureTerms], phase_x[kMaxTextureTerms],
        phase_y[kMaxTextureTerms];
    std::size_t count = 0;
    for (int i = first; i < last; ++i, ++count) {
        const FrameTexture::Term& term = texture.terms[static_cast<std::size_t>(i)];
        const V full = hn::Set(d, term.root_amplitude), fade = hn::Set(d, term.fade);
        const V keep_x = hn::Max(zero, hn::NegMulAdd(fade, footprint_x, full));
        const V keep_y = hn::Max(zero, hn::NegMulAdd(fade, footprint_y, full));
        if (hn::AllTrue(d, hn::Eq(hn::Max(keep_x, keep_y), zero))) break;
        amplitude_x[count] = hn::Mul(keep_x, keep_x);
        amplitude_y[count] = hn::Mul(keep_y, keep_y);
        const V w = hn::Set(d, term.turns_per_metre);
        V x = hn::MulAdd(w, px, hn::Set(d, term.along_x)), y = hn::MulAdd(w, py, hn::Set(d, term.along_y));
        x = across.add(hn::MulAdd(w, half_y, hn::Set(d, term.half_y)), x);
        y = across.add(hn::MulAdd(w, half_x, hn::Set(d, term.half_x)), y);
        if constexpr (kVertical) {
            const V r = SineOf::reduced(hn::MulAdd(w, half_z, hn::Set(d, term.half_z)));
            const auto sine_z = up.of_reduced(r), cosine_z = up.of_reduced(hn::Sub(quarter, hn::Abs(r)));
            x = hn::MulAdd(sine_z.parabola, sine_z.over, x);
            y = hn::MulAdd(cosine_z.parabola, cosine_z.over, y);
        }
        phase_x[count] = x;
        phase_y[count] = y;
    }
    TextureSums<V> sum = sums;
    for (std::size_t i = 0; i < count; ++i) {
        if constexpr (kKept) {
            sum.kept_x = hn::MulAdd(amplitude_x[i], amplitude_x[i], sum.kept_x);
            sum.kept_y = hn::MulAdd(amplitude_y[i], amplitude_y[i], sum.kept_y);
        }
        sum.x = sine.add(phase_x[i], amplitude_x[i], sum.x);
        sum.y = sine.add(phase_y[i], amplitude_y[i], sum.y);
    }
    sums = sum;
}

template <SineMethod kMethod, class D, class V = hn::Vec<D>>
HWY_NOINLINE void add_terms_by(D d, const FrameTexture& texture, bool kept, int first, int last, const Vec3<V>& p,
                               V footprint_x, V footprint_y, TextureSums<V>& sums) {
    if (texture.vertical != 0.0F) {
        if (kept)
            add_terms<kMethod, true, true>(d, texture, first, last, p, footprint_x, footprint_y, sums);
        else
            add_terms<kMethod, true, false>(d, texture, first, last, p, footprint_x, footprint_y, sums);
    } else if (kept) {
        add_terms<kMethod, false, true>(d, texture, first, last, p, footprint_x, footprint_y, sums);
    } else {
        add_terms<kMethod, false, false>(d, texture, first, last, p, footprint_x, footprint_y, sums);
    }
}

/// add_terms() as the texture, its use and the frame's quality need it.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void add_terms(D d, const FrameTexture& texture, bool kept, int first, int last, const Vec3<V>& p,
                          V footprint_x, V footprint_y, TextureSums<V>& sums) {
    const auto add = [&]<SineMethod kMethod>(std::integral_constant<SineMethod, kMethod>) HWY_ATTR {
        add_terms_by<kMethod>(d, texture, kept, first, last, p, footprint_x, footprint_y, sums);
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
