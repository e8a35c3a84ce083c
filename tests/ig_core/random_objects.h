/// Random convex solids of every kind that a scene file can hold, about a given place.
#pragma once

#include "ig_core/scene/scene.h"
#include "tests/ig_core/randomness.h"

namespace quadrig::test {

enum class Kind {
    ellipsoid,
    hill,
    elliptic_cylinder,
    cone,
    two_sheets,
    paraboloid,
    parabolic_cylinder,
    hyperbolic_cylinder,
    slab,
    wedge,
    half_space,
    polyhedron
};
inline constexpr int kKinds = 12;
/// Solids whose quadric part has rank 2 with a negative eigenvalue, or rank 1: pairs of planes and the like.
inline bool is_degenerate(Kind kind) {
    return kind == Kind::parabolic_cylinder || kind == Kind::hyperbolic_cylinder || kind == Kind::slab ||
           kind == Kind::wedge || kind == Kind::half_space || kind == Kind::polyhedron;
}

/// A solid of about `size` metres about `centre`. Its own caps (hill's base, cylinder's ends...) come with `capped`;
/// without them its axes lie along the scene's, where its coefficients are exact. `planes` more cut it near the centre.
Object random_object(Randomness& random, Kind kind, const glm::dvec3& centre, double size, bool capped, int planes);

/// Half of all are ellipsoids and hills, the rest of any kind.
Kind random_kind(Randomness& random);

/// Capped nine times in ten, with 0 to kMaxPlanes planes, mostly few.
Object random_object(Randomness& random, Kind kind, const glm::dvec3& centre, double size);

/// A ball of radius 1, 10 m north of the origin, cut by the faces of a cube at `distance` from its centre.
Object cut_ball(double distance);

}  // namespace quadrig::test
