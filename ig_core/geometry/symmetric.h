/// A symmetric 3x3 form; off-diagonal entries are stored once, not doubled. All forms of the image are of this kind.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace quadrig {

struct Sym3 {
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

    friend bool operator==(const Sym3&, const Sym3&) = default;
    friend Sym3 operator+(const Sym3& a, const Sym3& b) {
        return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
    }
    friend Sym3 operator-(const Sym3& a, const Sym3& b) { return a + (-1.0) * b; }
    friend Sym3 operator*(double f, const Sym3& a) {
        return {f * a.xx, f * a.yy, f * a.zz, f * a.xy, f * a.xz, f * a.yz};
    }
    friend glm::dvec3 operator*(const Sym3& m, const glm::dvec3& v) {
        return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
                m.xz * v.x + m.yz * v.y + m.zz * v.z};
    }
};

/// The form's value at a vector, v' M v, and between two vectors, a' M b.
inline double value(const Sym3& m, const glm::dvec3& v) {
    return m.xx * v.x * v.x + m.yy * v.y * v.y + m.zz * v.z * v.z +
           2.0 * (m.xy * v.x * v.y + m.xz * v.x * v.z + m.yz * v.y * v.z);
}
inline double value(const Sym3& m, const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, m * b); }

/// v v'.
inline Sym3 outer(const glm::dvec3& v) { return {v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z}; }
/// a b' + b a'.
inline Sym3 outer(const glm::dvec3& a, const glm::dvec3& b) {
    return {2.0 * a.x * b.x,       2.0 * a.y * b.y,       2.0 * a.z * b.z,
            a.x * b.y + a.y * b.x, a.x * b.z + a.z * b.x, a.y * b.z + a.z * b.y};
}
/// T' M T.
inline Sym3 congruent(const Sym3& m, const glm::dmat3& t) {
    const glm::dvec3 mx = m * t[0], my = m * t[1], mz = m * t[2];
    return {glm::dot(t[0], mx), glm::dot(t[1], my), glm::dot(t[2], mz),
            glm::dot(t[0], my), glm::dot(t[0], mz), glm::dot(t[1], mz)};
}
/// The form of v -> M(a x v), that is [a]x' M [a]x.
inline Sym3 through_cross(const Sym3& m, const glm::dvec3& a) {
    // Columns of [a]x are a x e.
    return congruent(m, {glm::dvec3(0, a.z, -a.y), glm::dvec3(-a.z, 0, a.x), glm::dvec3(a.y, -a.x, 0)});
}

}  // namespace quadrig
