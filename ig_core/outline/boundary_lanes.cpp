#include "ig_core/outline/boundary_lanes.h"

#include <limits>

#include "ig_core/outline/row_order.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/outline/boundary_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;

/// Products and sums are rounded apart, and in the order of RowConic's own.
HWY_INLINE V line_at(D d, double constant, double slope, V zeta) {
    return hn::Add(hn::Set(d, constant), hn::Mul(zeta, hn::Set(d, slope)));
}
HWY_INLINE V parabola_at(D d, const std::array<double, 3>& c, V zeta) {
    return hn::Add(hn::Set(d, c[0]), hn::Mul(zeta, line_at(d, c[1], c[2], zeta)));
}

/// root_on_row.
HWY_INLINE V root_at(D d, const RowConic& conic, bool rising, V zeta) {
    const V zero = hn::Zero(d), discriminant = parabola_at(d, conic.discriminant, zeta);
    const V root = hn::Sqrt(hn::IfThenElseZero(hn::Gt(discriminant, zero), discriminant));
    const V beta = line_at(d, conic.beta[0], conic.beta[1], zeta);
    const V sum = hn::CopySign(hn::Add(root, hn::Abs(beta)), hn::Sub(zero, beta));
    const auto left_of_axis = hn::Le(beta, zero);
    const auto by_alpha = hn::Or(rising ? left_of_axis : hn::Not(left_of_axis), hn::Eq(root, zero));
    return hn::Div(hn::IfThenElse(by_alpha, sum, parabola_at(d, conic.gamma, zeta)),
                   hn::IfThenElse(by_alpha, hn::Set(d, conic.alpha), sum));
}

/// intercept.
HWY_INLINE V intercept_at(D d, const Outline& outline, const Boundary& boundary, V zeta) {
    switch (boundary.kind) {
        case Boundary::Kind::rising:
        case Boundary::Kind::falling:
            return root_at(d, outline.curves[boundary.index], boundary.kind == Boundary::Kind::rising, zeta);
        case Boundary::Kind::line: {
            const glm::dvec3& line = outline.lines[boundary.index].line;
            return hn::Div(hn::Neg(line_at(d, line.y, line.z, zeta)), hn::Set(d, line.x));
        }
        case Boundary::Kind::left_end:
            return hn::Set(d, -std::numeric_limits<double>::infinity());
        case Boundary::Kind::right_end:
            break;
    }
    return hn::Set(d, std::numeric_limits<double>::infinity());
}

void BoundariesOnLines(const Outline& outline, const ZBand& band, const ColumnScale& scale, BoundaryLanes& lines) {
    const D d;
    const V x0 = hn::Set(d, outline.solid.x0), origin = hn::Set(d, scale.left), step = hn::Set(d, scale.columns_per_x);
    for (std::size_t line = 0; line < lines.count; line += hn::Lanes(d)) {
        const V zeta = hn::LoadU(d, &lines.zeta[line]);
        V left = hn::Set(d, -std::numeric_limits<double>::infinity());
        auto in_order = hn::Eq(left, left);
        for (std::uint32_t i = 0; i < band.count; ++i) {
            const V xi = intercept_at(d, outline, outline.changes[band.first + i].boundary, zeta);
            in_order = hn::And(in_order, hn::Ge(xi, hn::Sub(left, hn::Set(d, kDisorder))));
            left = hn::IfThenElse(hn::Ge(xi, left), xi, left);
            hn::StoreU(hn::Mul(hn::Sub(hn::Add(x0, left), origin), step), d, &lines.columns[i][line]);
        }
        hn::StoreU(hn::IfThenElseZero(hn::Not(in_order), hn::Set(d, 1.0)), d, &lines.wrong[line]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {

HWY_EXPORT(BoundariesOnLines);

void boundaries_on_lines(const Outline& outline, const ZBand& band, const ColumnScale& scale, BoundaryLanes& lines) {
    if (lines.columns.size() < band.count) lines.columns.resize(band.count);
    HWY_DYNAMIC_DISPATCH(BoundariesOnLines)(outline, band, scale, lines);
}

}  // namespace quadrig
#endif
