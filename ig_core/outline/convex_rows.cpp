#include "ig_core/outline/convex_rows.h"

#include <algorithm>
#include <limits>

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoRay = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kQuadric = kMaxPlanes;

Chord chord_of(const RowConic& conic) {
    const double inverse = 1.0 / conic.alpha, square = inverse * inverse;
    return {{-conic.beta[0] * inverse, -conic.beta[1] * inverse},
            {conic.discriminant[0] * square, conic.discriminant[1] * square, conic.discriminant[2] * square}};
}

}  // namespace

ConvexRows::ConvexRows(const Outline& outline) {
    const EyeSolid& e = outline.solid;
    shape_.limb_chord = chord_of(outline.curves[0]);
    shape_.limb = e.limb;
    std::array<std::size_t, kMaxPlanes> face_of;
    for (std::size_t i = 0; i < e.planes.size(); ++i) {
        const double at_eye = e.planes[i].at_eye;
        edge_on_ = edge_on_ || at_eye == 0.0;
        const bool faces_eye = at_eye < 0.0;
        face_of[i] = faces_eye ? shape_.facing_count : ConvexShape::kNoFace;
        const Curve& curve = outline.curves[i + 1];
        ConvexShape::Plane& plane = faces_eye ? shape_.facing[shape_.facing_count++] : shape_.away[shape_.away_count++];
        plane.chord = chord_of(curve);
        plane.zeta_from = curve.rows.zeta_from - CurveRows::kRounding;
        plane.zeta_to = curve.rows.zeta_to + CurveRows::kRounding;
        plane.depth = (-1.0 / at_eye) * curve.visibility_line;
        plane.curve = static_cast<std::uint16_t>(i + 1);
        plane.surface = e.planes[i].surface;
    }
    for (const EdgeLine& edge : outline.lines) {
        // The face of plane i lies to the right of its edge with j where X_ij.x > 0, and that of j to the left.
        const std::size_t face = face_of[edge.plane], other = face_of[edge.other_plane];
        const bool to_the_right = edge.line.x > 0.0;
        const double inverse = -1.0 / edge.line.x;
        shape_.edges[shape_.edge_count++] = {edge.zeta_from,
                                             edge.zeta_to,
                                             {edge.line.y * inverse, edge.line.z * inverse},
                                             to_the_right ? other : face,
                                             to_the_right ? face : other};
    }
}

bool ConvexRows::find_chain(ConvexLanes& rows, std::size_t row, RowOrder& order) const {
    using Kind = Boundary::Kind;
    std::array<std::size_t, kMaxPlanes> faces;  // from left to right
    std::size_t count = 0;
    for (std::size_t i = 0; i < shape_.facing_count; ++i) {
        if (rows.from[i][row] == kInfinity) continue;
        std::size_t at = count++;
        for (; at > 0 && rows.from[faces[at - 1]][row] > rows.from[i][row]; --at) faces[at] = faces[at - 1];
        faces[at] = i;
    }
    const auto depth_at = [&](std::size_t face, double xi) {
        return shape_.facing[face].depth.x * xi + rows.facing_depth[face][row];
    };
    double from = rows.quadric_from[row];
    std::size_t ray_count = 0;
    const auto show = [&](const Boundary& boundary, double until, std::size_t face) {
        if (!(until - from > kSliver)) return until - from > -kDisorder;
        const double xi = 0.5 * (from + until);
        if (ray_count == rows.ray_count) {
            rows.rays[ray_count].xi.fill(0.0);
            rows.rays[ray_count].depth.fill(kNoRay);
            ++rows.ray_count;
        }
        rows.rays[ray_count].xi[row] = xi;
        rows.rays[ray_count].depth[row] = face == kQuadric ? kInfinity : depth_at(face, xi);
        ++ray_count;
        const int surface = face == kQuadric ? 0 : shape_.facing[face].surface;
        if (order.last_surface() != surface) order.add(boundary, surface);
        return true;
    };
    const auto boundary_of = [](std::size_t edge, Kind kind, std::uint16_t curve) {
        return edge != 0 ? Boundary{Kind::line, static_cast<std::uint16_t>(edge - 1)} : Boundary{kind, curve};
    };
    // The limb's form is positive, a plane's negative within.
    const auto left_curve = static_cast<std::uint16_t>(rows.left_curve[row]);
    const auto right_curve = static_cast<std::uint16_t>(rows.right_curve[row]);
    Boundary boundary{left_curve == 0 ? Kind::rising : Kind::falling, left_curve};
    std::size_t edge = 0;  // that the last face ended in
    bool bare = false;     // nothing is seen beyond it
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t face = faces[n];
        const std::uint16_t curve = shape_.facing[face].curve;
        const double face_from = rows.from[face][row], to = rows.to[face][row];
        const auto left_edge = static_cast<std::size_t>(rows.left_edge[face][row]);
        const auto right_edge = static_cast<std::size_t>(rows.right_edge[face][row]);
        const bool bare_left = left_edge != 0 ? shape_.edges[left_edge].left_face == ConvexShape::kNoFace
                                              : depth_at(face, face_from) < 0.0;
        if (bare || (bare_left ? n > 0 : edge != left_edge)) return false;
        if (!bare_left && edge == 0 && !show(boundary, face_from, kQuadric)) return false;
        from = face_from;
        if (!show(boundary_of(left_edge, Kind::falling, curve), to, face)) return false;
        from = to, edge = right_edge, boundary = boundary_of(edge, Kind::rising, curve);
        bare = right_edge != 0 ? shape_.edges[right_edge].right_face == ConvexShape::kNoFace : depth_at(face, to) < 0.0;
    }
    if (!bare) {
        if (edge != 0 || !show(boundary, rows.quadric_to[row], kQuadric)) return false;
        boundary = {right_curve == 0 ? Kind::falling : Kind::rising, right_curve};
    }
    if (ray_count == 0) return false;
    order.add(boundary, kNoSurface);
    return true;
}

void ConvexRows::tell(std::span<const double> zeta, Told& told) const {
    ConvexLanes rows;
    rows.count = zeta.size(), rows.ray_count = 0;
    for (std::size_t r = 0; r < kRowsTogether; ++r) rows.zeta[r] = zeta[std::min(r, zeta.size() - 1)];
    find_lanes(shape_, rows);
    for (std::size_t r = 0; r < rows.count; ++r) {
        told.orders[r].clear();
        told.sure[r] = !edge_on_ && rows.doubts[r] == 0.0 && find_chain(rows, r, told.orders[r]);
    }
    check_rays(shape_, rows);
    for (std::size_t r = 0; r < rows.count; ++r) told.sure[r] = told.sure[r] && rows.wrong_rays[r] == 0.0;
}

}  // namespace quadrig
