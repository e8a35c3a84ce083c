/// A quadric Q(q) = q' M q + 2 w.q + c along straight lines, in moments about the point that q is measured from:
/// nothing cancels where Q's centre is there.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "ig_core/geometry/symmetric.h"

namespace quadrig {

/// Rounding of d'Md for unit d where the largest entry of M is about 1.
inline constexpr double kFlat = 1e-14;

/// A straight line by its direction and moment (q x direction).
struct MomentLine {
    glm::dvec3 direction, moment;
};

/// Discriminant of Q along a line, and as a bilinear form of two lines a and b: {a a, a b, b b}.
template <class Quadric>
std::array<double, 3> line_discriminants(const Quadric& q, const MomentLine& a, const MomentLine& b) {
    const glm::dvec3 ma = q.m * a.direction, mb = q.m * b.direction;
    const glm::dvec3 ta = q.adjugate * a.moment, tb = q.adjugate * b.moment;
    const glm::dvec3 wa = glm::cross(q.w, a.moment), wb = glm::cross(q.w, b.moment);
    const double da = glm::dot(q.w, a.direction), db = glm::dot(q.w, b.direction);
    return {-glm::dot(a.moment, ta) - q.c * glm::dot(a.direction, ma) + da * da + glm::dot(ma, wa) + glm::dot(ma, wa),
            -glm::dot(a.moment, tb) - q.c * glm::dot(a.direction, mb) + da * db + glm::dot(ma, wb) + glm::dot(mb, wa),
            -glm::dot(b.moment, tb) - q.c * glm::dot(b.direction, mb) + db * db + glm::dot(mb, wb) + glm::dot(mb, wb)};
}
template <class Quadric>
double line_discriminant(const Quadric& q, const MomentLine& line) {
    return line_discriminants(q, line, line)[0];
}

struct Interval {
    double from, to;
};

/// Where Q <= 0 along a line with A t^2 + 2 B t + C and discriminant D: one interval, or two when A < 0. An A of `flat`
/// or less may be rounding.
inline int inside_quadric(double a, double b, double c, double d, double flat, std::array<Interval, 2>& out) {
    constexpr double kNoEnd = std::numeric_limits<double>::infinity();
    a += 0.0;  // -0 would flip the sign of an infinite root
    if (!(d > 0.0)) {
        // Then A and C have one sign, but along a cylinder's axis A is rounding.
        if (a > flat || c > 0.0) return 0;
        out[0] = {-kNoEnd, kNoEnd};
        return 1;
    }
    const double root = std::sqrt(d);
    const double entry = b <= 0.0 ? c / (root - b) : -(b + root) / a;
    const double exit = b >= 0.0 ? -c / (b + root) : (root - b) / a;
    if (a >= 0.0) {
        out[0] = {entry, exit};
        return 1;
    }
    out[0] = {-kNoEnd, exit};
    out[1] = {entry, kNoEnd};
    return 2;
}

}  // namespace quadrig
