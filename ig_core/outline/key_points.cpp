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

void add_key_point(Outline& out, const KeyPoint& point, std::size_t curve) {
    out.key_points.push_back(point);
    out.curves[curve].rows.add(point.zeta);
}

/// Points of limb and curves that are key points if the planes keep them. All are held against a plane in one go, which
/// compilers turn into vector instructions; one by one they cost three times as much.
class Candidates {
  public:
    /// A point at depth k on the ray through (xi, zeta), on one or two curves; `own` is the plane whose curve it is on.
    void add(double k, const KeyPoint& point, std::size_t curve, std::size_t other_curve, std::size_t own) {
        if (!(std::isfinite(k) && k > 0.0)) return;
        x_[count_] = k * point.xi, y_[count_] = k, z_[count_] = k * point.zeta;
        places_[count_++] = {point, curve, other_curve, own};
    }
    void add_kept(Outline& out) {
        const EyeSolid& e = out.solid;
        std::fill_n(losses_.begin(), count_, 0.0);
        for (const EyePlane& plane : e.planes)
            for (std::size_t c = 0; c < count_; ++c) losses_[c] += loses(plane, x_[c], y_[c], z_[c]) ? 1.0 : 0.0;
        for (std::size_t c = 0; c < count_; ++c) {
            const Place& place = places_[c];
            const bool lost_by_own =
                losses_[c] == 1.0 && place.own != kNoPlane && loses(e.planes[place.own], x_[c], y_[c], z_[c]);
            if (losses_[c] != 0.0 && !lost_by_own) continue;
            add_key_point(out, place.point, place.curve);
            out.curves[place.other_curve].rows.add(place.point.zeta);
        }
    }
    static constexpr std::size_t kNoPlane = kMaxEyePlanes;

  private:
    struct Place {
        KeyPoint point;
        std::size_t curve, other_curve, own;
    };
    /// Two extrema of every curve, two contacts of every plane.
    static constexpr std::size_t kCapacity = 2 + 4 * kMaxEyePlanes;
    std::size_t count_ = 0;
    std::array<double, kCapacity> x_, y_, z_, losses_;
    std::array<Place, kCapacity> places_;
};

/// Limb points are where the ray touches the quadric, k = -B/A.
double limb_depth(const EyeSolid& e, double xi, double zeta) {
    const glm::dvec3 d(xi, 1.0, zeta);
    return -glm::dot(e.v, d) / value(e.m, d);
}

void add_curve_extrema(const Outline& out, std::size_t index, std::size_t own, Candidates& candidates) {
    const EyePlane& plane = out.solid.planes[own];
    const RowConic& curve = out.curves[index];
    std::array<double, 2> zetas;
    const int count = real_roots(curve.discriminant[2], 0.5 * curve.discriminant[1], curve.discriminant[0], zetas);
    for (int i = 0; i < count; ++i) {
        const double zeta = zetas[static_cast<std::size_t>(i)], xi = -curve.beta_at(zeta) / curve.alpha;
        const glm::dvec3 d(xi, 1.0, zeta);
        const double k = -plane.at_eye / glm::dot(plane.normal, d);
        if (plane.at_eye <= 0.0 || quadric_faces_eye(out.solid, k * d))
            candidates.add(k, {xi, zeta, KeyPoint::Kind::curve_extremum}, index, index, own);
    }
}

/// Contact points: limb and visibility line meet (Eq 6, 12). Along the line xi = start + slope zeta, or zeta = start +
/// slope xi, whichever is less steep.
void add_contacts(const Outline& out, std::size_t curve, std::size_t own, Candidates& candidates) {
    const glm::dvec3& line = out.curves[curve].visibility_line;
    const Sym3& l = out.solid.limb;
    const bool by_zeta = std::abs(line.x) >= std::abs(line.z);
    const double lead = by_zeta ? line.x : line.z;
    if (lead == 0.0) return;
    const double start = -line.y / lead, slope = -(by_zeta ? line.z : line.x) / lead;
    const double uu = by_zeta ? l.xx : l.zz, uy = by_zeta ? l.xy : l.yz;
    const double tt = by_zeta ? l.zz : l.xx, ty = by_zeta ? l.yz : l.xy;
    std::array<double, 2> t;
    const int count = real_roots((uu * slope + 2.0 * l.xz) * slope + tt, (uu * slope + l.xz) * start + uy * slope + ty,
                                 (uu * start + 2.0 * uy) * start + l.yy, t);
    for (int i = 0; i < count; ++i) {
        const double at = t[static_cast<std::size_t>(i)], on_line = start + slope * at;
        const double xi = by_zeta ? on_line : at, zeta = by_zeta ? at : on_line;
        candidates.add(limb_depth(out.solid, xi, zeta), {xi, zeta, KeyPoint::Kind::contact}, 0, curve, own);
    }
}

using CurveOf = std::array<std::size_t, kMaxEyePlanes>;

/// Height of an end of edges, which is a key point unless nothing is seen there.
double add_vertex(const SolidVertex& vertex, const glm::dmat3& eye_from_scene, const CurveOf& curve_of, Outline& out) {
    const EyeSolid& e = out.solid;
    const glm::dvec3 q = eye_from_scene * vertex.at;
    const glm::dvec3 p = e.anchor + glm::dvec3(q.x - e.x0 * q.y, q.y, q.z - e.z0 * q.y);
    const double xi = p.x / p.y, zeta = p.z / p.y;
    const auto [i, j, third] = vertex.planes;
    const std::size_t k = third == SolidVertex::kNoPlane ? j : third;
    // Between planes that face away edges are hidden, but their ends can be where the curves meet.
    const bool hidden = e.planes[i].at_eye > 0.0 && e.planes[j].at_eye > 0.0 && e.planes[k].at_eye > 0.0;
    if (std::isnan(zeta) || (hidden && !quadric_faces_eye(e, p))) return zeta;
    add_key_point(out, {xi, zeta, KeyPoint::Kind::edge_end}, curve_of[i]);
    out.curves[curve_of[j]].rows.add(zeta), out.curves[curve_of[k]].rows.add(zeta);
    return zeta;
}

/// An edge whose ends are at these heights.
void add_edge(std::size_t i, std::size_t j, double zeta, double other_zeta, Outline& out) {
    const EyePlane &a = out.solid.planes[i], &b = out.solid.planes[j];
    if (a.at_eye > 0.0 && b.at_eye > 0.0) return;
    out.lines.push_back({intersection_line(out.solid, a, b), std::min(zeta, other_zeta), std::max(zeta, other_zeta),
                         static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)});
}

/// Of a solid without end every line in which two planes meet is taken for an edge, and of no length known.
void add_endless_lines(Outline& out) {
    const EyeSolid& e = out.solid;
    for (std::size_t i = 0; i < e.planes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (e.planes[i].cuts && e.planes[j].cuts) add_edge(i, j, -kInfinity, kInfinity, out);
}

}  // namespace

void find_boundaries(const Solid& solid, const glm::dmat3& eye_from_scene, Outline& out) {
    const EyeSolid& e = out.solid;
    const auto plane_count = e.planes.size();
    CurveOf curve_of;
    for (std::size_t i = 0; i < plane_count; ++i) {
        if (!e.planes[i].cuts) continue;
        curve_of[i] = out.curves.size();
        out.curves.push_back({intersection_curve_on_rows(e, e.planes[i]), {}, visibility_line(e, e.planes[i])});
    }
    if (out.direct) return add_endless_lines(out);
    if (plane_count == solid.planes.size()) {
        std::array<double, kMaxPlanes*(kMaxPlanes - 1)> heights;
        for (std::size_t i = 0; i < solid.vertices.size(); ++i)
            heights[i] = add_vertex(solid.vertices[i], eye_from_scene, curve_of, out);
        for (const SolidEdge& edge : solid.edges)
            add_edge(edge.plane, edge.other_plane, heights[edge.from], heights[edge.to], out);
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
                if (const auto edge = edge_between(solid, {planes.data(), plane_count}, i, j))
                    add_edge(i, j, add_vertex(edge->from, eye_from_scene, curve_of, out),
                             add_vertex(edge->to, eye_from_scene, curve_of, out), out);
}

void find_key_points(Outline& out) {
    const EyeSolid& e = out.solid;
    const RowConic& limb = out.curves[0];
    Candidates candidates;
    std::array<double, 2> zetas;
    const int count = real_roots(limb.discriminant[2], 0.5 * limb.discriminant[1], limb.discriminant[0], zetas);
    for (int i = 0; i < count; ++i) {
        const double zeta = zetas[static_cast<std::size_t>(i)], xi = -limb.beta_at(zeta) / limb.alpha;
        candidates.add(limb_depth(e, xi, zeta), {xi, zeta, KeyPoint::Kind::limb_extremum}, 0, 0, Candidates::kNoPlane);
    }
    std::size_t curve = 1;
    for (std::size_t i = 0; i < e.planes.size(); ++i) {
        if (!e.planes[i].cuts) continue;
        add_curve_extrema(out, curve, i, candidates);
        add_contacts(out, curve, i, candidates);
        ++curve;
    }
    candidates.add_kept(out);
}

}  // namespace quadrig
