#include "ig_core/outline/convex_rows.h"

#include <algorithm>
#include <cmath>

namespace quadrig {
namespace {

/// `which ? a : b` by an index: compilers make a branch of the other.
template <class Value>
Value choose(bool which, const Value& a, const Value& b) {
    const std::array<Value, 2> both{b, a};
    return both[which ? 1 : 0];
}

/// Whether from <= x <= to, as one comparison.
bool within(double x, double from, double to) { return std::min(x - from, to - x) >= 0.0; }

}  // namespace

ConvexRows::Chord::Chord(const RowConic& conic) {
    const double inverse = 1.0 / conic.alpha, square = inverse * inverse;
    middle = {-conic.beta[0] * inverse, -conic.beta[1] * inverse};
    reach2 = {conic.discriminant[0] * square, conic.discriminant[1] * square, conic.discriminant[2] * square};
}

ConvexRows::ConvexRows(const Outline& outline) : limb_chord_(outline.curves[0]), limb_(outline.solid.limb) {
    const EyeSolid& e = outline.solid;
    std::array<std::uint8_t, kMaxPlanes> face_of;
    for (std::size_t i = 0; i < static_cast<std::size_t>(e.plane_count); ++i) {
        const double at_eye = e.planes[i].at_eye;
        edge_on_ = edge_on_ || at_eye == 0.0;
        const bool faces_eye = at_eye < 0.0;
        face_of[i] = faces_eye ? static_cast<std::uint8_t>(facing_count_) : kNoFace;
        Plane& plane = faces_eye ? facing_[facing_count_++] : away_[away_count_++];
        plane.chord = Chord(outline.curves[i + 1]);
        plane.zeta_from = outline.curves[i + 1].rows.zeta_from - CurveRows::kRounding;
        plane.zeta_to = outline.curves[i + 1].rows.zeta_to + CurveRows::kRounding;
        plane.depth = (-1.0 / at_eye) * outline.curves[i + 1].visibility_line;
        plane.curve = static_cast<std::uint16_t>(i + 1);
        plane.surface = e.planes[i].surface;
    }
    edges_[0] = {0, 0, {}, kNoFace, kNoFace};
    for (const EdgeLine& edge : outline.lines) {
        // The face of plane i lies to the right of its edge with j where X_ij.x > 0, and that of j to the left.
        const std::uint8_t face = face_of[edge.plane], other = face_of[edge.other_plane];
        const bool to_the_right = edge.line.x > 0.0;
        const double inverse = -1.0 / edge.line.x;
        edges_[edge_count_++] = {edge.zeta_from,
                                 edge.zeta_to,
                                 {edge.line.y * inverse, edge.line.z * inverse},
                                 to_the_right ? other : face,
                                 to_the_right ? face : other};
    }
}

bool ConvexRows::shows(int face, double xi, double zeta) const {
    const double limb = value(limb_, glm::dvec3(xi, 1.0, zeta));
    if (!(limb > 0.0)) return false;
    const double quadric = std::sqrt(limb);
    double entry = quadric, exit = -quadric;
    for (std::size_t i = 0; i < facing_count_; ++i) entry = std::min(entry, facing_[i].depth_at(xi, zeta));
    for (std::size_t i = 0; i < away_count_; ++i) exit = std::max(exit, away_[i].depth_at(xi, zeta));
    const double own = face == kQuadric ? quadric : facing_[static_cast<std::size_t>(face)].depth_at(xi, zeta);
    return own <= entry && own > exit;
}

bool ConvexRows::find_faces(double zeta, Faces& faces) const {
    unsigned taken = 0;
    std::array<std::uint8_t, kMaxPlanes + 1> left_edges{}, right_edges{};
    for (std::size_t i = 1; i < edge_count_; ++i) {
        const Edge& edge = edges_[i];
        const bool on_row = within(zeta, edge.zeta_from, edge.zeta_to);
        const std::size_t right = choose(on_row, edge.right_face, kNoFace);
        const std::size_t left = choose(on_row, edge.left_face, kNoFace);
        left_edges[kNoFace] = right_edges[kNoFace] = 0;
        taken |= left_edges[right] | right_edges[left];
        left_edges[right] = right_edges[left] = static_cast<std::uint8_t>(i);
    }
    bool doubtful = edge_on_ || taken != 0;
    faces.count = 0;
    for (std::size_t i = 0; i < facing_count_; ++i) {
        const Plane& plane = facing_[i];
        const double reach2 = plane.chord.reach2_at(zeta), middle = plane.chord.middle_at(zeta);
        const double reach = std::sqrt(std::abs(reach2));
        const Edge &left = edges_[left_edges[i]], &right = edges_[right_edges[i]];
        const bool at_left = left_edges[i] != 0, at_right = right_edges[i] != 0;
        Stretch& face = faces.stretches[faces.count];
        face.from = choose(at_left, left.xi_at(zeta), middle - reach);
        face.to = choose(at_right, right.xi_at(zeta), middle + reach);
        face.face = static_cast<std::uint8_t>(i), face.left_edge = left_edges[i], face.right_edge = right_edges[i];
        face.bare_left = choose(at_left, left.left_face == kNoFace, plane.depth_at(face.from, zeta) < 0.0);
        face.bare_right = choose(at_right, right.right_face == kNoFace, plane.depth_at(face.to, zeta) < 0.0);
        const bool seen = within(zeta, plane.zeta_from, plane.zeta_to);
        doubtful |= choose(seen, choose(at_left, !at_right, true), false) && !(reach2 >= 0.0);
        faces.count += seen ? 1 : 0;
    }
    auto& s = faces.stretches;
    for (std::size_t i = 1; i < faces.count; ++i)
        for (std::size_t at = i; at > 0 && s[at - 1].from > s[at].from; --at) std::swap(s[at - 1], s[at]);
    return !doubtful;
}

ConvexRows::Ends ConvexRows::quadric_ends(double zeta, double limb_reach2) const {
    using Kind = Boundary::Kind;
    const double limb_middle = limb_chord_.middle_at(zeta), limb_reach = std::sqrt(limb_reach2);
    double from = limb_middle - limb_reach, to = limb_middle + limb_reach;
    std::uint16_t left_curve = 0, right_curve = 0;
    for (std::size_t i = 0; i < away_count_; ++i) {
        const Plane& plane = away_[i];
        const double at = plane.chord.middle_at(zeta), reach2 = plane.chord.reach2_at(zeta);
        const double half = std::sqrt(std::abs(reach2)), left = at - half, right = at + half;
        const bool on_row = within(zeta, plane.zeta_from, plane.zeta_to) && reach2 > 0.0;
        const bool ends_left = on_row && left > from && plane.depth_at(left, zeta) >= 0.0;
        const bool ends_right = on_row && right < to && plane.depth_at(right, zeta) >= 0.0;
        from = ends_left ? left : from, left_curve = ends_left ? plane.curve : left_curve;
        to = ends_right ? right : to, right_curve = ends_right ? plane.curve : right_curve;
    }
    // The limb's form is positive, a plane's negative within.
    return {from,
            to,
            {left_curve == 0 ? Kind::rising : Kind::falling, left_curve},
            {right_curve == 0 ? Kind::falling : Kind::rising, right_curve}};
}

bool ConvexRows::tell(double zeta, RowOrder& order) const {
    using Kind = Boundary::Kind;
    order.clear();
    const double limb_reach2 = limb_chord_.reach2_at(zeta);
    if (limb_reach2 < 0.0) return true;
    Faces faces;
    if (!find_faces(zeta, faces)) return false;
    const Ends quadric = quadric_ends(zeta, limb_reach2);
    const std::size_t count = faces.count;
    double from = quadric.from;
    const auto boundary_of = [](std::uint8_t edge, Kind kind, std::uint16_t curve) {
        return edge != 0 ? Boundary{Kind::line, static_cast<std::uint16_t>(edge - 1)} : Boundary{kind, curve};
    };
    const auto show = [&](const Boundary& boundary, double until, int face) {
        if (!(until - from > kSliver)) return until - from > -kDisorder;
        if (!shows(face, 0.5 * (from + until), zeta)) return false;
        const int surface = face == kQuadric ? 0 : facing_[static_cast<std::size_t>(face)].surface;
        if (order.last_surface() != surface) order.add(boundary, surface);
        return true;
    };
    Boundary boundary = quadric.left;
    std::uint8_t edge = 0;  // that the last face ended in
    for (std::size_t i = 0; i < count; ++i) {
        const Stretch& face = faces.stretches[i];
        if (face.bare_left ? i > 0 : edge != face.left_edge) return false;
        if (face.bare_right && i + 1 < count) return false;
        if (!face.bare_left && edge == 0 && !show(boundary, face.from, kQuadric)) return false;
        from = face.from;
        const std::uint16_t curve = facing_[face.face].curve;
        if (!show(boundary_of(face.left_edge, Kind::falling, curve), face.to, face.face)) return false;
        from = face.to, edge = face.right_edge, boundary = boundary_of(edge, Kind::rising, curve);
    }
    if (count == 0 || !faces.stretches[count - 1].bare_right) {
        if (edge != 0 || !show(boundary, quadric.to, kQuadric)) return false;
        boundary = quadric.right;
    }
    if (order.begin() == order.end()) return false;
    order.add(boundary, kNoSurface);
    return true;
}

}  // namespace quadrig
