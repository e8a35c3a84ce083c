#include "ig_core/outline/convex_rows.h"

#include <algorithm>
#include <cmath>

namespace quadrig {
namespace {

constexpr int kNone = -1;

}  // namespace

struct ConvexRows::FaceEdges {
    int left = kNone, right = kNone;
};

struct ConvexRows::Stretch {
    double from, to;
    Boundary left, right;
    int plane;                   // kNone for the quadric
    bool bare_left, bare_right;  // nothing is seen beyond that end
};

ConvexRows::ConvexRows(const Outline& outline) : outline_(outline) {
    const EyeSolid& e = outline.solid;
    for (std::size_t i = 0; i < static_cast<std::size_t>(e.plane_count); ++i) {
        edge_on_ = edge_on_ || e.planes[i].at_eye == 0.0;
        relative_depth_[i] = (-1.0 / e.planes[i].at_eye) * outline.visibility_lines[i + 1];
    }
}

bool ConvexRows::find_edges(double zeta, std::array<FaceEdges, kMaxPlanes>& faces) const {
    for (std::size_t i = 0; i < outline_.lines.size(); ++i) {
        const EdgeLine& edge = outline_.lines[i];
        if (!(zeta >= edge.zeta_from && zeta <= edge.zeta_to)) continue;
        // The face of plane i lies to the right of its edge with j where X_ij.x > 0, and that of j to the left.
        const double x = edge.line.x;
        if (x == 0.0) return false;
        int& of_first = x > 0.0 ? faces[edge.plane].left : faces[edge.plane].right;
        int& of_second = x > 0.0 ? faces[edge.other_plane].right : faces[edge.other_plane].left;
        if (of_first != kNone || of_second != kNone) return false;
        of_first = of_second = static_cast<int>(i);
    }
    return true;
}

bool ConvexRows::shows(int plane, double xi, double zeta) const {
    const EyeSolid& e = outline_.solid;
    const glm::dvec3 d(xi, 1.0, zeta);
    const double limb = value(e.limb, d);
    if (!(limb > 0.0)) return false;
    const double quadric = std::sqrt(limb);
    double entry = quadric, exit = -quadric, own = quadric;
    for (int i = 0; i < e.plane_count; ++i) {
        const double at = glm::dot(relative_depth_[static_cast<std::size_t>(i)], d);
        const bool faces_eye = e.planes[static_cast<std::size_t>(i)].at_eye < 0.0;
        entry = faces_eye ? std::min(entry, at) : entry;
        exit = faces_eye ? exit : std::max(exit, at);
        own = i == plane ? at : own;
    }
    return own <= entry && own > exit;
}

bool ConvexRows::tell(double zeta, RowOrder& order) const {
    using Kind = Boundary::Kind;
    const EyeSolid& e = outline_.solid;
    order.clear();
    if (edge_on_ || misses_row(outline_.curves[0], zeta)) return false;
    std::array<FaceEdges, kMaxPlanes> edges;
    if (!find_edges(zeta, edges)) return false;

    const RowRoots limb = roots_on_row(outline_.curves[0], zeta);
    Stretch quadric{limb.rising, limb.falling, {Kind::rising, 0}, {Kind::falling, 0}, kNone, true, true};
    std::array<Stretch, kMaxPlanes> faces;  // by rising `from`
    std::size_t count = 0;
    for (int i = 0; i < e.plane_count; ++i) {
        const auto place = static_cast<std::size_t>(i);
        const auto curve = static_cast<std::uint16_t>(i + 1);
        if (!outline_.curve_rows[curve].may_hold(zeta)) continue;
        const bool faces_eye = e.planes[place].at_eye < 0.0;
        const FaceEdges& ends = edges[place];
        RowRoots roots{};
        if (!faces_eye || ends.left == kNone || ends.right == kNone) {
            if (misses_row(outline_.curves[curve], zeta)) {
                if (faces_eye) return false;
                continue;
            }
            roots = roots_on_row(outline_.curves[curve], zeta);
        }
        const auto keeps_limb = [&](double xi) {
            const bool below_middle = glm::dot(relative_depth_[place], glm::dvec3(xi, 1.0, zeta)) < 0.0;
            return faces_eye != below_middle;
        };
        // The curve of an ellipsoid is an ellipse, its form negative within: `falling` is the left end.
        if (!faces_eye) {
            if (roots.falling > quadric.from && !keeps_limb(roots.falling))
                quadric.from = roots.falling, quadric.left = {Kind::falling, curve};
            if (roots.rising < quadric.to && !keeps_limb(roots.rising))
                quadric.to = roots.rising, quadric.right = {Kind::rising, curve};
            continue;
        }
        const auto end_face = [&](int edge, double root, Kind kind, double& xi, Boundary& boundary, bool& bare) {
            if (edge == kNone) {
                xi = root, boundary = {kind, curve}, bare = !keeps_limb(root);
                return;
            }
            const EdgeLine& line = outline_.lines[static_cast<std::size_t>(edge)];
            const std::size_t other = line.plane == i ? line.other_plane : line.plane;
            xi = line.on_row(zeta), boundary = {Kind::line, static_cast<std::uint16_t>(edge)};
            bare = e.planes[other].at_eye > 0.0;
        };
        Stretch face{0, 0, {}, {}, i, false, false};
        end_face(ends.left, roots.falling, Kind::falling, face.from, face.left, face.bare_left);
        end_face(ends.right, roots.rising, Kind::rising, face.to, face.right, face.bare_right);
        std::size_t at = count++;
        for (; at > 0 && faces[at - 1].from > face.from; --at) faces[at] = faces[at - 1];
        faces[at] = face;
    }

    const auto show = [&](const Boundary& boundary, double from, double to, int plane) {
        if (!(to - from > kSliver)) return to - from > -kDisorder;
        if (!shows(plane, 0.5 * (from + to), zeta)) return false;
        const int surface = plane == kNone ? 0 : e.planes[static_cast<std::size_t>(plane)].surface;
        if (order.last_surface() != surface) order.add({boundary, from, surface});
        return true;
    };
    double from = quadric.from;
    Boundary boundary = quadric.left;
    for (std::size_t i = 0; i < count; ++i) {
        const Stretch& face = faces[i];
        if ((face.bare_left && i > 0) || (face.bare_right && i + 1 < count)) return false;
        const bool after_edge = boundary.kind == Kind::line, at_edge = face.left.kind == Kind::line;
        if (!face.bare_left && (after_edge != at_edge || (at_edge && boundary.index != face.left.index))) return false;
        if (!face.bare_left && !at_edge && !show(boundary, from, face.from, kNone)) return false;
        if (!show(face.left, face.from, face.to, face.plane)) return false;
        from = face.to, boundary = face.right;
    }
    if (count == 0 || !faces[count - 1].bare_right) {
        if (boundary.kind == Kind::line || !show(boundary, from, quadric.to, kNone)) return false;
        from = quadric.to, boundary = quadric.right;
    }
    if (order.begin() == order.end()) return false;
    order.add({boundary, from, kNoSurface});
    return true;
}

}  // namespace quadrig
