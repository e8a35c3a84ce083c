/// The arithmetic of convex_rows.h on some rows at a time, one row a vector lane.
#pragma once

#include <array>
#include <cstdint>

#include "ig_core/outline/image_forms.h"

namespace quadrig {

/// Where a conic holds a row: middle -+ the root of reach2.
struct Chord {
    std::array<double, 2> middle;
    std::array<double, 3> reach2;
};

/// An ellipsoid and the planes that cut it, those that face the eye and those that face away.
struct ConvexShape {
    static constexpr std::size_t kNoFace = kMaxPlanes;
    struct Plane {
        Chord chord;
        double zeta_from, zeta_to;  ///< rows that may show it
        glm::dvec3 depth;           ///< W
        std::uint16_t curve;
        int surface;
    };
    struct Edge {
        double zeta_from, zeta_to;
        std::array<double, 2> xi;
        std::size_t left_face, right_face;  ///< indices into `facing`, or kNoFace
    };
    Chord limb_chord;
    Sym3 limb;
    std::size_t facing_count = 0, away_count = 0, edge_count = 1;
    std::array<Plane, kMaxPlanes> facing, away;
    std::array<Edge, 1 + kMaxPlanes*(kMaxPlanes - 1) / 2> edges;  ///< [0] stands for none
};

inline constexpr std::size_t kRowsTogether = 8;
/// One number for each row.
using RowLanes = std::array<double, kRowsTogether>;

/// What is known of some rows. Indices are doubles, too: lanes have one width.
struct ConvexLanes {
    std::size_t count;  ///< rows that are asked for
    RowLanes zeta;
    std::array<RowLanes, kMaxPlanes> facing_depth, away_depth;  ///< where xi = 0
    /// Of each face; `from` is infinite where it is not seen, an end that does not exist is not a number. Edges are
    /// indices into ConvexShape::edges.
    std::array<RowLanes, kMaxPlanes> from, to, left_edge, right_edge;
    RowLanes doubts;  ///< other than 0 where a face has two edges on one side
    /// Where the quadric's seen side ends but for faces, and on which curves.
    RowLanes quadric_from, quadric_to, left_curve, right_curve;

    /// Rays asked on a row, and the depth of the face that each should meet first; infinite for the quadric, not a
    /// number where there is no ray.
    struct Ray {
        RowLanes xi, depth;
    };
    static constexpr std::size_t kMaxRays = 2 * kMaxPlanes + 1;
    std::size_t ray_count;  ///< on the row that has most
    std::array<Ray, kMaxRays> rays;
    RowLanes wrong_rays;  ///< other than 0 where one meets something else first
};

/// Fills in all but rays, from count and zeta.
void find_lanes(const ConvexShape& shape, ConvexLanes& rows);
/// Fills in wrong_rays.
void check_rays(const ConvexShape& shape, ConvexLanes& rows);

}  // namespace quadrig
