/// Scene files (config/scenes/*.toml): the format is in config/README.md.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "config/file_error.h"
#include "ig_core/scene/scene.h"

namespace quadrig::config {

/// Reads a scene. An empty file is an empty scene: sky only. Throws FileError at the first mistake: not TOML, an
/// unknown or missing key, a wrong type, a number that is not finite or out of range, a texture that is not there, a
/// name given twice, an object of no shape, of two, or whose solid is not convex.
Scene read_scene(const std::filesystem::path& file);

/// Writes a scene so that read_scene gives back the same values, bit for bit. The scene must be one that read_scene
/// accepts.
void write_scene(const Scene& scene, std::ostream& out);

}  // namespace quadrig::config
