/// Elementary functions for any vector width, with their errors.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_VECTOR_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_VECTOR_MATH_INL_H_
#undef QUADRIG_VECTOR_MATH_INL_H_
#else
#define QUADRIG_VECTOR_MATH_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Vec3 {
    V x, y, z;
};

template <class V>
HWY_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
/// A float that lies in memory, in all lanes. By the integers' instruction: Zen 4 does that while it loads, but the
/// floats' in an arithmetic unit too.
template <class D>
HWY_INLINE hn::Vec<D> splat(D d, const float& x) {
    return hn::BitCast(d, hn::Set(hn::RebindToUnsigned<D>(), std::bit_cast<std::uint32_t>(x)));
}
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vec3<V> splat(D d, const std::array<float, 3>& v) {
    return {splat(d, v[0]), splat(d, v[1]), splat(d, v[2])};
}
/// a + f b
template <class V>
HWY_INLINE Vec3<V> mul_add(V f, const Vec3<V>& b, const Vec3<V>& a) {
    return {hn::MulAdd(f, b.x, a.x), hn::MulAdd(f, b.y, a.y), hn::MulAdd(f, b.z, a.z)};
}

/// 1 / sqrt(x) for x > 0, relative error <= 7e-7, without the two slowest instructions there are: Newton's iteration
/// from the exponent halved (Walczyk, Moroz, Cieslinski, "Improving the accuracy of the fast inverse square root",
/// 2021). Unlike the processors' own estimates it has the same bits on every machine.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V inverse_sqrt(D d, V x) {
    const hn::RebindToSigned<D> di;
    const auto halved_exponent = hn::ShiftRight<1>(hn::BitCast(di, x));
    V y = hn::BitCast(d, hn::Sub(hn::Set(di, 0x5F1FFFF9), halved_exponent));
    y = hn::Mul(y, hn::NegMulAdd(hn::Mul(hn::Set(d, 0.703952253F), x), hn::Mul(y, y), hn::Set(d, 1.68191391F)));
    return hn::Mul(y, hn::NegMulAdd(hn::Mul(hn::Set(d, 0.5F), x), hn::Mul(y, y), hn::Set(d, 1.5F)));
}

/// A vector's length and its inverse.
template <class V>
struct Length {
    V value, inverse;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE Length<V> length_of(D d, const Vec3<V>& v) {
    const V squared = dot(v, v), inverse = inverse_sqrt(d, squared);
    return {hn::Mul(squared, inverse), inverse};
}

/// 1.5 * 2^23: the low bits of its sum with x, |x| < 2^22, are those of the integer nearest to x.
constexpr float kToNearest = 12582912.0F;

/// 2^-y for y >= 0, relative error <= 3e-6; 0 beyond 126.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exp2_minus(D d, V y) {
    const hn::RebindToSigned<D> di;
    const V x = hn::Neg(hn::Min(y, hn::Set(d, 126.0F)));
    const V nearest = hn::Add(x, hn::Set(d, kToNearest));
    const V r = hn::Sub(x, hn::Sub(nearest, hn::Set(d, kToNearest)));
    V p = hn::MulAdd(r, hn::Set(d, 0.00956992228F), hn::Set(d, 0.05591770886F));
    p = hn::MulAdd(r, p, hn::Set(d, 0.24024747254F));
    p = hn::MulAdd(r, p, hn::Set(d, 0.69312183686F));
    p = hn::MulAdd(r, p, hn::Set(d, 0.99999926155F));
    const auto exponent = hn::ShiftLeft<23>(hn::BitCast(di, nearest));
    return hn::BitCast(d, hn::Add(hn::BitCast(di, p), exponent));
}

/// One of eight numbers, a lane's own. Vectors of eight lanes and more hold them all.
struct EightNumbers {
    alignas(64) float at[16];
    template <class D, class VI = hn::Vec<hn::RebindToSigned<D>>>
    [[nodiscard]] HWY_INLINE hn::Vec<D> of(D d, VI index) const {
        if constexpr (hn::MaxLanes(D()) >= 8)
            return hn::TableLookupLanes(hn::Load(d, at), hn::IndicesFromVec(d, index));
        else
            return hn::GatherIndex(d, at, index);
    }
};

/// sRGB of linear light (IEC 61966-2-1), 0..255, within 0.02 of a step: a cubic for each octave of y, which is linear
/// light, scaled, from a place on that lets the first octave end near the curve's linear toe.
template <class D>
HWY_INLINE hn::Vec<D> srgb_steps(D d, hn::Vec<D> linear) {
    static constexpr EightNumbers kCubic[4] = {
        {{-11.1703062F, -24.2912769F, -5.35713959F, 7.3033371F, 20.0040054F, 34.8577194F, 53.4594383F, 77.3598709F}},
        {{1709.55957F, 6719.81787F, 2868.7981F, 1625.34473F, 1009.45496F, 651.279602F, 427.580017F, 283.801483F}},
        {{285154.594F, -321492.094F, -55924.4648F, -14438.8184F, -4289.49023F, -1354.10046F, -439.764374F,
          -145.864197F}},
        {{-16361678.0F, 6724076.5F, 535553.438F, 66417.0703F, 9677.04004F, 1513.01111F, 244.535202F, 40.6713905F}}};
    constexpr int kFirstOctave = 127 - 8;  // y begins a little above 2^-8 and ends a little below 1
    const hn::RebindToSigned<D> di;
    const auto x = hn::Clamp(linear, hn::Zero(d), hn::Set(d, 1.0F));
    const auto y = hn::MulAdd(x, hn::Set(d, 0.987413168F), hn::Set(d, 0.0042578125F));
    const auto octave = hn::Sub(hn::ShiftRight<23>(hn::BitCast(di, y)), hn::Set(di, kFirstOctave));
    auto p = kCubic[3].of(d, octave);
    for (const int power : {2, 1, 0}) p = hn::MulAdd(y, p, kCubic[power].of(d, octave));
    return p;
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
