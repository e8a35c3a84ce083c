/// Objects that move with time, and solids moved rigidly: what drifts, sways, or is placed by somebody else.
///
/// A pose says where a thing's own axes are:  p = position + R' q  for a point q of the thing at rest, R the pose's
/// eye_from_scene. An object's axes at rest are the scene's.
#pragma once

#include "ig_core/scene/scene.h"
#include "ig_core/scene/solid.h"

namespace quadrig {

/// Where a moving object's axes are at a scene time: the scene's for one that does not move.
ScenePose pose_at(const Object& object, double seconds);

/// The scene as it stands at a time, nothing in it moving any more. Textures are not moved (image model: drift).
Scene scene_at(const Scene& scene, double seconds);

/// The solid `at_rest`, its axes where the pose says. A rigid motion turns M, w, the planes' normals and the edges, and
/// carries the anchor along; all else is as it was, so nothing is lost to scene-sized numbers. Allocates nothing once
/// `moved` has held a solid of as many planes and edges.
void move(const Solid& at_rest, const ScenePose& pose, Solid& moved);

}  // namespace quadrig
