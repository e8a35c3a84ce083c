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

/// Discriminant of Q along a line given by direction and moment (q x direction) about the anchor, as a bilinear form of
/// two lines.
template <class Quadric>
double line_discriminant(const Quadric& s, const glm::dvec3& direction_a, const glm::dvec3& moment_a,
                         const glm::dvec3& direction_b, const glm::dvec3& moment_b) {
    const glm::dvec3 ma = s.m * direction_a, mb = s.m * direction_b;
    return -value(s.adjugate, moment_a, moment_b) - s.c * glm::dot(direction_a, mb) +
           glm::dot(s.w, direction_a) * glm::dot(s.w, direction_b) + glm::dot(ma, glm::cross(s.w, moment_b)) +
           glm::dot(mb, glm::cross(s.w, moment_a));
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
