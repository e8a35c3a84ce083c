#include "ig_core/outline/row_lanes.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/outline/row_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ig_core/outline/image_forms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {

struct Ends {
    Number left, right;
};
HWY_INLINE Ends ends_of(const Chord& chord, Number zeta) {
    const Number middle = polynomial(chord.middle, zeta), reach = square_root(polynomial(chord.reach2, zeta));
    return {middle - reach, middle + reach};
}
/// W.d where xi = 0.
HWY_INLINE Number depth_at(const ConvexShape::Plane& plane, Number zeta) {
    return plane.depth.y + plane.depth.z * zeta;
}
template <class Range>
HWY_INLINE Mask holds(const Range& range, Number zeta) {
    return hn::And(zeta >= range.zeta_from, zeta <= range.zeta_to);
}

/// An edge's place on the rows that it is on, as the end of a face, and its index.
HWY_INLINE void put_edge(std::size_t row, Mask on_row, Number xi, Number index, RowLanes& ends, RowLanes& edges,
                         RowLanes& doubts) {
    const Number known(edges, row);
    (Number(doubts, row) + either(on_row, known, 0.0)).store(doubts, row);
    either(on_row, index, known).store(edges, row);
    either(on_row, xi, {ends, row}).store(ends, row);
}

HWY_INLINE void find_faces(const ConvexShape& shape, std::size_t row, ConvexLanes& rows) {
    const Number zeta(rows.zeta, row), none = 0.0;
    none.store(rows.doubts, row);
    for (std::size_t i = 0; i < shape.facing_count; ++i) {
        const ConvexShape::Plane& plane = shape.facing[i];
        const Ends chord = ends_of(plane.chord, zeta);
        depth_at(plane, zeta).store(rows.facing_depth[i], row);
        either(holds(plane, zeta), chord.left, std::numeric_limits<double>::infinity()).store(rows.from[i], row);
        chord.right.store(rows.to[i], row);
        none.store(rows.left_edge[i], row);
        none.store(rows.right_edge[i], row);
    }
    for (std::size_t i = 1; i < shape.edge_count; ++i) {
        const ConvexShape::Edge& edge = shape.edges[i];
        const Mask on_row = holds(edge, zeta);
        const Number xi = polynomial(edge.xi, zeta), index = static_cast<double>(i);
        const std::size_t right = edge.right_face, left = edge.left_face;
        if (right != ConvexShape::kNoFace)
            put_edge(row, on_row, xi, index, rows.from[right], rows.left_edge[right], rows.doubts);
        if (left != ConvexShape::kNoFace)
            put_edge(row, on_row, xi, index, rows.to[left], rows.right_edge[left], rows.doubts);
    }
}

HWY_INLINE void find_quadric_ends(const ConvexShape& shape, std::size_t row, ConvexLanes& rows) {
    const Number zeta(rows.zeta, row);
    auto [from, to] = ends_of(shape.limb_chord, zeta);
    Number left_curve = 0.0, right_curve = 0.0;
    for (std::size_t i = 0; i < shape.away_count; ++i) {
        const ConvexShape::Plane& plane = shape.away[i];
        const auto [left, right] = ends_of(plane.chord, zeta);
        const Number depth = depth_at(plane, zeta);
        depth.store(rows.away_depth[i], row);
        const Mask on_row = holds(plane, zeta);
        const Mask ends_left = hn::And(on_row, hn::And(left > from, plane.depth.x * left + depth >= 0.0));
        const Mask ends_right = hn::And(on_row, hn::And(right < to, plane.depth.x * right + depth >= 0.0));
        const Number curve = static_cast<double>(plane.curve);
        from = either(ends_left, left, from), left_curve = either(ends_left, curve, left_curve);
        to = either(ends_right, right, to), right_curve = either(ends_right, curve, right_curve);
    }
    from.store(rows.quadric_from, row);
    to.store(rows.quadric_to, row);
    left_curve.store(rows.left_curve, row);
    right_curve.store(rows.right_curve, row);
}

void FindLanes(const ConvexShape& shape, ConvexLanes& rows) {
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(D())) {
        find_faces(shape, row, rows);
        find_quadric_ends(shape, row, rows);
    }
}

/// Whether a ray meets something else first, or nothing. Comparisons with what is not a number fail; a face's own depth
/// comes out as ConvexRows has it, to the bit.
HWY_INLINE Mask is_wrong(const ConvexShape& shape, const ConvexLanes& rows, const ConvexLanes::Ray& ray,
                         std::size_t row) {
    const Number zeta(rows.zeta, row), xi(ray.xi, row), expected(ray.depth, row);
    const Sym3& l = shape.limb;
    const Number gamma = l.yy + zeta * (2.0 * l.yz + l.zz * zeta), two_beta = 2.0 * l.xy + 2.0 * l.xz * zeta;
    const Number limb = (l.xx * xi + two_beta) * xi + gamma;
    const Mask of_quadric = expected == std::numeric_limits<double>::infinity();
    const Number depth = either(of_quadric, square_root(larger(limb, 0.0)), expected);
    Mask wrong = hn::Or(hn::And(of_quadric, limb <= 0.0), hn::And(hn::Not(of_quadric), depth * depth > limb));
    for (std::size_t i = 0; i < shape.facing_count; ++i)
        wrong = hn::Or(wrong, shape.facing[i].depth.x * xi + Number(rows.facing_depth[i], row) < depth);
    for (std::size_t i = 0; i < shape.away_count; ++i)
        wrong = hn::Or(wrong, shape.away[i].depth.x * xi + Number(rows.away_depth[i], row) >= depth);
    return wrong;
}

void CheckRays(const ConvexShape& shape, ConvexLanes& rows) {
    for (std::size_t row = 0; row < rows.count; row += hn::Lanes(D())) {
        Number wrong = 0.0;
        for (std::size_t i = 0; i < rows.ray_count; ++i)
            wrong = either(is_wrong(shape, rows, rows.rays[i], row), 1.0, wrong);
        wrong.store(rows.wrong_rays, row);
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
