/// Random scenes and views to compare the image generator with the reference renderer on.
#pragma once

#include "ig_core/view.h"
#include "tests/ig_core/randomness.h"

namespace quadrig::test {

/// `objects` solids of every kind, so close together that they run into one another.
Scene random_scene(Randomness& random, int objects);

/// An eye in or about the scene, above or below the ground, by any attitude (rolls of 90 and 180 degrees among them).
View random_view(Randomness& random, int width, int height);

/// A box whose six faces are cut from a large ball, planes in the order east, west, north, south, up, down.
Object box(const glm::dvec3& low, const glm::dvec3& high);
Object ball(const glm::dvec3& centre, double radius);

inline View look(const glm::dvec3& eye, const Attitude& attitude, int width, int height, double fov) {
    return {{eye}, eye_from_scene_rotation(attitude), ImagePlane::symmetric(width, height, {fov})};
}

}  // namespace quadrig::test
