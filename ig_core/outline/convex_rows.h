/// Rows of an ellipsoid that lies whole in front of the near plane, told from the edges and curves seen on them.
///
/// With w = s/k + v.d for depth, a row is a slice of a convex body (x, w): the quadric is w^2 <= d'Ld, a plane that
/// faces the eye w <= W.d, one that faces away w >= W.d, W = -V/P(eye) with the visibility line V of Eq 12. What is
/// seen is the slice's upper side: a chain of faces with quadric between them. A face ends in its edges on the row, or
/// else where its plane's chord does; beyond that the limb is kept or it is not, and a plane that faces away can end
/// the quadric before the limb does.
///
/// Objects differ and no branch is foreseen: what can be chosen by value is, for some rows at a time (row_lanes.h);
/// only the chain itself goes row by row.
#pragma once

#include <array>
#include <span>

#include "ig_core/outline/row_lanes.h"
#include "ig_core/outline/row_order.h"

namespace quadrig {

class ConvexRows {
  public:
    struct Told {
        std::array<RowOrder, kRowsTogether> orders;
        std::array<bool, kRowsTogether> sure;
    };

    /// Expects all boundaries and the rows of each curve in place. Of the outline nothing is kept.
    explicit ConvexRows(const Outline& outline);

    /// Tells rows on which the solid is, at most kRowsTogether. Not sure, with the order undefined, where one ray in
    /// the middle of an interval says otherwise, or where more than one chain may be meant: solve_row then knows.
    void tell(std::span<const double> zeta, Told& told) const;

  private:
    /// The chain of one row, whose rays are yet to be checked. False where there is more than one, or none.
    bool find_chain(ConvexLanes& rows, std::size_t row, RowOrder& order) const;

    ConvexShape shape_;
    bool edge_on_ = false;  // a plane holds the eye: W has no end
};

}  // namespace quadrig
