/// Which of two overlapping spans is in front (Gardner 1984, 2.1, interobject visibility).
///
/// The answer is exact: inverse depth is concave along a scan line on every convex object, so a chord of the nearer and
/// the tangents of the farther surface either prove the order over a whole interval, or the interval is halved.
/// Surfaces that cross are cut where they do. DistanceRule::interpolated is the paper's own rule: the distance of an
/// object's span is linear between its ends, so two spans cross once at most.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ig_core/spans/depth_on_line.h"

namespace quadrig {

enum class Priority { front, behind, crossing };

/// Depths that differ by less than this share are the same: faces in one plane are in file order.
inline constexpr double kSameDepth = 1e-13;

/// What most orders can be told by: bounds of 1/k, and the object.
struct DepthBounds {
    double beyond_near_u;  ///< what is nearer than this is in front, by more than rounding
    double far_u;
    const Outline* outline;
};
inline DepthBounds depth_bounds(const Surface& surface) {
    return {(1.0 + kSameDepth) * surface.near_u, surface.far_u, surface.outline};
}

/// Order of one surface relative to another where that tells.
inline std::optional<Priority> order_by_bounds(const DepthBounds& a, const DepthBounds& b) {
    if (a.far_u > b.beyond_near_u) return Priority::front;
    if (b.far_u > a.beyond_near_u) return Priority::behind;
    if (a.outline != nullptr && a.outline == b.outline) return Priority::front;  // they lie side by side
    return std::nullopt;
}

/// Whether both spans cover part of some sub-scan line, by more than rounding where they abut.
bool overlap(const RowSpan& a, const RowSpan& b, const PixelRow& row);

/// Pieces of a span that crosses another one: even ones lie in front of it, odd ones behind; on each sub-scan line they
/// follow one another from left to right.
inline constexpr std::size_t kMaxPieces = 6;
using CrossingPieces = std::array<RowSpan, kMaxPieces>;

/// 1/k of a row's spans on their sub-scan lines, worked out when first asked for: in a wood a span meets many others.
class RowDepths {
  public:
    /// Forgets the last row's; `row` has to live until the next start.
    void start(const PixelRow& row);
    /// Place of a span's first lines. Its pieces share it.
    std::size_t place_of(RowSpan& span);
    /// On a line and the next, twice the last where that is one too many; `line` is even. Valid until another span's
    /// place is asked for.
    [[nodiscard]] const DepthOnTwoLines& at(std::size_t place, std::size_t line) const {
        return depths_[place + line / 2];
    }

  private:
    const PixelRow* row_ = nullptr;
    std::vector<DepthOnTwoLines> depths_;
};

/// Order of span `a` relative to `b` wherever both cover a sub-scan line (at column centres, if the row takes point
/// samples). Ties go to the smaller Surface::priority. If they cross, `pieces` receives the parts of `a`, columns not
/// yet fitted.
Priority priority_of(RowSpan& a, RowSpan& b, const PixelRow& row, RowDepths& depths, CrossingPieces& pieces);

/// Parts span `a`, which lies in front of `x` and behind `y` where it meets them, from what meets `x` alone (pieces[0])
/// to what meets `y` (pieces[1]). False, and no pieces, if it has been cut too often.
bool part_between(const RowSpan& a, const RowSpan& x, const RowSpan& y, const PixelRow& row, CrossingPieces& pieces);

}  // namespace quadrig
