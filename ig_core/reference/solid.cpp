#include "ig_core/reference/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrig::reference {
namespace {

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();

template <class Scalar>
long double squared_length(const Vector<Scalar>& p) {
    const auto x = static_cast<long double>(p[0]), y = static_cast<long double>(p[1]),
               z = static_cast<long double>(p[2]);
    return x * x + y * y + z * z;
}

template <class Scalar>
long double length(const Vector<Scalar>& p) {
    return std::sqrt(squared_length(p));
}

/// Frobenius norm.
template <class Scalar>
long double length(const std::array<Scalar, 6>& m) {
    long double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        const auto element = static_cast<long double>(m[i]);
        sum += (i < 3 ? 1 : 2) * element * element;
    }
    return std::sqrt(sum);
}

Vector<Quad> offset(const ScenePoint& to, const ScenePoint& from) {
    return {Quad(to.metres.x) - from.metres.x, Quad(to.metres.y) - from.metres.y, Quad(to.metres.z) - from.metres.z};
}

/// (p - centre)' M (p - centre) + centre_value, the centre given relative to the eye.
Quadric<Quad> central_quadric(const std::array<Quad, 6>& m, const Vector<Quad>& centre, Quad centre_value) {
    const Vector<Quad> mc = times(m, centre);
    Quadric<Quad> q{m, {-mc[0], -mc[1], -mc[2]}, dot(centre, mc) + centre_value};
    q.m_scale = length(m);
    q.v_scale = q.m_scale * length(centre);
    q.s_scale = q.v_scale * length(centre) + 1;
    return q;
}

std::array<Quad, 6> ellipsoid_matrix(const Ellipsoid& ellipsoid) {
    const auto [sh, ch] = sine_cosine(ellipsoid.attitude.heading);
    const auto [sp, cp] = sine_cosine(ellipsoid.attitude.pitch);
    const auto [sr, cr] = sine_cosine(ellipsoid.attitude.roll);
    const Vector<Quad> forward{sh * cp, ch * cp, sp};
    const Vector<Quad> right{cr * ch + sr * sh * sp, -cr * sh + sr * ch * sp, -sr * cp};
    const Vector<Quad> up{sr * ch - cr * sh * sp, -sr * sh - cr * ch * sp, cr * cp};
    std::array<Quad, 6> m{};
    const auto add = [&](const Vector<Quad>& axis, double semi_axis) {
        const Quad weight = 1 / (Quad(semi_axis) * semi_axis);
        for (std::size_t i = 0; i < 3; ++i) {
            m[i] += weight * axis[i] * axis[i];
            m[i + 3] += weight * axis[i == 2 ? 0 : i] * axis[i == 2 ? 2 : i + 1];
        }
    };
    add(right, ellipsoid.semi_axes.x);
    add(forward, ellipsoid.semi_axes.y);
    add(up, ellipsoid.semi_axes.z);
    return m;
}

void set_shape(const Ellipsoid& ellipsoid, const ScenePoint& eye, Solid<Quad>& solid) {
    solid.quadric = central_quadric(ellipsoid_matrix(ellipsoid), offset(ellipsoid.centre, eye), -1);
    solid.centre_value = 1;
}

void set_shape(const Hill& hill, const ScenePoint& eye, Solid<Quad>& solid) {
    const Quad a = Quad(hill.radius_of_curvature) * hill.slope;
    const Quad c = a * hill.slope;
    Vector<Quad> centre = offset(hill.apex, eye);
    centre[2] += c;
    solid.quadric = central_quadric({1 / (a * a), 1 / (a * a), -1 / (c * c), 0, 0, 0}, centre, 1);
    solid.centre_value = 1;
    solid.half_spaces.push_back({{0, 0, -1}, centre[2], 0});
}

/// M is singular where it is so but for this share of it: ten coefficients say a tilted cylinder or paraboloid to their
/// own rounding only, and it has no more of a centre than an upright one.
constexpr Quad kSingular = 1e-12;

std::optional<Quad> centre_value(const Quadric<Quad>& q) {
    const auto& [xx, yy, zz, xy, yz, xz] = q.m;
    const Quad adjugate_xx = yy * zz - yz * yz, adjugate_xy = yz * xz - xy * zz, adjugate_xz = xy * yz - yy * xz;
    const Quad determinant = xx * adjugate_xx + xy * adjugate_xy + xz * adjugate_xz;
    const std::array<Quad, 6> adjugate{adjugate_xx, xx * zz - xz * xz, xx * yy - xy * xy,
                                       adjugate_xy, xy * xz - xx * yz, adjugate_xz};
    // The smallest eigenvalue of M is about det(M) / |adj(M)|.
    if (magnitude(determinant) <= kSingular * q.m_scale * length(adjugate)) return std::nullopt;
    const Quad drop = dot(q.v, times(adjugate, q.v)) / determinant;
    const Quad value = magnitude(q.s - drop);
    if (value <= Limits<Quad>::thin * (magnitude(drop) + magnitude(q.s))) return std::nullopt;
    return value;
}

void set_shape(const GeneralQuadric& general, const ScenePoint& eye, Solid<Quad>& solid) {
    const auto& c = general.coefficients;
    const Vector<Quad> e{eye.metres.x, eye.metres.y, eye.metres.z};
    Quadric<Quad>& q = solid.quadric;
    for (std::size_t i = 0; i < 3; ++i) q.m[i] = c[i], q.m[i + 3] = Quad(c[i + 3]) / 2;
    const Vector<Quad> v{Quad(c[6]) / 2, Quad(c[7]) / 2, Quad(c[8]) / 2};
    const Vector<Quad> me = times(q.m, e);
    for (std::size_t i = 0; i < 3; ++i) q.v[i] = me[i] + v[i];
    q.s = dot(e, me) + 2 * dot(e, v) + c[9];
    q.m_scale = length(q.m);
    q.v_scale = q.m_scale * length(e) + length(v);
    q.s_scale = (q.v_scale + length(v)) * length(e) + std::abs(static_cast<long double>(c[9]));
    solid.centre_value = centre_value(q);
}

/// Q along the ray: A k^2 + 2 B k + C (Eq 4).
template <class Scalar>
struct AlongRay {
    Scalar a, b, c;
};

template <class Scalar>
AlongRay<Scalar> along_ray(const Quadric<Scalar>& q, const Vector<Scalar>& d) {
    return {dot(d, times(q.m, d)), dot(d, q.v), q.s};
}

/// A stretch of the ray, and the surface through which it is entered.
template <class Scalar>
struct Stretch {
    Scalar begin{};
    Scalar end{};
    int surface = 0;
};

/// The stretches where Q < 0, in order along the ray; unused ones are empty.
template <class Scalar>
std::array<Stretch<Scalar>, 2> inside_quadric(const Quadric<Scalar>& q, const Vector<Scalar>& direction) {
    const auto [a, b, c] = along_ray(q, direction);
    const Scalar from = -kInfinity, to = kInfinity;
    const Scalar discriminant = b * b - a * c;
    const long double rounding = Limits<Scalar>::touch * squared_length(direction);
    if (discriminant <= rounding * (q.v_scale * q.v_scale + q.m_scale * q.s_scale)) {
        const long double flat = rounding * q.m_scale;
        const bool inside_everywhere = a < -flat || (a <= flat && c < 0) || q.m_scale + q.v_scale + q.s_scale == 0;
        return {inside_everywhere ? Stretch<Scalar>{from, to} : Stretch<Scalar>{}, {}};
    }
    // Here b or a is not zero, and no root is the difference of nearly equal numbers.
    const Scalar root = square_root(discriminant);
    const Scalar sum = b < 0 ? root - b : -root - b;
    const Scalar near_zero = c / sum;
    if (a == 0) return {sum < 0 ? Stretch<Scalar>{from, near_zero} : Stretch<Scalar>{near_zero, to}, {}};
    const Scalar other = sum / a;
    const Scalar first = std::min(near_zero, other), second = std::max(near_zero, other);
    if (a > 0) return {Stretch<Scalar>{first, second}, {}};
    return {Stretch<Scalar>{from, first}, {second, to}};
}

template <class Scalar>
void clip(Stretch<Scalar>& stretch, const HalfSpace<Scalar>& half_space, const Vector<Scalar>& direction) {
    const Scalar rate = dot(half_space.normal, direction);
    if (rate == 0) {
        if (half_space.offset <= 0) stretch.end = stretch.begin;
        return;
    }
    const Scalar crossing = -half_space.offset / rate;
    if (rate < 0) {
        stretch.end = std::min(stretch.end, crossing);
    } else if (crossing > stretch.begin) {
        stretch.begin = crossing;
        stretch.surface = half_space.surface;
    }
}

template <class Scalar>
bool has_length(const Stretch<Scalar>& stretch) {
    if (!(stretch.begin < stretch.end)) return false;
    if (stretch.begin == -kInfinity || stretch.end == kInfinity) return true;
    const Scalar largest = std::max(magnitude(stretch.begin), magnitude(stretch.end));
    return stretch.end - stretch.begin > Limits<Scalar>::thin * largest;
}

}  // namespace

Solid<Quad> solid_about_eye(const Object& object, const ScenePoint& eye) {
    Solid<Quad> solid;
    std::visit([&](const auto& shape) { set_shape(shape, eye, solid); }, object.shape);
    int surface = 0;
    for (const BoundingPlane& plane : object.planes) {
        const auto& [x, y, z, constant] = plane.coefficients;
        const Quad at_eye = Quad(x) * eye.metres.x + Quad(y) * eye.metres.y + Quad(z) * eye.metres.z + constant;
        solid.half_spaces.push_back({{x, y, z}, at_eye, ++surface});
    }
    return solid;
}

template <class Scalar>
Solid<Scalar> rounded(const Solid<Quad>& solid) {
    const auto round = [](const Vector<Quad>& p) {
        return Vector<Scalar>{static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2])};
    };
    Solid<Scalar> result;
    Quadric<Scalar>& q = result.quadric;
    for (std::size_t i = 0; i < 6; ++i) q.m[i] = static_cast<Scalar>(solid.quadric.m[i]);
    q.v = round(solid.quadric.v);
    q.s = static_cast<Scalar>(solid.quadric.s);
    q.m_scale = length(q.m), q.v_scale = length(q.v), q.s_scale = magnitude(q.s);
    for (const auto& h : solid.half_spaces)
        result.half_spaces.push_back({round(h.normal), static_cast<Scalar>(h.offset), h.surface});
    if (solid.centre_value) result.centre_value = static_cast<Scalar>(*solid.centre_value);
    return result;
}
template Solid<long double> rounded(const Solid<Quad>&);
template Solid<double> rounded(const Solid<Quad>&);

template <class Scalar>
std::optional<Entry<Scalar>> entry(const Solid<Scalar>& solid, const Vector<Scalar>& direction) {
    for (Stretch<Scalar> stretch : inside_quadric(solid.quadric, direction)) {
        if (!(stretch.begin < stretch.end)) continue;
        for (const auto& half_space : solid.half_spaces) clip(stretch, half_space, direction);
        if (!has_length(stretch) || stretch.end <= 0) continue;
        if (stretch.begin <= kNearDepth) return std::nullopt;
        return Entry<Scalar>{stretch.begin, stretch.surface};
    }
    return std::nullopt;
}
template std::optional<Entry<long double>> entry(const Solid<long double>&, const Vector<long double>&);
template std::optional<Entry<Quad>> entry(const Solid<Quad>&, const Vector<Quad>&);

double limb_function(const Solid<long double>& solid, const Vector<long double>& direction) {
    if (!solid.centre_value) return 1.0;
    const auto [a, b, c] = along_ray(solid.quadric, direction);
    if (a < 0 || (a == 0 && b != 0)) return 1.0;
    const long double depth_below = a == 0 ? -c : (b * b - a * c) / a;
    return static_cast<double>(std::clamp(depth_below / *solid.centre_value, 0.0L, 1.0L));
}

Vector<long double> outward_normal(const Solid<long double>& solid, const Vector<long double>& direction,
                                   const Entry<long double>& at) {
    Vector<long double> normal{};
    if (at.surface == 0) {
        const Vector<long double> p{at.depth * direction[0], at.depth * direction[1], at.depth * direction[2]};
        const Vector<long double> half_gradient = times(solid.quadric.m, p);
        for (std::size_t i = 0; i < 3; ++i) normal[i] = half_gradient[i] + solid.quadric.v[i];
    } else {
        const auto face = std::find_if(solid.half_spaces.begin(), solid.half_spaces.end(),
                                       [&](const auto& h) { return h.surface == at.surface; });
        for (std::size_t i = 0; i < 3; ++i) normal[i] = -face->normal[i];
    }
    const long double size = length(normal);
    if (size > 0)
        for (long double& component : normal) component /= size;
    return normal;
}

}  // namespace quadrig::reference
