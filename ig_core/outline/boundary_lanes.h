/// The boundaries of a z-band on some scan lines at a time, one line a vector lane: the arithmetic of cuts_by_band, bit
/// for bit.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ig_core/outline/outline.h"

namespace quadrig {

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
    Lines wrong;                 ///< other than 0 where the band's order does not hold: to be solved by itself

    BoundaryLanes() {}  // NOLINT(modernize-use-equals-default): what is not asked for need not be zeroed
};

/// Fills in columns and wrong, from count and zeta; all lines lie in `band`.
void boundaries_on_lines(const Outline& outline, const ZBand& band, const ColumnScale& scale, BoundaryLanes& lines);

}  // namespace quadrig
