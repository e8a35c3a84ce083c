#include "ig_core/outline/boundary_lanes.h"

#include <limits>

#include "ig_core/outline/row_order.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/outline/boundary_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ig_core/outline/image_forms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {

HWY_INLINE Number intercept(const Outline& outline, const Boundary& boundary, Number zeta) {
    switch (boundary.kind) {
        case Boundary::Kind::rising:
        case Boundary::Kind::falling:
            return root_on_row(outline.curves[boundary.index], boundary.kind == Boundary::Kind::rising, zeta);
        case Boundary::Kind::line: {
            const glm::dvec3& line = outline.lines[boundary.index].line;
            return -(line.y + line.z * zeta) / line.x;
        }
        case Boundary::Kind::left_end:
            return -std::numeric_limits<double>::infinity();
        case Boundary::Kind::right_end:
            break;
    }
    return std::numeric_limits<double>::infinity();
}

double Intercept(const Outline& outline, const Boundary& boundary, double zeta) {
    return hn::GetLane(intercept(outline, boundary, Number(zeta)).v);
}

RowRoots RootsOnSolid(const Outline& outline, std::size_t curve, const EyePlane* plane, double zeta) {
    const EyeSolid& e = outline.solid;
    const Number own_plane = plane != nullptr ? static_cast<double>(plane - e.planes.data()) : kNoPlane;
    // Of the point at k = over/under on a ray nothing is known where `under` is little more than rounding.
    const double unknown = outline.direct ? std::numeric_limits<double>::infinity() : 1e-8;
    std::array<double, 8> roots;  // a lane each; the others are not asked for
    for (std::size_t at = 0; at < 2; at += hn::Lanes(D())) {
        const Mask is_first = Number(hn::Iota(D(), static_cast<double>(at))) == 0.0;
        const Number xi = either(is_first, root_on_row(outline.curves[curve], true, zeta),
                                 root_on_row(outline.curves[curve], false, zeta));
        const Vector ray(xi, 1.0, zeta);
        const Number over = plane != nullptr ? -plane->at_eye : -dot(e.v, ray);
        const Number under = plane != nullptr ? dot(plane->normal, ray) : value(e.m, ray);
        const Number k = over / under;
        const Mask kept = hn::And(k > 0.0, kept_by_planes(e, k * ray, own_plane));
        const Mask known = magnitude(under) > unknown * dot(ray, ray);
        either(hn::AndNot(kept, known), std::numeric_limits<double>::quiet_NaN(), xi).store(roots, at);
    }
    return {roots[0], roots[1]};
}

/// Gives each of a band's changes to `take(index, xi)`, none left of the one before; whether its order holds.
template <class Take>
HWY_INLINE Mask follow_changes(const Outline& outline, const ZBand& band, Number zeta, const Take& take) {
    Number left = -std::numeric_limits<double>::infinity();
    Mask in_order = left == left;
    for (std::uint32_t i = 0; i < band.count; ++i) {
        const Number xi = intercept(outline, outline.changes[band.first + i].boundary, zeta);
        in_order = hn::And(in_order, xi >= left - kDisorder);
        left = either(xi >= left, xi, left);
        take(i, left);
    }
    return in_order;
}

void BoundariesOnLines(const Outline& outline, const ZBand& band, const ColumnScale& scale, BoundaryLanes& lines) {
    const Number x0 = outline.solid.x0, origin = scale.left, step = scale.columns_per_x;
    bool all_hold = true;
    for (std::size_t line = 0; line < lines.count; line += hn::Lanes(D())) {
        const auto take = [&](std::uint32_t i, Number xi)
                              HWY_ATTR { ((x0 + xi - origin) * step).store(lines.columns[i], line); };
        const Mask in_order = follow_changes(outline, band, {lines.zeta, line}, take);
        either(in_order, 0.0, 1.0).store(lines.wrong, line);
        all_hold &= hn::AllTrue(D(), hn::Or(in_order, hn::Not(hn::FirstN(D(), lines.count - line))));
    }
    lines.all_hold = all_hold;
}

bool BoundariesOnLine(const Outline& outline, const ZBand& band, double zeta, double* xi) {
    const auto take = [&](std::uint32_t i, Number here) HWY_ATTR { xi[i] = hn::GetLane(here.v); };
    return hn::AllTrue(D(), follow_changes(outline, band, zeta, take));
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {

HWY_EXPORT(Intercept);
HWY_EXPORT(RootsOnSolid);
HWY_EXPORT(BoundariesOnLines);
HWY_EXPORT(BoundariesOnLine);

double intercept(const Outline& outline, const Boundary& boundary, double zeta) {
    return HWY_DYNAMIC_DISPATCH(Intercept)(outline, boundary, zeta);
}
RowRoots roots_on_solid(const Outline& outline, std::size_t curve, const EyePlane* plane, double zeta) {
    return HWY_DYNAMIC_DISPATCH(RootsOnSolid)(outline, curve, plane, zeta);
}
void boundaries_on_lines(const Outline& outline, const ZBand& band, const ColumnScale& scale, BoundaryLanes& lines) {
    if (lines.columns.size() < band.count) lines.columns.resize(band.count);
    HWY_DYNAMIC_DISPATCH(BoundariesOnLines)(outline, band, scale, lines);
}
bool boundaries_on_line(const Outline& outline, const ZBand& band, double zeta, double* xi) {
    return HWY_DYNAMIC_DISPATCH(BoundariesOnLine)(outline, band, zeta, xi);
}

}  // namespace quadrig
#endif
