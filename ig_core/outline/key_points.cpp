#include "ig_core/outline/key_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

#include "ig_core/scene/solid_edges.h"

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-6;

/// The two values of t with a t^2 + 2 b t + c = 0 and their count; coincident roots within rounding count as real.
int real_roots(double a, double b, double c, std::array<double, 2>& t) {
    const double discriminant = b * b - a * c;
    if (discriminant < -1e-12 * (b * b + std::abs(a * c))) return 0;
    const double q = -(b + std::copysign(std::sqrt(std::max(0.0, discriminant)), b));
    int count = 0;
    if (a != 0.0) t[static_cast<std::size_t>(count++)] = q / a;
    if (q != 0.0) t[static_cast<std::size_t>(count++)] = c / q;
    if (q == 0.0 && a != 0.0) t[static_cast<std::size_t>(count++)] = 0.0;
    return count;
}

/// Whether the quadric through an eye-space point is entered there by the ray from the eye: p'Mp + v.p <= 0.
bool quadric_faces_eye(const EyeSolid& e, const glm::dvec3& p) {
    const double curved = value(e.m, p), straight = glm::dot(e.v, p);
    return curved + straight <= kTolerance * (std::abs(curved) + std::abs(straight));
}

/// A key point on one or two curves. One whose place is not a number is none.
void add_key_point(Outline& out, const KeyPoint& point, std::size_t curve, std::size_t other) {
    if (std::isnan(point.zeta)) return;
    out.key_points.push_back(point);
    for (const std::size_t i : {curve, other}) out.curves[i].rows.add(point.zeta);
}

/// Limb points are where the ray touches the quadric, k = -B/A.
void add_limb_point(Outline& out, double xi, double zeta, const EyePlane* own, std::size_t curve, KeyPoint::Kind kind) {
    const glm::dvec3 d(xi, 1.0, zeta);
    const double k = -glm::dot(out.solid.v, d) / value(out.solid.m, d);
    if (std::isfinite(k) && k > 0.0 && kept_by_planes(out.solid, k * d, own))
        add_key_point(out, {xi, zeta, kind}, 0, curve);
}

void add_curve_extrema(Outline& out, std::size_t index, const EyePlane& plane) {
    const RowConic& curve = out.curves[index];
    std::array<double, 2> zetas;
    const int count = real_roots(curve.discriminant[2], 0.5 * curve.discriminant[1], curve.discriminant[0], zetas);
    for (int i = 0; i < count; ++i) {
        const double zeta = zetas[static_cast<std::size_t>(i)], xi = -curve.beta_at(zeta) / curve.alpha;
        const glm::dvec3 d(xi, 1.0, zeta);
        const double k = -plane.at_eye / glm::dot(plane.normal, d);
        if (!(std::isfinite(k) && k > 0.0)) continue;
        if ((plane.at_eye <= 0.0 || quadric_faces_eye(out.solid, k * d)) && kept_by_planes(out.solid, k * d, &plane))
            add_key_point(out, {xi, zeta, KeyPoint::Kind::curve_extremum}, index, index);
    }
}

/// Contact points: limb and visibility line meet (Eq 6, 12).
void add_contacts(Outline& out, std::size_t curve, const EyePlane& plane) {
    const glm::dvec3& v = out.curves[curve].visibility_line;
    const bool by_zeta = std::abs(v.x) >= std::abs(v.z);
    const double lead = by_zeta ? v.x : v.z;
    if (lead == 0.0) return;
    const glm::dvec3 start = by_zeta ? glm::dvec3(-v.y / lead, 1, 0) : glm::dvec3(0, 1, -v.y / lead);
    const glm::dvec3 step = by_zeta ? glm::dvec3(-v.z / lead, 0, 1) : glm::dvec3(1, 0, -v.x / lead);
    std::array<double, 2> t;
    const Sym3& limb = out.solid.limb;
    const int count = real_roots(value(limb, step), value(limb, start, step), value(limb, start), t);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 d = start + t[static_cast<std::size_t>(i)] * step;
        add_limb_point(out, d.x, d.z, &plane, curve, KeyPoint::Kind::contact);
    }
}

/// An edge and its ends.
void add_edge(const SolidEdge& edge, const glm::dmat3& eye_from_scene, std::size_t curve, std::size_t other_curve,
              Outline& out) {
    const EyeSolid& e = out.solid;
    const EyePlane &a = e.planes[edge.plane], &b = e.planes[edge.other_plane];
    // Between two planes that face away the edge itself is hidden, but its ends can be where their curves meet.
    const bool hidden = a.at_eye > 0.0 && b.at_eye > 0.0;
    EdgeLine line{hidden ? glm::dvec3(0.0) : intersection_line(e, a, b), kInfinity, -kInfinity, edge.plane,
                  edge.other_plane};
    for (const glm::dvec3& end : {edge.from, edge.to}) {
        const glm::dvec3 q = eye_from_scene * end;
        const glm::dvec3 p = e.anchor + glm::dvec3(q.x - e.x0 * q.y, q.y, q.z - e.z0 * q.y);
        const double xi = p.x / p.y, zeta = p.z / p.y;
        line.zeta_from = std::min(line.zeta_from, zeta);
        line.zeta_to = std::max(line.zeta_to, zeta);
        if (!hidden || quadric_faces_eye(e, p))
            add_key_point(out, {xi, zeta, KeyPoint::Kind::edge_end}, curve, other_curve);
    }
    if (!hidden) out.lines.push_back(line);
}

/// Of a solid without end every line in which two planes meet is taken for an edge, and of no length known.
void add_endless_lines(Outline& out) {
    const EyeSolid& e = out.solid;
    for (int i = 0; i < e.plane_count; ++i) {
        for (int j = 0; j < i; ++j) {
            const EyePlane &a = e.planes[static_cast<std::size_t>(i)], &b = e.planes[static_cast<std::size_t>(j)];
            if (a.cuts && b.cuts && !(a.at_eye > 0.0 && b.at_eye > 0.0))
                out.lines.push_back({intersection_line(e, a, b), -kInfinity, kInfinity, static_cast<std::uint8_t>(i),
                                     static_cast<std::uint8_t>(j)});
        }
    }
}

}  // namespace

void find_boundaries(const Solid& solid, const glm::dmat3& eye_from_scene, Outline& out) {
    const EyeSolid& e = out.solid;
    const auto plane_count = static_cast<std::size_t>(e.plane_count);
    std::array<std::size_t, kMaxEyePlanes> curve_of{};
    for (std::size_t i = 0; i < plane_count; ++i) {
        if (!e.planes[i].cuts) continue;
        curve_of[i] = out.curves.size();
        out.curves.push_back({intersection_curve_on_rows(e, e.planes[i]), {}, visibility_line(e, e.planes[i])});
    }
    if (out.direct) return add_endless_lines(out);
    const auto add = [&](const SolidEdge& edge) {
        add_edge(edge, eye_from_scene, curve_of[edge.plane], curve_of[edge.other_plane], out);
    };
    if (plane_count == solid.planes.size()) {
        std::for_each(solid.edges.begin(), solid.edges.end(), add);
        return;
    }
    // The near plane, the last, takes a part of the solid's edges and adds its own.
    std::array<SolidPlane, kMaxEyePlanes> planes;
    std::copy(solid.planes.begin(), solid.planes.end(), planes.begin());
    const EyePlane& near_plane = e.planes[plane_count - 1];
    planes[plane_count - 1] = {glm::row(eye_from_scene, 1), near_plane.local_offset, near_plane.surface};
    for (std::size_t i = 0; i < plane_count; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (e.planes[i].cuts && e.planes[j].cuts)
                if (const auto edge = edge_between(solid, {planes.data(), plane_count}, i, j)) add(*edge);
}

void find_key_points(Outline& out) {
    const EyeSolid& e = out.solid;
    const RowConic& limb = out.curves[0];
    std::array<double, 2> zetas;
    const int count = real_roots(limb.discriminant[2], 0.5 * limb.discriminant[1], limb.discriminant[0], zetas);
    for (int i = 0; i < count; ++i) {
        const double zeta = zetas[static_cast<std::size_t>(i)];
        add_limb_point(out, -limb.beta_at(zeta) / limb.alpha, zeta, nullptr, 0, KeyPoint::Kind::limb_extremum);
    }
    std::size_t curve = 1;
    for (int i = 0; i < e.plane_count; ++i) {
        const EyePlane& plane = e.planes[static_cast<std::size_t>(i)];
        if (!plane.cuts) continue;
        add_curve_extrema(out, curve, plane);
        add_contacts(out, curve, plane);
        ++curve;
    }
}

}  // namespace quadrig
