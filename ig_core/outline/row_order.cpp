#include "ig_core/outline/row_order.h"

#include <algorithm>
#include <cmath>

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Boundaries closer than this (image-plane units; a pixel is 1e-5 at the least) are one: the sliver between them is
/// not asked.
constexpr double kSliver = 1e-12;
/// Boundaries that come out of order by more than this contradict the order.
constexpr double kDisorder = 1e-11;

/// A discriminant this small beside its terms may be zero.
constexpr double kTouch = 1e-12;

struct Candidate {
    double xi;
    Boundary boundary;
};

/// Whether the row is clear of the curve by more than rounding. A wedge's edge is a double line: it is touched
/// everywhere.
bool misses_row(const RowConic& conic, double zeta) {
    const double discriminant = conic.discriminant_at(zeta);
    if (discriminant >= 0.0) return false;
    const double beta = conic.beta_at(zeta);
    return discriminant < -kTouch * (beta * beta + std::abs(conic.alpha * conic.gamma_at(zeta)));
}

bool may_be_seen(const CurveRows& rows, double zeta) {
    constexpr double kRounding = 1e-9;
    return zeta >= rows.zeta_from - kRounding && zeta <= rows.zeta_to + kRounding;
}

/// Every place on a row where the visible surface may change, sorted. Of a bounded solid only what lies on it counts.
std::size_t candidates_on_row(const Outline& outline, double zeta, std::array<Candidate, RowOrder::kCapacity>& out) {
    const EyeSolid& e = outline.solid;
    std::size_t count = 0;
    const auto add = [&](double xi, Boundary boundary) {
        if (std::isfinite(xi) && count < out.size()) out[count++] = {xi, boundary};
    };
    const auto add_roots = [&](std::uint16_t curve, auto&& on_solid) {
        if (!outline.direct && !may_be_seen(outline.curve_rows[curve], zeta)) return;
        if (misses_row(outline.curves[curve], zeta)) return;
        const RowRoots roots = roots_on_row(outline.curves[curve], zeta);
        if (on_solid(roots.rising)) add(roots.rising, {Boundary::Kind::rising, curve});
        if (on_solid(roots.falling)) add(roots.falling, {Boundary::Kind::falling, curve});
    };
    // The point at k = over/under on the ray; where `under` is little more than rounding, nothing is known of it.
    const auto kept = [&](const glm::dvec3& d, double over, double under, const EyePlane* own) {
        constexpr double kUnknown = 1e-8;
        if (outline.direct || !(std::abs(under) > kUnknown * glm::dot(d, d))) return true;
        const double k = over / under;
        return k > 0.0 && kept_by_planes(e, k * d, own);
    };
    add_roots(0, [&](double xi) {
        const glm::dvec3 d(xi, 1.0, zeta);
        return kept(d, -glm::dot(e.v, d), value(e.m, d), nullptr);
    });
    std::uint16_t curve = 1;
    for (int i = 0; i < e.plane_count; ++i) {
        const EyePlane& plane = e.planes[static_cast<std::size_t>(i)];
        if (!plane.cuts) continue;
        add_roots(curve++, [&](double xi) {
            const glm::dvec3 d(xi, 1.0, zeta);
            return kept(d, -plane.at_eye, glm::dot(plane.normal, d), &plane);
        });
    }
    for (std::uint16_t i = 0; i < outline.lines.size(); ++i)
        if (zeta >= outline.lines[i].zeta_from && zeta <= outline.lines[i].zeta_to)
            add(outline.lines[i].on_row(zeta), {Boundary::Kind::line, i});
    std::sort(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Candidate& a, const Candidate& b) { return a.xi < b.xi; });
    return count;
}

/// The edges in which a plane's face ends on a row, as indices into Outline::lines.
struct FaceEdges {
    static constexpr int kNone = -1;
    int left = kNone, right = kNone;
};

/// Whether the edges on the row could be told apart.
bool find_edges(const Outline& outline, double zeta, std::array<FaceEdges, kMaxEyePlanes>& faces) {
    for (std::size_t i = 0; i < outline.lines.size(); ++i) {
        const EdgeLine& edge = outline.lines[i];
        if (!(zeta >= edge.zeta_from && zeta <= edge.zeta_to)) continue;
        // To the right of the edge X_ij lies the face of plane i where X_ij.x > 0: there u = 1/k is less on it than on
        // the plane j that faces the eye, more than on the j that faces away.
        const double x = edge.line.x;
        if (x == 0.0) return false;
        int& of_first = x > 0.0 ? faces[edge.plane].left : faces[edge.plane].right;
        int& of_second = x > 0.0 ? faces[edge.other_plane].right : faces[edge.other_plane].left;
        if (of_first != FaceEdges::kNone || of_second != FaceEdges::kNone) return false;
        of_first = of_second = static_cast<int>(i);
    }
    return true;
}

/// Part of a row, between two boundaries.
struct Stretch {
    double from, to;
    Boundary left, right;
    int surface;
    bool bare_left, bare_right;  ///< nothing is seen beyond that end
};

/// Whether the limb is kept by a plane on the row, on the side of the quadric where it meets the plane at xi (Eq 12).
bool keeps_limb(const EyeSolid& e, const EyePlane& plane, double xi, double zeta) {
    const glm::dvec3 d(xi, 1.0, zeta);
    return e.s * glm::dot(plane.normal, d) - plane.at_eye * glm::dot(e.v, d) >= 0.0;
}

}  // namespace

void solve_row(const Outline& outline, double zeta, RowOrder& order) {
    order.clear();
    std::array<Candidate, RowOrder::kCapacity> candidates;
    const std::size_t count = candidates_on_row(outline, zeta, candidates);
    int surface = kNoSurface;
    double left = -kInfinity;
    Boundary left_boundary{Boundary::Kind::left_end, 0};
    for (std::size_t i = 0; i <= count; ++i) {
        const double right = i < count ? candidates[i].xi : kInfinity;
        const bool outside = (i == 0 || i == count) && !outline.direct;  // of a bounded solid: nothing is there
        if (outside && surface != kNoSurface) order.add({left_boundary, left, surface = kNoSurface});
        if (!outside && right - left > kSliver) {
            double middle = 0.5 * (left + right);
            if (!std::isfinite(left))
                middle = std::isfinite(right) ? right - 1.0 - std::abs(right) : 0.0;
            else if (!std::isfinite(right))
                middle = left + 1.0 + std::abs(left);
            const int here = surface_at(outline.solid, middle, zeta);
            if (here != surface) order.add({left_boundary, left, here});
            surface = here;
        }
        if (i < count) {
            left = right;
            left_boundary = candidates[i].boundary;
        }
    }
    if (surface != kNoSurface) order.add({{Boundary::Kind::right_end, 0}, kInfinity, kNoSurface});
}

bool tell_row(const Outline& outline, double zeta, RowOrder& order) {
    using Kind = Boundary::Kind;
    order.clear();
    const EyeSolid& e = outline.solid;
    if (misses_row(outline.curves[0], zeta)) return false;
    std::array<FaceEdges, kMaxEyePlanes> edges;
    std::fill_n(edges.begin(), e.plane_count, FaceEdges{});
    if (!find_edges(outline, zeta, edges)) return false;

    const RowRoots limb = roots_on_row(outline.curves[0], zeta);
    Stretch quadric{limb.rising, limb.falling, {Kind::rising, 0}, {Kind::falling, 0}, 0, true, true};
    std::array<Stretch, kMaxEyePlanes> faces;  // by rising `from`
    int count = 0;
    for (int i = 0; i < e.plane_count; ++i) {
        const EyePlane& plane = e.planes[static_cast<std::size_t>(i)];
        const auto curve = static_cast<std::uint16_t>(i + 1);
        if (!may_be_seen(outline.curve_rows[curve], zeta)) continue;
        const bool faces_eye = plane.at_eye < 0.0;
        const FaceEdges& ends = edges[static_cast<std::size_t>(i)];
        RowRoots roots{};
        if (!faces_eye || ends.left == FaceEdges::kNone || ends.right == FaceEdges::kNone) {
            if (misses_row(outline.curves[curve], zeta)) {
                if (faces_eye) return false;
                continue;
            }
            roots = roots_on_row(outline.curves[curve], zeta);
        }
        // An ellipsoid's curve is an ellipse, its form negative within.
        const double left = roots.falling, right = roots.rising;
        if (!faces_eye) {
            if (left > quadric.from && !keeps_limb(e, plane, left, zeta))
                quadric.from = left, quadric.left = {Kind::falling, curve};
            if (right < quadric.to && !keeps_limb(e, plane, right, zeta))
                quadric.to = right, quadric.right = {Kind::rising, curve};
            continue;
        }
        const auto end = [&](int edge, double root, Kind kind, double& xi, Boundary& boundary, bool& bare) {
            if (edge == FaceEdges::kNone) {
                xi = root, boundary = {kind, curve}, bare = !keeps_limb(e, plane, root, zeta);
                return;
            }
            const EdgeLine& line = outline.lines[static_cast<std::size_t>(edge)];
            const std::size_t other = line.plane == i ? line.other_plane : line.plane;
            xi = line.on_row(zeta), boundary = {Kind::line, static_cast<std::uint16_t>(edge)};
            bare = e.planes[other].at_eye > 0.0;
        };
        Stretch face{0, 0, {}, {}, plane.surface, false, false};
        end(ends.left, left, Kind::falling, face.from, face.left, face.bare_left);
        end(ends.right, right, Kind::rising, face.to, face.right, face.bare_right);
        int at = count++;
        for (; at > 0 && faces[static_cast<std::size_t>(at - 1)].from > face.from; --at)
            faces[static_cast<std::size_t>(at)] = faces[static_cast<std::size_t>(at - 1)];
        faces[static_cast<std::size_t>(at)] = face;
    }

    const auto show = [&](const Boundary& boundary, double from, double to, int surface) {
        if (!(to - from > kSliver)) return to - from > -kDisorder;
        if (surface_at(e, 0.5 * (from + to), zeta) != surface) return false;
        if (order.last_surface() != surface) order.add({boundary, from, surface});
        return true;
    };
    double from = quadric.from;
    Boundary boundary = quadric.left;
    for (int i = 0; i < count; ++i) {
        const Stretch& face = faces[static_cast<std::size_t>(i)];
        const bool joined = i > 0 && boundary.kind == Kind::line && face.left.kind == Kind::line;
        if (joined && boundary.index != face.left.index) return false;
        if (face.bare_left && i > 0) return false;
        if (face.bare_right && i + 1 < count) return false;
        if (!face.bare_left && !joined) {
            if (boundary.kind == Kind::line || face.left.kind == Kind::line) return false;
            if (!show(boundary, from, face.from, 0)) return false;
        }
        if (!show(face.left, face.from, face.to, face.surface)) return false;
        from = face.to, boundary = face.right;
    }
    if (count == 0 || !faces[static_cast<std::size_t>(count - 1)].bare_right) {
        if (boundary.kind == Kind::line || !show(boundary, from, quadric.to, 0)) return false;
        from = quadric.to, boundary = quadric.right;
    }
    if (order.begin() == order.end()) return false;
    order.add({boundary, from, kNoSurface});
    return true;
}

}  // namespace quadrig
