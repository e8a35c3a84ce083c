/// Rotations that come out the same to the last bit everywhere, which the C library's sine does not promise.
#pragma once

#include <glm/mat3x3.hpp>

#include "ig_core/geometry/space.h"

namespace quadrig::clusters {

/// By additions and multiplications only. Error below 4e-16 for any finite angle of up to 1e6 degrees; exact at
/// multiples of 90.
SineCosine sine_cosine(Degrees angle);

/// eye_from_scene_rotation of those sines and cosines.
glm::dmat3 body_from_scene(const Attitude& attitude);

}  // namespace quadrig::clusters
