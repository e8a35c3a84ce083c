/// A solid of the scene as a ray from the eye meets it: {Q <= 0 and every P_j > 0} along p = eye + k D (MODEL:
/// "Objects").
///
/// Space: scene axes, metres, origin at the eye. D is the scene direction of the eye-space ray (x, 1, z), so k is
/// depth. Sign: Q is negative inside, P_j positive. The scale of both is the scene file's. Scalar is Quad where a sign
/// is the answer, long double where a value is.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ig_core/reference/quad.h"
#include "ig_core/scene/scene.h"
#include "ig_core/view.h"

namespace quadrig::reference {

template <class Scalar>
using Vector = std::array<Scalar, 3>;

/// Scalar product.
template <class Scalar>
Scalar dot(const Vector<Scalar>& a, const Vector<Scalar>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Q(p) = p'Mp + 2 v.p + s, with M = (xx, yy, zz, xy, yz, xz), off-diagonals stored once and not doubled.
template <class Scalar>
struct Quadric {
    std::array<Scalar, 6> m{};
    Vector<Scalar> v{};
    Scalar s{};
    /// Magnitudes of the sums that gave m, v and s: how large their rounding errors can be.
    long double m_scale = 0, v_scale = 0, s_scale = 0;
};

/// M p.
template <class Scalar>
Vector<Scalar> times(const std::array<Scalar, 6>& m, const Vector<Scalar>& p) {
    return {m[0] * p[0] + m[3] * p[1] + m[5] * p[2],  //
            m[3] * p[0] + m[1] * p[1] + m[4] * p[2],  //
            m[5] * p[0] + m[4] * p[1] + m[2] * p[2]};
}

/// n.p + b > 0. `surface` is the surface number of its face.
template <class Scalar>
struct HalfSpace {
    Vector<Scalar> normal{};
    Scalar offset{};
    int surface = 0;
};

template <class Scalar>
struct Solid {
    Quadric<Scalar> quadric;
    std::vector<HalfSpace<Scalar>> half_spaces;
    /// |Q(centre)|; absent without a centre or where Q vanishes there.
    std::optional<Scalar> centre_value;
};

/// Where a ray enters a solid: depth k and the surface it enters through, 0 the quadric, j the j-th plane.
template <class Scalar>
struct Entry {
    Scalar depth{};
    int surface = 0;
};

/// The scene direction of the ray through an image point; column 0.5, row 0.5 is the first pixel's centre.
template <class Scalar>
Vector<Scalar> ray_direction(const View& view, Scalar column, Scalar row) {
    const Scalar x = Scalar(view.image.left) + column * Scalar(view.image.column_step);
    const Scalar z = Scalar(view.image.top) - row * Scalar(view.image.row_step);
    const auto component = [&](int axis) {
        const glm::dvec3& c = view.eye_from_scene[axis];
        return x * Scalar(c[0]) + Scalar(c[1]) + z * Scalar(c[2]);
    };
    return {component(0), component(1), component(2)};
}

/// The object's solid seen from `eye`. A hill gets its sheet as one more half-space, which has no face.
Solid<Quad> solid_about_eye(const Object& object, const ScenePoint& eye);

/// The same solid rounded once. Defined for long double and double.
template <class Scalar>
Solid<Scalar> rounded(const Solid<Quad>& solid);

/// The point where the ray enters the solid, if it is deeper than kNearDepth. Nothing for a ray that misses, only
/// touches, starts inside or enters nearer than that. Defined for long double and Quad.
template <class Scalar>
std::optional<Entry<Scalar>> entry(const Solid<Scalar>& solid, const Vector<Scalar>& direction);

/// The limb function g (MODEL: "Shade"): 1 for a ray through the quadric's centre, 0 on the limb; 1 without a centre.
double limb_function(const Solid<long double>& solid, const Vector<long double>& direction);

/// Unit normal, outward, at depth k on the ray, of the surface given.
Vector<long double> outward_normal(const Solid<long double>& solid, const Vector<long double>& direction,
                                   const Entry<long double>& at);

}  // namespace quadrig::reference
