/// Which of two overlapping spans is in front (Gardner 1984, 2.1, interobject visibility).
///
/// The answer is exact: inverse depth is concave along a scan line on every convex object, so a chord of the nearer and
/// the tangents of the farther surface either prove the order over a whole interval, or the interval is halved.
/// Surfaces that cross are cut where they do. DistanceRule::interpolated is the paper's own rule: the distance of an
/// object's span is linear between its ends, so two spans cross once at most.
#pragma once

#include <array>

#include "ig_core/spans/row_span.h"

namespace quadrig {

enum class Priority { front, behind, crossing };

/// Pieces of a span that crosses another one: even ones lie in front of it, odd ones behind; on each sub-scan line they
/// follow one another from left to right.
inline constexpr std::size_t kMaxPieces = 6;
using CrossingPieces = std::array<RowSpan, kMaxPieces>;

/// Order of span `a` relative to `b` wherever both cover a sub-scan line (at column centres, if the row takes point
/// samples). Ties go to the smaller Surface::priority. If they cross, `pieces` receives the parts of `a`, columns not
/// yet fitted.
Priority priority_of(const RowSpan& a, const RowSpan& b, const PixelRow& row, CrossingPieces& pieces);

}  // namespace quadrig
