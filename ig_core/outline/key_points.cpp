#include "ig_core/outline/key_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>

#include "ig_core/scene/solid_edges.h"

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void add_key_point(Outline& out, const KeyPoint& point, std::size_t curve) {
    out.key_points.push_back(point);
    out.curves[curve].rows.add(point.zeta);
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
    if (std::isnan(zeta) || (hidden && !faces_eye(e, p))) return zeta;
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

void find_boundaries(const Solid& solid, const glm::dmat3& eye_from_scene, Outline& out, CurveLanes& curves) {
    const EyeSolid& e = out.solid;
    const auto plane_count = e.planes.size();
    CurveOf curve_of;
    for (std::size_t i = 0; i < plane_count; ++i) {
        if (!e.planes[i].cuts) continue;
        curve_of[i] = curves.count;
        curves.add(i, e.planes[i]);
    }
    if (e.set_up == SetUp::anchored && e.anchor.x == 0.0 && e.anchor.z == 0.0)
        find_curves_about_axis(e, curves);
    else
        for (std::size_t i = 0; i < plane_count; ++i)
            if (const EyePlane& plane = e.planes[i]; plane.cuts)
                curves.set_curve(curve_of[i], intersection_curve_on_rows(e, plane), visibility_line(e, plane));
    for (std::size_t curve = 1; curve < curves.count; ++curve)
        out.curves.push_back({curves.conic(curve), {}, curves.line(curve)});
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

void find_key_points(CurveLanes& curves, Outline& out) {
    find_points(out.solid, out.curves[0], curves);
    // Half of them are not there, and no branch could foresee which: each is written down, and counted where it is.
    // What is not a number changes no range.
    std::array<KeyPoint, 4 * CurveLanes::kCapacity> kept;
    std::size_t count = 0;
    CurveRows limb_rows = out.curves[0].rows;
    const auto add = [&](const CurveLanes::Point& point, std::size_t curve, KeyPoint::Kind kind) {
        kept[count] = {point.xi[curve], point.zeta[curve], kind};
        count += std::isnan(point.zeta[curve]) ? 0 : 1;
        return point.zeta[curve];
    };
    for (const CurveLanes::Point& point : curves.extrema) limb_rows.add(add(point, 0, KeyPoint::Kind::limb_extremum));
    for (std::size_t curve = 1; curve < curves.count; ++curve) {
        CurveRows& rows = out.curves[curve].rows;
        for (const CurveLanes::Point& point : curves.extrema)
            rows.add(add(point, curve, KeyPoint::Kind::curve_extremum));
        for (const CurveLanes::Point& point : curves.contacts) {
            const double zeta = add(point, curve, KeyPoint::Kind::contact);
            rows.add(zeta), limb_rows.add(zeta);
        }
    }
    out.curves[0].rows = limb_rows;
    out.key_points.insert(out.key_points.end(), kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace quadrig
