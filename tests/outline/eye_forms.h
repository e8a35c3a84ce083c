/// The table of forms in extended precision, straight from its formulas, in the image coordinates that an outline uses.
#pragma once

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "ig_core/outline/image_forms.h"
#include "tests/ig_core/exact_solid.h"

namespace quadrig::test {

/// S = [M v; v' s] and planes (n, b) of a solid in the sheared eye space of an EyeSolid: a ray direction is (xi, 1,
/// zeta).
struct EyeForms {
    Real33 m;
    Real3 v;
    Real s = 0;
    std::vector<ExactPlane> planes;

    EyeForms(const ExactSolid& solid, const glm::dmat3& eye_from_scene, const EyeSolid& eye) : s(solid.s) {
        const Real33 scene_from_eye = glm::transpose(Real33(eye_from_scene));
        const Real x0 = eye.x0, z0 = eye.z0;
        const Real33 t{scene_from_eye[0], scene_from_eye[1] + x0 * scene_from_eye[0] + z0 * scene_from_eye[2],
                       scene_from_eye[2]};
        m = glm::transpose(t) * solid.m * t;
        v = glm::transpose(t) * solid.v;
        for (const ExactPlane& plane : solid.planes)
            planes.push_back({glm::transpose(t) * plane.normal, plane.at_eye, plane.surface});
    }

    [[nodiscard]] Real33 limb() const { return glm::outerProduct(v, v) - s * m; }
    [[nodiscard]] Real33 intersection_curve(const ExactPlane& j) const {
        return j.at_eye * j.at_eye * m - j.at_eye * (glm::outerProduct(v, j.normal) + glm::outerProduct(j.normal, v)) +
               s * glm::outerProduct(j.normal, j.normal);
    }
    [[nodiscard]] Real3 visibility_line(const ExactPlane& j) const { return s * j.normal - j.at_eye * v; }
    [[nodiscard]] static Real3 intersection_line(const ExactPlane& i, const ExactPlane& j) {
        return j.at_eye * i.normal - i.at_eye * j.normal;
    }
};

inline Real form(const Real33& m, const Real3& d) { return glm::dot(d, m * d); }
inline Real33 full(const Sym3& m) {
    return {Real3(m.xx, m.xy, m.xz), Real3(m.xy, m.yy, m.yz), Real3(m.xz, m.yz, m.zz)};
}
/// A row conic's form over (xi, 1, zeta).
inline Real33 full(const RowConic& c) {
    const Real alpha = c.alpha, b0 = c.beta[0], b1 = c.beta[1];
    return {Real3(alpha, b0, b1), Real3(b0, c.gamma[0], c.gamma[1] / 2.0L), Real3(b1, c.gamma[1] / 2.0L, c.gamma[2])};
}

inline Real norm(const Real33& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}
inline Real norm(const Real3& v) { return glm::length(v); }
inline Real inner(const Real33& a, const Real33& b) {
    return glm::dot(a[0], b[0]) + glm::dot(a[1], b[1]) + glm::dot(a[2], b[2]);
}
inline Real inner(const Real3& a, const Real3& b) { return glm::dot(a, b); }

/// How far two forms are from being the same up to a positive factor: 0 for the same, about 1 for unrelated, 2 for
/// opposite.
template <class Form>
Real difference_up_to_scale(const Form& a, const Form& b) {
    return norm(a / norm(a) - b / norm(b));
}

}  // namespace quadrig::test
