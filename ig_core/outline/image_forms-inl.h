/// Formulas of the image for some curves, rows, scan lines or points at a time, one a vector lane, written as they read
/// for one. Products and sums are rounded apart: the same comes out on every instruction set.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_IMAGE_FORMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_IMAGE_FORMS_INL_H_
#undef QUADRIG_IMAGE_FORMS_INL_H_
#else
#define QUADRIG_IMAGE_FORMS_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cmath>

#include "ig_core/outline/image_forms.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What numbers are loaded from and stored to has room for a multiple of eight.
using D = hn::CappedTag<double, 8>;
using Mask = hn::Mask<D>;

struct Number {
    hn::Vec<D> v;
    HWY_INLINE Number(hn::Vec<D> of_each) : v(of_each) {}
    HWY_INLINE Number(double of_all) : v(hn::Set(D(), of_all)) {}
    template <std::size_t kSize>
    HWY_INLINE Number(const std::array<double, kSize>& lanes, std::size_t from) : v(hn::LoadU(D(), &lanes[from])) {}
    template <std::size_t kSize>
    HWY_INLINE void store(std::array<double, kSize>& lanes, std::size_t from) const {
        hn::StoreU(v, D(), &lanes[from]);
    }
};
HWY_INLINE Number operator+(Number a, Number b) { return hn::Add(a.v, b.v); }
HWY_INLINE Number operator-(Number a, Number b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Number operator*(Number a, Number b) { return hn::Mul(a.v, b.v); }
HWY_INLINE Number operator/(Number a, Number b) { return hn::Div(a.v, b.v); }
HWY_INLINE Number operator-(Number a) { return hn::Neg(a.v); }
HWY_INLINE Mask operator<(Number a, Number b) { return hn::Lt(a.v, b.v); }
HWY_INLINE Mask operator>(Number a, Number b) { return hn::Gt(a.v, b.v); }
HWY_INLINE Mask operator<=(Number a, Number b) { return hn::Le(a.v, b.v); }
HWY_INLINE Mask operator>=(Number a, Number b) { return hn::Ge(a.v, b.v); }
HWY_INLINE Mask operator==(Number a, Number b) { return hn::Eq(a.v, b.v); }
HWY_INLINE Mask operator!=(Number a, Number b) { return hn::Ne(a.v, b.v); }
HWY_INLINE Number magnitude(Number a) { return hn::Abs(a.v); }
HWY_INLINE Number with_sign_of(Number sign, Number size) { return hn::CopySign(size.v, sign.v); }
HWY_INLINE Number larger(Number a, Number b) { return hn::Max(a.v, b.v); }
HWY_INLINE Number square_root(Number a) { return hn::Sqrt(a.v); }
HWY_INLINE Number either(Mask first, Number one, Number other) { return hn::IfThenElse(first, one.v, other.v); }

/// c[0] + c[1] x, and + c[2] x^2.
HWY_INLINE Number polynomial(const std::array<double, 2>& c, Number x) { return c[0] + x * c[1]; }
HWY_INLINE Number polynomial(const std::array<double, 3>& c, Number x) { return c[0] + x * (c[1] + x * c[2]); }

struct Vector {
    Number x, y, z;
    HWY_INLINE Vector(Number of_x, Number of_y, Number of_z) : x(of_x), y(of_y), z(of_z) {}
    HWY_INLINE Vector(const glm::dvec3& of_all) : x(of_all.x), y(of_all.y), z(of_all.z) {}
    template <std::size_t kSize>
    HWY_INLINE Vector(const std::array<std::array<double, kSize>, 3>& lanes, std::size_t from)
        : x(lanes[0], from), y(lanes[1], from), z(lanes[2], from) {}
    template <std::size_t kSize>
    HWY_INLINE void store(std::array<std::array<double, kSize>, 3>& lanes, std::size_t from) const {
        x.store(lanes[0], from), y.store(lanes[1], from), z.store(lanes[2], from);
    }
};
HWY_INLINE Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE Vector operator*(Number f, const Vector& a) { return {f * a.x, f * a.y, f * a.z}; }
HWY_INLINE Number dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
HWY_INLINE Vector times(const Sym3& m, const Vector& v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
HWY_INLINE Number value(const Sym3& m, const Vector& v) {
    return m.xx * v.x * v.x + m.yy * v.y * v.y + m.zz * v.z * v.z +
           2.0 * (m.xy * v.x * v.y + m.xz * v.x * v.z + m.yz * v.y * v.z);
}

/// Where a conic's form goes from negative to positive with xi (`rising`), or from positive to negative.
HWY_INLINE Number root_on_row(const RowConic& conic, bool rising, Number zeta) {
    const Number discriminant = polynomial(conic.discriminant, zeta), beta = polynomial(conic.beta, zeta);
    const Number root = square_root(either(discriminant > 0.0, discriminant, 0.0));
    const Number sum = with_sign_of(0.0 - beta, root + magnitude(beta));  // never cancels
    // A row that only touches the conic has one root twice, and gamma and sum may both be nothing but rounding.
    const Mask by_alpha = hn::Or(rising ? beta <= 0.0 : beta > 0.0, root == 0.0);
    return either(by_alpha, sum, polynomial(conic.gamma, zeta)) / either(by_alpha, conic.alpha, sum);
}

/// Whether a plane takes a point away, by more than kKeeping beside its terms: a plane that holds both eye and point
/// has nothing but their rounding.
HWY_INLINE Mask loses(const EyePlane& plane, const Vector& p) {
    const Number x = plane.normal.x * p.x, y = plane.normal.y * p.y, z = plane.normal.z * p.z;
    const Number size = magnitude(x) + magnitude(y) + magnitude(z) + std::abs(plane.at_eye);
    return x + y + z + plane.at_eye + kKeeping * size < 0.0;
}
/// An index into a solid's planes that none has.
constexpr double kNoPlane = -1.0;
/// But for the one at `own`.
HWY_INLINE Mask kept_by_planes(const EyeSolid& e, const Vector& p, Number own) {
    Mask kept = own == own;
    for (std::size_t i = 0; i < e.planes.size(); ++i)
        kept = hn::AndNot(hn::And(own != static_cast<double>(i), loses(e.planes[i], p)), kept);
    return kept;
}
/// p'Mp + v.p <= 0
HWY_INLINE Mask faces_eye(const EyeSolid& e, const Vector& p) {
    const Number curved = value(e.m, p), straight = dot(e.v, p);
    return curved + straight <= kKeeping * (magnitude(curved) + magnitude(straight));
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
