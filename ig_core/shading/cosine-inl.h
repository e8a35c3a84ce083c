/// Cosines for any vector width, as a frame's quality asks for them.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_COSINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_COSINE_INL_H_
#undef QUADRIG_COSINE_INL_H_
#else
#define QUADRIG_COSINE_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>

#include "ig_core/quality.h"

// Highway's include guard is per target as well, so this has to come after ours.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// cos(2 pi r), |r| <= 1/2, as y = zero - r^2 times a polynomial in y, its highest power first: minimax among those
/// that are -1 at r = 1/2, so that they stay within -1..1, the parabola's also 0 at r = 1/4. Being even, they need
/// neither r's sign nor its size.
template <std::size_t n>
struct CosineForm {
    float zero;
    std::array<float, n> over;
};

template <SineMethod kMethod>
constexpr auto cosine_form() {
    if constexpr (kMethod == SineMethod::parabola)  // |error| <= 2e-3
        return CosineForm<3>{0.0625F, {59.550980F, 50.000000F, 12.614744F}};
    else if constexpr (kMethod == SineMethod::polynomial)  // |error| <= 1e-6
        return CosineForm<5>{0.062499932F, {20.992824F, 52.186223F, 71.396510F, 50.266799F, 12.566379F}};
}

/// t less the nearest integer
template <class V>
HWY_INLINE V rest_of_turn(V t) {
    return hn::Sub(t, hn::Round(t));
}

/// By an even polynomial: SineMethod::parabola or polynomial.
template <class V, SineMethod kMethod>
class EvenCosine {
  public:
    using D = hn::DFromV<V>;
    HWY_INLINE EvenCosine(D d, float factor) : zero_(hn::Set(d, kForm.zero)) {
        for (std::size_t i = 0; i < kForm.over.size(); ++i) over_[i] = hn::Set(d, factor * kForm.over[i]);
    }
    [[nodiscard]] HWY_INLINE V add(V t, V sum) const {
        const V y = parabola(t);
        return hn::MulAdd(y, over(y), sum);
    }
    [[nodiscard]] HWY_INLINE V add(V t, V amplitude, V sum) const {
        const V y = parabola(t);
        return hn::MulAdd(hn::Mul(amplitude, y), over(y), sum);
    }

  private:
    static constexpr auto kForm = cosine_form<kMethod>();
    [[nodiscard]] HWY_INLINE V parabola(V t) const {
        const V r = rest_of_turn(t);
        return hn::NegMulAdd(r, r, zero_);
    }
    /// The cosine's value over it.
    [[nodiscard]] HWY_INLINE V over(V y) const {
        V p = over_[0];
        for (std::size_t i = 1; i < kForm.over.size(); ++i) p = hn::MulAdd(y, p, over_[i]);
        return p;
    }
    V zero_;
    V over_[kForm.over.size()];
};

constexpr std::int32_t kCosineTableSize = 1024;  // a power of two
inline const float* cosine_table() {
    static const auto table = [] {
        std::array<float, kCosineTableSize> cosines{};
        for (std::size_t i = 0; i < cosines.size(); ++i)
            cosines[i] =
                static_cast<float>(std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / kCosineTableSize));
        return cosines;
    }();
    return table.data();
}

/// The nearest entry of a table, or Highway's.
template <class V, SineMethod kMethod>
class SampledCosine {
  public:
    using D = hn::DFromV<V>;
    HWY_INLINE SampledCosine(D d, float factor) : factor_(hn::Set(d, factor)) {}
    [[nodiscard]] HWY_INLINE V add(V t, V sum) const { return hn::MulAdd(factor_, value(rest_of_turn(t)), sum); }
    [[nodiscard]] HWY_INLINE V add(V t, V amplitude, V sum) const {
        return hn::MulAdd(hn::Mul(amplitude, factor_), value(rest_of_turn(t)), sum);
    }

  private:
    [[nodiscard]] static HWY_INLINE V value(V r) {
        const D d;
        if constexpr (kMethod == SineMethod::table) {
            const hn::RebindToSigned<D> di;
            const auto entry = hn::NearestInt(hn::Mul(r, hn::Set(d, static_cast<float>(kCosineTableSize))));
            return hn::GatherIndex(d, cosine_table(), hn::And(entry, hn::Set(di, kCosineTableSize - 1)));
        } else {
            return hn::Cos(d, hn::Mul(r, hn::Set(d, 6.2831853072F)));
        }
    }
    V factor_;
};

/// Cosines of t turns, |t| up to about 1e3; errors, relative to their amplitude, are those of the method (SineMethod).
///   Cosine(d, factor)
///   add(t, sum)             sum + factor cos(2 pi t)
///   add(t, amplitude, sum)  sum + amplitude factor cos(2 pi t)
template <class V, SineMethod kMethod>
using Cosine = std::conditional_t<kMethod == SineMethod::parabola || kMethod == SineMethod::polynomial,
                                  EvenCosine<V, kMethod>, SampledCosine<V, kMethod>>;

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
