/// Where to look at a solid from.
#pragma once

#include <optional>

#include "ig_core/scene/solid.h"

namespace quadrig {

/// The eye point from which an eye of the given attitude sees a solid whole, in the middle of its picture, as large as
/// fits within |x| <= x_reach and |z| <= z_reach (image plane at distance 1): there a box about the solid, as deep as
/// the solid is, fits. Nothing where a solid has no end, or none that is found from up to 1e12 m away, or is too thin
/// to be seen.
std::optional<ScenePoint> eye_that_frames(const Solid& solid, const glm::dmat3& eye_from_scene, double x_reach,
                                          double z_reach);

}  // namespace quadrig
