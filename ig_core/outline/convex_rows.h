/// Rows of an ellipsoid that lies whole in front of the near plane, told from the edges and curves seen on them.
///
/// With w = s/k + v.d for depth, a row is a slice of a convex body (x, w): the quadric is w^2 <= d'Ld, a plane that
/// faces the eye w <= W.d, one that faces away w >= W.d, W = -V/P(eye) with the visibility line V of Eq 12. What is
/// seen is the slice's upper side: a chain of faces with quadric between them. A face ends in its edges on the row, or
/// else where its plane's chord does; beyond that the limb is kept or it is not, and a plane that faces away can end
/// the quadric before the limb does.
#pragma once

#include <array>

#include "ig_core/outline/row_order.h"

namespace quadrig {

class ConvexRows {
  public:
    /// Expects all boundaries and the rows of each curve in place. `outline` has to stay.
    explicit ConvexRows(const Outline& outline);

    /// Tells a row between two key points. False, with `order` undefined, where one ray in the middle of an interval
    /// says otherwise, or where more than one chain may be meant: solve_row then knows.
    bool tell(double zeta, RowOrder& order) const;

  private:
    /// The edges in which a plane's face ends on a row, as indices into Outline::lines.
    struct FaceEdges;
    /// Part of a row, between two boundaries.
    struct Stretch;

    bool find_edges(double zeta, std::array<FaceEdges, kMaxPlanes>& faces) const;
    [[nodiscard]] bool shows(int surface, double xi, double zeta) const;

    const Outline& outline_;
    bool edge_on_ = false;                               // a plane holds the eye: W has no end
    std::array<glm::dvec3, kMaxPlanes> relative_depth_;  // W by plane
};

}  // namespace quadrig
