/// What lies on the ground: runways, painted polygons, light points.
#pragma once

#include "config/texture_section.h"
#include "config/toml_section.h"
#include "ig_core/scene/scene.h"

namespace quadrig::config {

/// Adds [[runway]], [[ground_polygon]] and [[light]] of a scene file, runways first, so that polygons can be laid over
/// them. Throws FileError.
void add_ground_features(const TomlSection& root, Textures& textures, Scene& scene);

}  // namespace quadrig::config
