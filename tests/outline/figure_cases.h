/// Solids, eyes and windows whose figures are looked at.
#pragma once

#include "ig_core/outline/figure.h"
#include "tests/ig_core/random_objects.h"

namespace quadrig::test {

struct Case {
    Object object;
    ScenePoint eye;
    glm::dmat3 eye_from_scene;
    ImageWindow window;
};

/// Upright, four by three.
ImageWindow window_of(double half_width);

/// A solid with a curved quadric, about the line of sight, from near to far.
Case random_case(Randomness& random, bool capped = true);

Object sphere_with_six_planes();
/// From where the figure in the documentation is drawn.
Case documented_case();

Figure figure_of(const Case& given);

/// How far an image point is from the nearest of the chords.
double distance_from(const glm::dvec2& p, const std::vector<Polyline>& pieces);

}  // namespace quadrig::test
