/// A solid of the scene seen from an eye, in extended precision: an answer that owes nothing to the image generator or
/// to the reference renderer.
///
/// Q(p) = p'Mp + 2 v.p + s and P_j(p) = n_j.p + b_j about the eye, scene axes, at the scale of the scene file's
/// numbers.
#pragma once

#include <optional>
#include <vector>

#include "ig_core/view.h"

namespace quadrig::test {

using Real = long double;
using Real3 = glm::tvec3<Real>;
using Real33 = glm::tmat3x3<Real>;

struct ExactPlane {
    Real3 normal;
    Real at_eye = 0;
    int surface = 0;  ///< 0 for the half-space that picks a hill's sheet
};

struct ExactSolid {
    Real33 m;
    Real3 v;
    Real s = 0;
    std::vector<ExactPlane> planes;

    [[nodiscard]] Real quadric_at(const Real3& p) const { return glm::dot(p, m * p) + 2 * glm::dot(v, p) + s; }
};

/// Expanded about the eye in 113-bit arithmetic, rounded once.
ExactSolid exact_solid(const Object& object, const ScenePoint& eye);

struct Hit {
    Real depth;
    int surface;
};
/// Where the ray through image point (x, z) enters the solid, at a depth above k_near; nothing where it does not, or
/// nearer.
std::optional<Hit> enter(const ExactSolid& solid, const Real3& direction);

inline Real3 ray(const glm::dmat3& eye_from_scene, Real x, Real z) {
    return glm::transpose(Real33(eye_from_scene)) * Real3(x, 1, z);
}

/// Surface seen through an image point, -1 for none.
inline int surface_through(const ExactSolid& solid, const glm::dmat3& eye_from_scene, Real x, Real z) {
    const auto hit = enter(solid, ray(eye_from_scene, x, z));
    return hit ? hit->surface : -1;
}

/// True where the answer changes when the ray moves by `shift` in x or z, or both.
bool is_tie(const ExactSolid& solid, const glm::dmat3& eye_from_scene, Real x, Real z, Real shift_x, Real shift_z);

}  // namespace quadrig::test
