/// Models: objects given in axes of their own (X right, Y forward, Z up), set down somewhere in the scene.
#pragma once

#include <optional>

#include "ig_core/scene/scene.h"

namespace quadrig {

/// The object where its model is: p = position + R' q for a point q of the model, R the pose's eye_from_scene. A
/// general quadric's coefficients are computed in 64-bit mantissa and rounded once, so its surface moves by less than
/// 1e-15 |position|^2 / size. No value for a hill, which stands upright by definition.
std::optional<Object> placed(const Object& object, const ScenePose& pose);

}  // namespace quadrig
