#include "ig_core/outline/curve_lanes.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/outline/curve_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ig_core/outline/image_forms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
HWY_INLINE void find_conics(const EyeSolid& e, std::size_t at, CurveLanes& curves) {
    const Sym3& m = e.m;
    const Vector n(curves.normal, at), w = e.w;
    const Number b(curves.at_eye, at), a = e.anchor.y, c = e.c;
    // The ray meets the plane at -r / (n.d) about the anchor, r = (b xi, g.d, b zeta).
    const Vector g(a * n.x, {curves.local_offset, at}, a * n.z);
    const Vector wr(w.x * b + w.y * g.x, w.y * g.y, w.y * g.z + w.z * b);  // w.r
    const Number y_of_x = m.xy * b + m.yy * g.x, y_of_z = m.yy * g.z + m.yz * b, z_of_x = m.xz * b + m.yz * g.x;
    (b * (m.xx * b + m.xy * g.x) + g.x * y_of_x + n.x * (c * n.x - 2.0 * wr.x)).store(curves.alpha, at);
    (g.y * y_of_x + c * n.x * n.y - n.x * wr.y - n.y * wr.x).store(curves.beta[0], at);
    (g.z * y_of_x + b * z_of_x + c * n.x * n.z - n.x * wr.z - n.z * wr.x).store(curves.beta[1], at);
    Vector(g.y * m.yy * g.y + n.y * (c * n.y - 2.0 * wr.y),
           2.0 * (g.y * y_of_z + c * n.y * n.z - n.y * wr.z - n.z * wr.y),
           g.z * y_of_z + b * (m.yz * g.z + m.zz * b) + n.z * (c * n.z - 2.0 * wr.z))
        .store(curves.gamma, at);
    // Row and plane meet in lines of direction u0 + zeta u1 and moment t0 + zeta t1.
    const Vector t1(g.x, -b, g.z);  // t0 = (0, 0, g.y), u0 = (n.y, -n.x, 0), u1 = (n.z, 0, -n.x)
    const Vector mx(glm::dvec3(m.xx, m.xy, m.xz)), my(glm::dvec3(m.xy, m.yy, m.yz)), mz(glm::dvec3(m.xz, m.yz, m.zz));
    const Vector mu0 = n.y * mx - n.x * my, mu1 = n.z * mx - n.x * mz;
    const Vector adjugate_t1 = times(e.adjugate, t1), wt1 = cross(w, t1);
    const Number wu0 = w.x * n.y - w.y * n.x, wu1 = w.x * n.z - w.z * n.x, b2 = b * b;
    Vector(b2 * (-g.y * g.y * e.adjugate.zz - c * (n.y * mu0.x - n.x * mu0.y) + wu0 * wu0 +
                 2.0 * g.y * (w.y * mu0.x - w.x * mu0.y)),
           2.0 * b2 *
               (-g.y * adjugate_t1.z - c * (n.y * mu1.x - n.x * mu1.y) + wu0 * wu1 + dot(mu0, wt1) +
                g.y * (w.y * mu1.x - w.x * mu1.y)),
           b2 * (-dot(t1, adjugate_t1) - c * (n.z * mu1.x - n.x * mu1.z) + wu1 * wu1 + 2.0 * dot(mu1, wt1)))
        .store(curves.discriminant, at);
}

/// s n - b v, expanded about the anchor.
HWY_INLINE void find_visibility_lines(const EyeSolid& e, std::size_t at, CurveLanes& curves) {
    const double a = e.anchor.y;
    const Vector n(curves.normal, at), across = cross(n, e.w - e.v);
    const Vector twice(a * across.z, 0.0, -(a * across.x));  // a x (n x Ma)
    (twice + (e.c - 2.0 * e.w.y * a) * n - Number(curves.local_offset, at) * Vector(e.v) + n.y * a * Vector(e.w))
        .store(curves.visibility_line, at);
}

/// The values of t with a t^2 + 2 b t + c = 0; coincident ones within rounding count as real. Those that do not exist
/// are not finite.
struct Roots {
    Number one, other;
};
HWY_INLINE Roots real_roots(Number a, Number b, Number c) {
    const Number discriminant = b * b - a * c;
    const Number rounding = -1e-12 * (b * b + magnitude(a * c));
    const Number root = square_root(larger(0.0, discriminant));
    const Number q =
        either(discriminant < rounding, std::numeric_limits<double>::quiet_NaN(), -(b + with_sign_of(b, root)));
    return {q / a, c / q};
}

/// Writes down the points at depths k on some rays, those that may be seen of them.
HWY_INLINE void store(const EyeSolid& e, Number own_plane, const Vector& ray, Number k, Mask seen, std::size_t at,
                      CurveLanes::Point& point) {
    const Mask in_front = hn::And(k > 0.0, k < std::numeric_limits<double>::infinity());
    seen = hn::And(hn::And(seen, in_front), kept_by_planes(e, k * ray, own_plane));
    ray.x.store(point.xi, at);
    either(seen, ray.z, std::numeric_limits<double>::quiet_NaN()).store(point.zeta, at);
}

/// The limb's depth is that of contacts, the others' that of their plane.
HWY_INLINE void find_extrema(const EyeSolid& e, const RowConic& limb, std::size_t at, CurveLanes& curves) {
    const Mask is_limb = Number(hn::Iota(D(), static_cast<double>(at))) == 0.0;
    const auto of = [&](const CurveLanes::Lanes& others, double of_limb) HWY_ATTR {
        return either(is_limb, of_limb, {others, at});
    };
    const Number alpha = of(curves.alpha, limb.alpha);
    const Number beta0 = of(curves.beta[0], limb.beta[0]), beta1 = of(curves.beta[1], limb.beta[1]);
    const Roots zetas = real_roots(of(curves.discriminant[2], limb.discriminant[2]),
                                   0.5 * of(curves.discriminant[1], limb.discriminant[1]),
                                   of(curves.discriminant[0], limb.discriminant[0]));
    const Vector n(curves.normal, at);
    const Number at_eye(curves.at_eye, at), own_plane = either(is_limb, kNoPlane, {curves.plane, at});
    const Mask always = hn::Or(is_limb, at_eye <= 0.0);
    const auto put = [&](Number zeta, CurveLanes::Point& point) HWY_ATTR {
        const Vector ray(-(beta0 + zeta * beta1) / alpha, 1.0, zeta);
        const Number k = -either(is_limb, dot(e.v, ray), at_eye) / either(is_limb, value(e.m, ray), dot(n, ray));
        store(e, own_plane, ray, k, hn::Or(always, faces_eye(e, k * ray)), at, point);
    };
    put(zetas.one, curves.extrema[0]), put(zetas.other, curves.extrema[1]);
}

/// Limb points are where the ray touches the quadric, k = -B/A. Along the visibility line xi = start + slope zeta, or
/// zeta = start + slope xi, whichever is less steep.
HWY_INLINE void find_contacts(const EyeSolid& e, std::size_t at, CurveLanes& curves) {
    const Sym3& l = e.limb;
    const Vector line(curves.visibility_line, at);
    const Mask by_zeta = magnitude(line.x) >= magnitude(line.z);
    const Number lead = either(by_zeta, line.x, line.z);
    const Number start = -line.y / lead, slope = -either(by_zeta, line.z, line.x) / lead;
    const Number uu = either(by_zeta, l.xx, l.zz), uy = either(by_zeta, l.xy, l.yz);
    const Number tt = either(by_zeta, l.zz, l.xx), ty = either(by_zeta, l.yz, l.xy);
    const Roots along =
        real_roots((uu * slope + 2.0 * l.xz) * slope + tt, (uu * slope + l.xz) * start + uy * slope + ty,
                   (uu * start + 2.0 * uy) * start + l.yy);
    const Number own_plane(curves.plane, at);
    const auto put = [&](Number t, CurveLanes::Point& point) HWY_ATTR {
        const Number on_line = start + slope * t;
        const Vector ray(either(by_zeta, on_line, t), 1.0, either(by_zeta, t, on_line));
        const Number k = -dot(e.v, ray) / value(e.m, ray);
        store(e, own_plane, ray, k, hn::FirstN(D(), hn::Lanes(D())), at, point);
    };
    put(along.one, curves.contacts[0]), put(along.other, curves.contacts[1]);
}

void FindCurvesAboutAxis(const EyeSolid& e, CurveLanes& curves) {
    for (std::size_t at = 0; at < curves.count; at += hn::Lanes(D())) {
        find_conics(e, at, curves);
        find_visibility_lines(e, at, curves);
    }
}

void FindPoints(const EyeSolid& e, const RowConic& limb, CurveLanes& curves) {
    for (std::size_t at = 0; at < curves.count; at += hn::Lanes(D())) {
        find_extrema(e, limb, at, curves);
        find_contacts(e, at, curves);
    }
}

bool FacesEye(const EyeSolid& e, const glm::dvec3& p) { return hn::AllTrue(D(), faces_eye(e, Vector(p))); }

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {

HWY_EXPORT(FindCurvesAboutAxis);
HWY_EXPORT(FindPoints);
HWY_EXPORT(FacesEye);

void find_curves_about_axis(const EyeSolid& solid, CurveLanes& curves) {
    HWY_DYNAMIC_DISPATCH(FindCurvesAboutAxis)(solid, curves);
}
void find_points(const EyeSolid& solid, const RowConic& limb, CurveLanes& curves) {
    HWY_DYNAMIC_DISPATCH(FindPoints)(solid, limb, curves);
}
bool faces_eye(const EyeSolid& solid, const glm::dvec3& point) { return HWY_DYNAMIC_DISPATCH(FacesEye)(solid, point); }

}  // namespace quadrig
#endif
