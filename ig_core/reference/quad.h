/// Quadruple precision (113-bit mantissa): the scalar in which the reference decides every sign.
/// Plain arithmetic comes from the compiler; the few functions needed are here, each good to a few units in the last
/// place.
#pragma once

#include <cmath>
#include <numbers>

#include "ig_core/geometry/space.h"

namespace quadrig::reference {

using Quad = __float128;

/// Relative limits of a scalar type: below `touch` a sum of products is rounding, below `thin` a length along a ray is
/// none.
template <class Scalar>
struct Limits;
template <>
struct Limits<long double> {
    static constexpr long double touch = 0x1p-60L;
    static constexpr long double thin = 0x1p-50L;
};
template <>
struct Limits<Quad> {
    static constexpr long double touch = 0x1p-105L;
    static constexpr long double thin = 0x1p-80L;
};

template <class Scalar>
constexpr Scalar magnitude(Scalar value) {
    return value < 0 ? -value : value;
}

inline long double square_root(long double value) { return std::sqrt(value); }

/// One Newton step doubles the 64 bits of the long double root.
inline Quad square_root(Quad value) {
    const Quad root = std::sqrt(static_cast<long double>(value));
    return root > 0 ? (root + value / root) / 2 : root;
}

struct SineCosine {
    Quad sine;
    Quad cosine;
};

/// Sine and cosine of an angle of any size; multiples of 90 degrees are exact.
inline SineCosine sine_cosine(Degrees angle) {
    int quarter_turns = 0;
    const Quad remainder = std::remquo(angle.value, 90.0, &quarter_turns);
    // Pi as three doubles, the first of them std::numbers::pi.
    const Quad pi = Quad(std::numbers::pi) + Quad(1.2246467991473531772e-16) + Quad(-2.9947698097183396659e-33);
    const Quad radians = remainder * pi / 180;
    Quad sine = 0, cosine = 0, term = 1;
    for (int n = 0; n < 32; n += 4) {  // (pi/4)^32 / 32! < 2^-113
        cosine += term;
        term *= radians / (n + 1);
        sine += term;
        term *= radians / (n + 2);
        cosine -= term;
        term *= radians / (n + 3);
        sine -= term;
        term *= radians / (n + 4);
    }
    switch (quarter_turns & 3) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

}  // namespace quadrig::reference
