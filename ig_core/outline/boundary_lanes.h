/// Where an outline's boundaries cross scan lines: one of them on one line, or those of a z-band on some lines at a
/// time, one line a vector lane.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ig_core/outline/outline.h"

namespace quadrig {

/// Where a boundary crosses the row zeta: xi, infinite at the ends of a row, infinite or NaN where there is none. A
/// discriminant below zero counts as zero: rows just outside a curve touch it.
double intercept(const Outline& outline, const Boundary& boundary, double zeta);

/// Where a curve crosses the row zeta (`rising`, where its form goes from negative to positive with xi), if that is on
/// the solid as far as can be told (of a solid without end, everywhere); NaN or infinite otherwise. `plane` is the
/// curve's, null for the limb.
struct RowRoots {
    double rising, falling;
};
RowRoots roots_on_solid(const Outline& outline, std::size_t curve, const EyePlane* plane, double zeta);

/// Image-plane x to columns: (x - left) * columns_per_x.
struct ColumnScale {
    double left = 0, columns_per_x = 1;
};

struct BoundaryLanes {
    static constexpr std::size_t kMaxLines = 64;
    using Lines = std::array<double, kMaxLines>;  ///< one number for each line

    std::size_t count = 0;  ///< lines that are asked for
    Lines zeta;
    std::vector<Lines> columns;  ///< where each of the band's changes is; none lies left of the one before
    bool all_hold = true;        ///< whether the band's order holds on all lines, as it does but for rounding
    Lines wrong;                 ///< else other than 0 where it does not: to be solved by itself

    BoundaryLanes() {}  // NOLINT(modernize-use-equals-default): what is not asked for need not be zeroed
};

/// Fills in columns, all_hold and wrong, from count and zeta; all lines lie in `band`.
void boundaries_on_lines(const Outline& outline, const ZBand& band, const ColumnScale& scale, BoundaryLanes& lines);

/// The same of one line, in xi: whether the band's order holds on it. Room for band.count.
bool boundaries_on_line(const Outline& outline, const ZBand& band, double zeta, double* xi);

}  // namespace quadrig
