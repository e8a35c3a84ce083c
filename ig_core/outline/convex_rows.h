/// Rows of an ellipsoid that lies whole in front of the near plane, told from the edges and curves seen on them.
///
/// With w = s/k + v.d for depth, a row is a slice of a convex body (x, w): the quadric is w^2 <= d'Ld, a plane that
/// faces the eye w <= W.d, one that faces away w >= W.d, W = -V/P(eye) with the visibility line V of Eq 12. What is
/// seen is the slice's upper side: a chain of faces with quadric between them. A face ends in its edges on the row, or
/// else where its plane's chord does; beyond that the limb is kept or it is not, and a plane that faces away can end
/// the quadric before the limb does.
///
/// Objects differ and no branch is foreseen: the loops choose values rather than ways.
#pragma once

#include <array>

#include "ig_core/outline/row_order.h"

namespace quadrig {

class ConvexRows {
  public:
    /// Expects all boundaries and the rows of each curve in place. Of the outline nothing is kept.
    explicit ConvexRows(const Outline& outline);

    /// Tells a row between two key points; nothing is on one that the limb does not reach. False, with `order`
    /// undefined, where one ray in the middle of an interval says otherwise, or where more than one chain may be meant:
    /// solve_row then knows.
    bool tell(double zeta, RowOrder& order) const;

  private:
    /// Where a conic holds a row: middle -+ the root of reach2.
    struct Chord {
        explicit Chord(const RowConic& conic);
        Chord() = default;
        std::array<double, 2> middle;
        std::array<double, 3> reach2;
        [[nodiscard]] double middle_at(double zeta) const { return middle[0] + zeta * middle[1]; }
        [[nodiscard]] double reach2_at(double zeta) const { return reach2[0] + zeta * (reach2[1] + zeta * reach2[2]); }
    };
    struct Plane {
        Chord chord;
        double zeta_from, zeta_to;  // rows that may show it
        glm::dvec3 depth;           // W
        std::uint16_t curve;
        int surface;
        [[nodiscard]] double depth_at(double xi, double zeta) const { return depth.x * xi + depth.y + depth.z * zeta; }
    };
    using Planes = std::array<Plane, kMaxPlanes>;
    struct Edge {
        double zeta_from, zeta_to;
        std::array<double, 2> xi;
        std::uint8_t left_face, right_face;  // indices into facing_, or kNoFace
        [[nodiscard]] double xi_at(double zeta) const { return xi[0] + zeta * xi[1]; }
    };
    /// The part of a row on which a face is seen.
    struct Stretch {
        double from, to;
        std::uint8_t face, left_edge, right_edge;
        bool bare_left, bare_right;  // nothing is seen beyond that end
    };
    struct Faces {
        std::size_t count;
        std::array<Stretch, kMaxPlanes> stretches;
    };
    struct Ends {
        double from, to;
        Boundary left, right;
    };

    static constexpr std::uint8_t kNoFace = kMaxPlanes;
    static constexpr int kQuadric = -1;
    /// From left to right. False where edges or chords leave a doubt.
    bool find_faces(double zeta, Faces& faces) const;
    /// Where the quadric's seen side ends but for faces.
    [[nodiscard]] Ends quadric_ends(double zeta, double limb_reach2) const;
    /// Whether a ray meets that face, or the quadric, first.
    [[nodiscard]] bool shows(int face, double xi, double zeta) const;

    Chord limb_chord_;
    Sym3 limb_;
    std::size_t facing_count_ = 0, away_count_ = 0, edge_count_ = 1;
    Planes facing_, away_;
    std::array<Edge, 1 + kMaxPlanes*(kMaxPlanes - 1) / 2> edges_;  // [0] stands for none
    bool edge_on_ = false;                                         // a plane holds the eye: W has no end
};

}  // namespace quadrig
