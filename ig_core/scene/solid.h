/// One object's geometry made ready for drawing: quadric and planes about an anchor of the object's own, in scene axes.
///
///   Q(p) = q' M q + 2 w.q + c,  P_j(p) = n_j.q + offset_j,  q = p - anchor          (Gardner 1984, Eq 1, 2, 9)
///
/// Inside is Q <= 0 and every P_j > 0; gradients point out of the quadric and into the kept side of a plane. The anchor
/// is the quadric's centre where it has one (a steep hill's apex), so w is nothing but the centre's rounding and no
/// scene-sized number is left in M, w, c. All is computed from the file's numbers in 113-bit arithmetic and rounded
/// once, to double; M's largest entry is scaled to about 1 (a quadric means the same up to a positive factor).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ig_core/geometry/symmetric.h"
#include "ig_core/scene/scene.h"

namespace quadrig {

/// A half-space that bounds a solid. Surface j > 0 is the j-th plane of the file; 0 is the half-space that picks the
/// sheet of a hill: it lies clear of the solid, so it has no face and cuts nothing.
struct SolidPlane {
    glm::dvec3 normal{0.0};  ///< unit length
    double offset = 0.0;     ///< m, at the anchor
    int surface = 0;
};

/// An end of edges: where three planes meet on the solid, or two and the quadric.
struct SolidVertex {
    glm::dvec3 at{0.0};                    ///< about the anchor
    std::array<std::uint8_t, 3> planes{};  ///< rising indices into Solid::planes; the last is kNoPlane on the quadric
    static constexpr std::uint8_t kNoPlane = 255;
};

/// An edge: the part that lies on the solid of the line in which two of its planes meet.
struct SolidEdge {
    std::uint8_t from = 0, to = 0;            ///< indices into Solid::vertices
    std::uint8_t plane = 0, other_plane = 0;  ///< indices into Solid::planes
};

struct Solid {
    ScenePoint anchor;
    Sym3 m;
    Sym3 adjugate;  ///< adj(M), exact also for needles and pancakes
    double determinant = 0.0;
    glm::dvec3 w{0.0};
    double c = 0.0;
    /// |Q(centre)| for the limb function (image model: g), 0 for a quadric without a centre or through its own.
    double centre_value = 0.0;
    std::vector<SolidPlane> planes;
    std::vector<SolidEdge> edges;  ///< of a solid that has an end
    std::vector<SolidVertex> vertices;
    /// The planes that the quadric consists of, if it is a half-space or the space between two parallel planes. Kept
    /// side positive, as a bounding plane's.
    std::vector<SolidPlane> flat_sides;
    /// Unit direction u with M u = 0, if there is one: the axis of a cylinder or paraboloid. From an anchor moved by
    /// t u, M and w are the same, and c is 2 t w.u more.
    glm::dvec3 axis{0.0};
    bool ellipsoid = false;      ///< M positive definite: bounded by itself
    bool may_be_endless = true;  ///< false where quadric and planes are known to enclose a finite volume
    double radius = 0.0;         ///< m, sphere about the anchor that holds the solid; infinity where none is known
    /// Q and P_j at a scene point in extended precision: what cancels when the eye is close to a surface.
    [[nodiscard]] double quadric_at(const ScenePoint& p) const;
    [[nodiscard]] double plane_at(const SolidPlane& plane, const ScenePoint& p) const;
};

/// Builds the solid of an object. Never fails: a degenerate quadric gives a solid that draws nothing or little.
Solid make_solid(const Object& object);

}  // namespace quadrig
