#include "config/convexity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace quadrig::config {
namespace {

// Extended precision: a scene's coordinates leave little of a double between Q at the centre and nothing.
using Real = long double;
using Vector = std::array<Real, 3>;
using Matrix = std::array<Vector, 3>;

constexpr Real kRelativeTolerance = 1e-10L;
constexpr Real kLengthTolerance = 1e-9L;

Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real length(const Vector& a) { return std::sqrt(dot(a, a)); }

/// A quadric about its centre along its principal axes: Q = constant + sum of (eigenvalue q^2 + 2 linear q), where an
/// axis has a linear term only if its eigenvalue is 0. Axes in ascending order of eigenvalues.
struct PrincipalForm {
    std::array<Real, 3> eigenvalues{};
    std::array<Vector, 3> directions{};
    Vector centre{};
    bool has_linear_term = false;
    Real constant = 0.0L;
    Real constant_error = 0.0L;  ///< a constant of less than this is too close to 0 to call
};

/// Eigenvalues on the diagonal and eigenvectors in the rows of `directions`, by Jacobi rotations.
void diagonalise(Matrix& m, Matrix& directions) {
    directions = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    constexpr std::array<std::pair<std::size_t, std::size_t>, 3> kPairs{{{0, 1}, {0, 2}, {1, 2}}};
    constexpr int kSweeps = 30;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (const auto& [p, q] : kPairs) {
            if (m[p][q] == 0.0L) continue;
            const Real theta = (m[q][q] - m[p][p]) / (2.0L * m[p][q]);
            const Real tangent = std::copysign(1.0L, theta) / (std::abs(theta) + std::hypot(theta, 1.0L));
            const Real c = 1.0L / std::hypot(tangent, 1.0L), s = tangent * c;
            const auto rotate = [c, s](Real& a, Real& b) {
                const Real before = a;
                a = c * before - s * b;
                b = s * before + c * b;
            };
            for (Vector& row : m) rotate(row[p], row[q]);
            for (std::size_t k = 0; k < 3; ++k) rotate(m[p][k], m[q][k]);
            for (std::size_t k = 0; k < 3; ++k) rotate(directions[p][k], directions[q][k]);
        }
    }
}

PrincipalForm principal_form(const std::array<double, 10>& q) {
    Matrix m{{{q[0], q[3] / 2.0L, q[5] / 2.0L}, {q[3] / 2.0L, q[1], q[4] / 2.0L}, {q[5] / 2.0L, q[4] / 2.0L, q[2]}}};
    const Vector gradient{q[6] / 2.0L, q[7] / 2.0L, q[8] / 2.0L};
    Matrix directions;
    diagonalise(m, directions);
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return m[a][a] < m[b][b]; });
    const Real largest = std::max(std::abs(m[order[0]][order[0]]), std::abs(m[order[2]][order[2]]));

    PrincipalForm form;
    form.constant = q[9];
    Real magnitude = std::abs(form.constant);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector& direction = directions[order[i]];
        const Real eigenvalue = m[order[i]][order[i]];
        const Real slope = dot(direction, gradient);
        form.directions[i] = direction;
        if (std::abs(eigenvalue) <= kRelativeTolerance * largest) {
            form.has_linear_term = form.has_linear_term || std::abs(slope) > kRelativeTolerance * length(gradient);
            continue;
        }
        form.eigenvalues[i] = eigenvalue;
        form.constant -= slope * slope / eigenvalue;
        magnitude += slope * slope / std::abs(eigenvalue);
        for (std::size_t k = 0; k < 3; ++k) form.centre[k] -= slope / eigenvalue * direction[k];
    }
    form.constant_error = kRelativeTolerance * magnitude;
    return form;
}

/// normal.q + offset > 0 about the centre, along the principal axes, of unit normal.
struct HalfSpace {
    Vector normal{};
    Real offset = 0.0L;
};

/// The half-space is drawn in by what rounding leaves uncertain of the centre: a cone cut at its apex passes.
HalfSpace along_axes(const BoundingPlane& plane, const PrincipalForm& form) {
    const auto& b = plane.coefficients;
    const Vector scene_normal{b[0], b[1], b[2]};
    const Real size = length(scene_normal);
    HalfSpace half{{}, (dot(scene_normal, form.centre) + b[3]) / size - kLengthTolerance * length(form.centre)};
    for (std::size_t i = 0; i < 3; ++i) half.normal[i] = dot(scene_normal, form.directions[i]) / size;
    return half;
}

/// One sheet of a x^2 >= b1 y1^2 + b2 y2^2 + c: the one with side * x >= 0, a, b, c >= 0.
struct Sheet {
    Real side = 1.0L, a = 1.0L, b1 = 0.0L, b2 = 0.0L, c = 0.0L;

    /// Convex in q, negative inside the sheet. Its gradient comes with it.
    [[nodiscard]] std::pair<Real, Vector> value(const Vector& q) const {
        const Real root = std::sqrt((b1 * q[1] * q[1] + b2 * q[2] * q[2] + c) / a);
        const Real scale = root > 0.0L ? 1.0L / (a * root) : 0.0L;
        return {root - side * q[0], {-side, b1 * q[1] * scale, b2 * q[2] * scale}};
    }

    /// Whether a half-space keeps no more than the boundary of the sheet: the largest normal.q over it, where it is
    /// finite, is -sqrt(c (alpha^2/a - beta1^2/b1 - beta2^2/b2)), alpha and beta the normal's components.
    [[nodiscard]] bool is_cut_off_by(const HalfSpace& half) const {
        const auto square_over = [](Real beta, Real b) {
            if (std::abs(beta) <= kRelativeTolerance) return 0.0L;
            return b > 0.0L ? beta * beta / b : std::numeric_limits<Real>::infinity();
        };
        const Real slack =
            half.normal[0] * half.normal[0] / a - square_over(half.normal[1], b1) - square_over(half.normal[2], b2);
        if (side * half.normal[0] >= 0.0L || slack < 0.0L) return false;
        return half.offset - std::sqrt(c * slack) <= 0.0L;
    }
};

/// Looks for a point inside the sheet and all half-spaces by cyclic subgradient projections. True is certain.
bool certainly_reaches_into(const Sheet& sheet, const std::vector<HalfSpace>& half_spaces) {
    Real scale = std::sqrt(sheet.c / sheet.a);
    for (const HalfSpace& half : half_spaces) scale = std::max(scale, std::abs(half.offset));
    const Real margin = 1e-6L * (scale > 0.0L ? scale : 1.0L);
    Vector q{sheet.side * (std::sqrt(sheet.c / sheet.a) + margin), 0.0L, 0.0L};
    constexpr int kRounds = 3000;
    for (int round = 0; round < kRounds; ++round) {
        bool inside = true;
        const auto project = [&](Real value, const Vector& gradient) {
            if (value < -0.5L * margin) return;
            inside = false;
            const Real step = (value + margin) / dot(gradient, gradient);
            for (std::size_t k = 0; k < 3; ++k) q[k] -= step * gradient[k];
        };
        const auto [value, gradient] = sheet.value(q);
        project(value, gradient);
        for (const HalfSpace& half : half_spaces) {
            project(-(dot(half.normal, q) + half.offset), {-half.normal[0], -half.normal[1], -half.normal[2]});
        }
        if (inside) return true;
    }
    return false;
}

}  // namespace

std::optional<std::string> why_not_convex(const GeneralQuadric& quadric, std::span<const BoundingPlane> planes) {
    const PrincipalForm form = principal_form(quadric.coefficients);
    const auto negative =
        std::count_if(form.eigenvalues.begin(), form.eigenvalues.end(), [](Real e) { return e < 0.0L; });
    const bool any_positive = form.eigenvalues[2] > 0.0L;
    if (negative == 0) return std::nullopt;
    const bool nowhere_positive = !any_positive && !form.has_linear_term && form.constant <= form.constant_error;
    if (nowhere_positive) return std::nullopt;
    const bool two_sheets = negative == 1 && !form.has_linear_term && form.constant >= -form.constant_error;
    if (!two_sheets) return "it curves the wrong way (like a saddle, a waist or the outside of an egg)";
    if (planes.empty()) return "it has two sheets (like a double cone) and no plane to choose one";

    std::vector<HalfSpace> half_spaces;
    half_spaces.reserve(planes.size());
    for (const BoundingPlane& plane : planes) half_spaces.push_back(along_axes(plane, form));
    const Sheet ahead{1.0L, -form.eigenvalues[0], form.eigenvalues[1], form.eigenvalues[2],
                      std::max(form.constant, 0.0L)};
    const Sheet behind{-1.0L, ahead.a, ahead.b1, ahead.b2, ahead.c};
    const auto is_gone = [&](const Sheet& sheet) {
        return std::any_of(half_spaces.begin(), half_spaces.end(),
                           [&](const HalfSpace& half) { return sheet.is_cut_off_by(half); }) ||
               !certainly_reaches_into(sheet, half_spaces);
    };
    if (is_gone(ahead) || is_gone(behind)) return std::nullopt;
    return "it has two sheets (like a double cone) and its planes keep some of both";
}

}  // namespace quadrig::config
