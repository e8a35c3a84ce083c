#include "ig_core/outline/row_lanes.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/outline/row_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kRowsTogether>;
using V = hn::Vec<D>;

/// Products and sums are rounded apart, as they are elsewhere: a face's depth has to come out the same.
HWY_INLINE V line_at(D d, double constant, double slope, V x) {
    return hn::Add(hn::Mul(hn::Set(d, slope), x), hn::Set(d, constant));
}
HWY_INLINE V middle_at(D d, const Chord& chord, V zeta) { return line_at(d, chord.middle[0], chord.middle[1], zeta); }
HWY_INLINE V reach_at(D d, const Chord& chord, V zeta) {
    const auto& c = chord.reach2;
    return hn::Sqrt(hn::Add(hn::Set(d, c[0]), hn::Mul(zeta, line_at(d, c[1], c[2], zeta))));
}
template <class Range>
HWY_INLINE hn::Mask<D> holds(D d, const Range& range, V zeta) {
    return hn::And(hn::Ge(zeta, hn::Set(d, range.zeta_from)), hn::Le(zeta, hn::Set(d, range.zeta_to)));
}

/// An edge's place on the rows that it is on, as the end of a face, and its index.
HWY_INLINE void put_edge(D d, std::size_t row, hn::Mask<D> on_row, V xi, V index, RowLanes& ends, RowLanes& edges,
                         RowLanes& doubts) {
    const V known = hn::LoadU(d, &edges[row]);
    hn::StoreU(hn::Add(hn::LoadU(d, &doubts[row]), hn::IfThenElseZero(on_row, known)), d, &doubts[row]);
    hn::StoreU(hn::IfThenElse(on_row, index, known), d, &edges[row]);
    hn::StoreU(hn::IfThenElse(on_row, xi, hn::LoadU(d, &ends[row])), d, &ends[row]);
}

HWY_INLINE void find_faces(D d, const ConvexShape& shape, std::size_t row, ConvexLanes& rows) {
    const V zeta = hn::LoadU(d, &rows.zeta[row]), zero = hn::Zero(d);
    const V no_end = hn::Set(d, std::numeric_limits<double>::infinity());
    hn::StoreU(zero, d, &rows.doubts[row]);
    for (std::size_t i = 0; i < shape.facing_count; ++i) {
        const ConvexShape::Plane& plane = shape.facing[i];
        const V middle = middle_at(d, plane.chord, zeta), reach = reach_at(d, plane.chord, zeta);
        hn::StoreU(line_at(d, plane.depth.y, plane.depth.z, zeta), d, &rows.facing_depth[i][row]);
        hn::StoreU(hn::IfThenElse(holds(d, plane, zeta), hn::Sub(middle, reach), no_end), d, &rows.from[i][row]);
        hn::StoreU(hn::Add(middle, reach), d, &rows.to[i][row]);
        hn::StoreU(zero, d, &rows.left_edge[i][row]);
        hn::StoreU(zero, d, &rows.right_edge[i][row]);
    }
    for (std::size_t i = 1; i < shape.edge_count; ++i) {
        const ConvexShape::Edge& edge = shape.edges[i];
        const hn::Mask<D> on_row = holds(d, edge, zeta);
        const V xi = line_at(d, edge.xi[0], edge.xi[1], zeta), index = hn::Set(d, static_cast<double>(i));
        const std::size_t right = edge.right_face, left = edge.left_face;
        if (right != ConvexShape::kNoFace)
            put_edge(d, row, on_row, xi, index, rows.from[right], rows.left_edge[right], rows.doubts);
        if (left != ConvexShape::kNoFace)
            put_edge(d, row, on_row, xi, index, rows.to[left], rows.right_edge[left], rows.doubts);
    }
}

HWY_INLINE void find_quadric_ends(D d, const ConvexShape& shape, std::size_t row, ConvexLanes& rows) {
    const V zeta = hn::LoadU(d, &rows.zeta[row]), zero = hn::Zero(d);
    const V limb_middle = middle_at(d, shape.limb_chord, zeta), limb_reach = reach_at(d, shape.limb_chord, zeta);
    V from = hn::Sub(limb_middle, limb_reach), to = hn::Add(limb_middle, limb_reach);
    V left_curve = zero, right_curve = zero;
    for (std::size_t i = 0; i < shape.away_count; ++i) {
        const ConvexShape::Plane& plane = shape.away[i];
        const V middle = middle_at(d, plane.chord, zeta), reach = reach_at(d, plane.chord, zeta);
        const V left = hn::Sub(middle, reach), right = hn::Add(middle, reach);
        const V depth = line_at(d, plane.depth.y, plane.depth.z, zeta), slope = hn::Set(d, plane.depth.x);
        hn::StoreU(depth, d, &rows.away_depth[i][row]);
        const hn::Mask<D> on_row = holds(d, plane, zeta);
        const auto seen_at = [&](V xi) HWY_ATTR { return hn::Ge(hn::Add(hn::Mul(slope, xi), depth), zero); };
        const auto ends_left = hn::And(on_row, hn::And(hn::Gt(left, from), seen_at(left)));
        const auto ends_right = hn::And(on_row, hn::And(hn::Lt(right, to), seen_at(right)));
        const V curve = hn::Set(d, static_cast<double>(plane.curve));
        from = hn::IfThenElse(ends_left, left, from), left_curve = hn::IfThenElse(ends_left, curve, left_curve);
        to = hn::IfThenElse(ends_right, right, to), right_curve = hn::IfThenElse(ends_right, curve, right_curve);
    }
    hn::StoreU(from, d, &rows.quadric_from[row]);
    hn::StoreU(to, d, &rows.quadric_to[row]);
    hn::StoreU(left_curve, d, &rows.left_curve[row]);
    hn::StoreU(right_curve, d, &rows.right_curve[row]);
}

void FindLanes(const ConvexShape& shape, ConvexLanes& rows) {
    const D d;
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(d)) {
        find_faces(d, shape, row, rows);
        find_quadric_ends(d, shape, row, rows);
    }
}

/// Other than 0 where a ray meets something else first, or nothing. Comparisons with what is not a number fail.
HWY_INLINE V wrong_rays(D d, const ConvexShape& shape, const ConvexLanes& rows, const ConvexLanes::Ray& ray,
                        std::size_t row) {
    const V zeta = hn::LoadU(d, &rows.zeta[row]), xi = hn::LoadU(d, &ray.xi[row]), zero = hn::Zero(d);
    const Sym3& l = shape.limb;
    const V gamma = hn::Add(hn::Set(d, l.yy), hn::Mul(zeta, line_at(d, 2.0 * l.yz, l.zz, zeta)));
    const V two_beta = line_at(d, 2.0 * l.xy, 2.0 * l.xz, zeta);
    const V limb = hn::Add(hn::Mul(hn::Add(hn::Mul(hn::Set(d, l.xx), xi), two_beta), xi), gamma);
    V depth = hn::LoadU(d, &ray.depth[row]);
    const auto of_quadric = hn::Eq(depth, hn::Set(d, std::numeric_limits<double>::infinity()));
    depth = hn::IfThenElse(of_quadric, hn::Sqrt(hn::Max(limb, zero)), depth);
    auto wrong = hn::Or(hn::And(of_quadric, hn::Le(limb, zero)),
                        hn::And(hn::Not(of_quadric), hn::Gt(hn::Mul(depth, depth), limb)));
    for (std::size_t i = 0; i < shape.facing_count; ++i) {
        const V at_xi = hn::Mul(hn::Set(d, shape.facing[i].depth.x), xi);
        wrong = hn::Or(wrong, hn::Lt(hn::Add(at_xi, hn::LoadU(d, &rows.facing_depth[i][row])), depth));
    }
    for (std::size_t i = 0; i < shape.away_count; ++i) {
        const V at_xi = hn::Mul(hn::Set(d, shape.away[i].depth.x), xi);
        wrong = hn::Or(wrong, hn::Ge(hn::Add(at_xi, hn::LoadU(d, &rows.away_depth[i][row])), depth));
    }
    return hn::IfThenElseZero(wrong, hn::Set(d, 1.0));
}

void CheckRays(const ConvexShape& shape, ConvexLanes& rows) {
    const D d;
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(d)) {
        V wrong = hn::Zero(d);
        for (std::size_t i = 0; i < rows.ray_count; ++i)
            wrong = hn::Add(wrong, wrong_rays(d, shape, rows, rows.rays[i], row));
        hn::StoreU(wrong, d, &rows.wrong_rays[row]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {

HWY_EXPORT(FindLanes);
HWY_EXPORT(CheckRays);

void find_lanes(const ConvexShape& shape, ConvexLanes& rows) { HWY_DYNAMIC_DISPATCH(FindLanes)(shape, rows); }
void check_rays(const ConvexShape& shape, ConvexLanes& rows) { HWY_DYNAMIC_DISPATCH(CheckRays)(shape, rows); }

}  // namespace quadrig
#endif
