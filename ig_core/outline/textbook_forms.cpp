#include "ig_core/outline/textbook_forms.h"

#include <array>

namespace quadrig {
namespace {

template <class Real>
using Vector = glm::vec<3, Real>;

/// xx yy zz xy xz yz
template <class Real>
using Form = std::array<Real, 6>;
constexpr std::array<std::array<int, 2>, 6> kEntries{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

template <class Real>
Form<Real> rounded(const Sym3& m) {
    return {Real(m.xx), Real(m.yy), Real(m.zz), Real(m.xy), Real(m.xz), Real(m.yz)};
}
template <class Real>
Sym3 widened(const Form<Real>& f) {
    return {f[0], f[1], f[2], f[3], f[4], f[5]};
}
template <class Real>
Vector<Real> times(const Form<Real>& m, const Vector<Real>& v) {
    return {m[0] * v.x + m[3] * v.y + m[4] * v.z, m[3] * v.x + m[1] * v.y + m[5] * v.z,
            m[4] * v.x + m[5] * v.y + m[2] * v.z};
}

template <class Real>
RowConic on_rows(const Form<Real>& f) {
    RowConic conic;
    conic.alpha = f[0];
    conic.beta = {f[3], f[4]};
    conic.gamma = {f[1], Real(2) * f[5], f[2]};
    conic.discriminant = {f[3] * f[3] - f[0] * f[1], Real(2) * (f[3] * f[4] - f[0] * f[5]), f[4] * f[4] - f[0] * f[2]};
    return conic;
}

}  // namespace

template <class Real>
void set_textbook_forms(EyeSolid& e) {
    const Form<Real> m = rounded<Real>(e.m);
    const Vector<Real> a(e.anchor), w(e.w), ma = times(m, a), v = w - ma;
    const Real s = glm::dot(a, ma) - Real(2) * glm::dot(w, a) + Real(e.c);
    Form<Real> limb;
    for (std::size_t k = 0; k < kEntries.size(); ++k)
        limb[k] = v[kEntries[k][0]] * v[kEntries[k][1]] - s * m[k];  // Eq 6
    e.m = widened(m), e.v = glm::dvec3(v), e.s = s, e.limb = widened(limb);
    for (EyePlane& plane : e.planes) {
        const Vector<Real> n(plane.normal);
        plane.normal = glm::dvec3(n);
        plane.at_eye = Real(plane.local_offset) - glm::dot(n, a);
    }
}

template <class Real>
RowConic textbook_limb_on_rows(const EyeSolid& e) {
    return on_rows(rounded<Real>(e.limb));
}

template <class Real>
RowConic textbook_intersection_curve_on_rows(const EyeSolid& e, const EyePlane& plane) {
    const Form<Real> m = rounded<Real>(e.m);
    const Vector<Real> v(e.v), n(plane.normal);
    const auto b = static_cast<Real>(plane.at_eye), s = static_cast<Real>(e.s);
    Form<Real> curve;
    for (std::size_t k = 0; k < kEntries.size(); ++k) {
        const auto [i, j] = kEntries[k];
        curve[k] = b * b * m[k] - b * (v[i] * n[j] + n[i] * v[j]) + s * n[i] * n[j];  // Eq 8
    }
    return on_rows(curve);
}

template <class Real>
glm::dvec3 textbook_visibility_line(const EyeSolid& e, const EyePlane& plane) {
    return glm::dvec3(Real(e.s) * Vector<Real>(plane.normal) - Real(plane.at_eye) * Vector<Real>(e.v));  // Eq 12
}

template <class Real>
glm::dvec3 textbook_intersection_line(const EyePlane& i, const EyePlane& j) {
    return glm::dvec3(Real(j.at_eye) * Vector<Real>(i.normal) - Real(i.at_eye) * Vector<Real>(j.normal));  // Eq 14
}

template void set_textbook_forms<float>(EyeSolid&);
template void set_textbook_forms<double>(EyeSolid&);
template RowConic textbook_limb_on_rows<float>(const EyeSolid&);
template RowConic textbook_limb_on_rows<double>(const EyeSolid&);
template RowConic textbook_intersection_curve_on_rows<float>(const EyeSolid&, const EyePlane&);
template RowConic textbook_intersection_curve_on_rows<double>(const EyeSolid&, const EyePlane&);
template glm::dvec3 textbook_visibility_line<float>(const EyeSolid&, const EyePlane&);
template glm::dvec3 textbook_visibility_line<double>(const EyeSolid&, const EyePlane&);
template glm::dvec3 textbook_intersection_line<float>(const EyePlane&, const EyePlane&);
template glm::dvec3 textbook_intersection_line<double>(const EyePlane&, const EyePlane&);

}  // namespace quadrig
