#include "tests/ig_core/exact_solid.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace quadrig::test {
namespace {

using Quad = __float128;
using Quad3 = std::array<Quad, 3>;
using Quad33 = std::array<Quad3, 3>;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

/// Q about the scene's origin or about `centre`.
struct Expansion {
    Quad33 m{};
    Quad3 v{};
    Quad s = 0;
    Quad3 centre{};
};

Expansion expand(const Ellipsoid& e) {
    const auto turn = [](Degrees a) { return static_cast<Real>(a.value) / 180 * std::numbers::pi_v<Real>; };
    const Real h = turn(e.attitude.heading), p = turn(e.attitude.pitch), r = turn(e.attitude.roll);
    // Body axes: start from east, north, up; roll about north, pitch about east, heading about up, each in its own
    // sense.
    const auto to_scene = [&](Real3 q) {
        q = {q.x * std::cos(r) + q.z * std::sin(r), q.y, -q.x * std::sin(r) + q.z * std::cos(r)};
        q = {q.x, q.y * std::cos(p) - q.z * std::sin(p), q.y * std::sin(p) + q.z * std::cos(p)};
        return Real3{q.x * std::cos(h) + q.y * std::sin(h), -q.x * std::sin(h) + q.y * std::cos(h), q.z};
    };
    const std::array<Real3, 3> axes{to_scene({1, 0, 0}), to_scene({0, 1, 0}), to_scene({0, 0, 1})};
    Expansion x;
    for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                x.m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] +=
                    Quad(axes[static_cast<std::size_t>(a)][i]) * axes[static_cast<std::size_t>(a)][j] /
                    (Quad(e.semi_axes[a]) * e.semi_axes[a]);
    x.s = -1;
    x.centre = {e.centre.metres.x, e.centre.metres.y, e.centre.metres.z};
    return x;
}

Expansion expand(const Hill& hill) {
    const Quad a = Quad(hill.radius_of_curvature) * hill.slope, c = a * hill.slope;
    Expansion x;
    x.m[0][0] = x.m[1][1] = 1 / (a * a);
    x.m[2][2] = -1 / (c * c);
    x.s = 1;
    x.centre = {hill.apex.metres.x, hill.apex.metres.y, Quad(hill.apex.metres.z) + c};
    return x;
}

Expansion expand(const GeneralQuadric& g) {
    const auto& q = g.coefficients;
    const auto half = [&](std::size_t i) { return Quad(q[i]) / 2; };
    return {{{{q[0], half(3), half(5)}, {half(3), q[1], half(4)}, {half(5), half(4), q[2]}}},
            {half(6), half(7), half(8)},
            q[9],
            {0, 0, 0}};
}

}  // namespace

ExactSolid exact_solid(const Object& object, const ScenePoint& eye) {
    const Expansion x = std::visit([](const auto& shape) { return expand(shape); }, object.shape);
    const Quad3 at{Quad(eye.metres.x) - x.centre[0], Quad(eye.metres.y) - x.centre[1],
                   Quad(eye.metres.z) - x.centre[2]};
    ExactSolid solid;
    Quad s = x.s;
    for (std::size_t i = 0; i < 3; ++i) {
        Quad gradient = x.v[i];
        for (std::size_t j = 0; j < 3; ++j) {
            gradient += x.m[i][j] * at[j];
            solid.m[static_cast<int>(i)][static_cast<int>(j)] = static_cast<Real>(x.m[i][j]);
        }
        solid.v[static_cast<int>(i)] = static_cast<Real>(gradient);
        s += at[i] * (gradient + x.v[i]);
    }
    solid.s = static_cast<Real>(s);
    if (const auto* hill = std::get_if<Hill>(&object.shape)) {
        const Quad c = Quad(hill->radius_of_curvature) * hill->slope * hill->slope;
        solid.planes.push_back({{0, 0, -1}, static_cast<Real>(Quad(hill->apex.metres.z) + c - eye.metres.z), 0});
    }
    int surface = 0;
    for (const BoundingPlane& plane : object.planes) {
        const auto& b = plane.coefficients;
        const Quad at_eye = Quad(b[0]) * eye.metres.x + Quad(b[1]) * eye.metres.y + Quad(b[2]) * eye.metres.z + b[3];
        solid.planes.push_back({{b[0], b[1], b[2]}, static_cast<Real>(at_eye), ++surface});
    }
    return solid;
}

std::optional<Hit> enter(const ExactSolid& solid, const Real3& direction) {
    Real from = -kInfinity, to = kInfinity;
    int surface = 0;
    for (const ExactPlane& plane : solid.planes) {
        const Real slope = glm::dot(plane.normal, direction);
        if (slope > 0 && -plane.at_eye / slope > from) {
            from = -plane.at_eye / slope;
            surface = plane.surface;
        } else if (slope < 0) {
            to = std::min(to, -plane.at_eye / slope);
        } else if (slope == 0 && plane.at_eye <= 0) {
            return std::nullopt;
        }
    }
    const auto within = [&](Real begin, Real end) -> std::optional<Hit> {
        const Hit hit = begin > from ? Hit{begin, 0} : Hit{from, surface};
        if (hit.depth < std::min(to, end)) return hit;
        return std::nullopt;
    };
    const Real a = glm::dot(direction, solid.m * direction), b = glm::dot(solid.v, direction), c = solid.s;
    const Real discriminant = b * b - a * c;
    std::optional<Hit> hit;
    if (a == 0 && b == 0) {
        if (c <= 0) hit = within(-kInfinity, kInfinity);
    } else if (a == 0) {
        hit = b > 0 ? within(-kInfinity, -c / (2 * b)) : within(-c / (2 * b), kInfinity);
    } else if (discriminant <= 0) {
        if (a < 0) hit = within(-kInfinity, kInfinity);
    } else {
        const Real q = -(b + std::copysign(std::sqrt(discriminant), b));  // never cancels
        const Real one = q / a, other = c / q, first = std::min(one, other), second = std::max(one, other);
        if (a > 0) {
            hit = within(first, second);
        } else {
            hit = within(-kInfinity, first);
            if (!hit) hit = within(second, kInfinity);
        }
    }
    if (!hit || !(hit->depth > kNearDepth)) return std::nullopt;
    return hit;
}

bool is_tie(const ExactSolid& solid, const glm::dmat3& eye_from_scene, Real x, Real z, Real shift_x, Real shift_z) {
    const int here = surface_through(solid, eye_from_scene, x, z);
    for (const int across : {-1, 0, 1})
        for (const int down : {-1, 0, 1})
            if (surface_through(solid, eye_from_scene, x + across * shift_x, z + down * shift_z) != here) return true;
    return false;
}

}  // namespace quadrig::test
