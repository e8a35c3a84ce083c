/// [[cluster]] tables of a scene file, and the objects that come of them.
#pragma once

#include "config/texture_section.h"
#include "config/toml_section.h"
#include "ig_core/scene/scene.h"

namespace quadrig::config {

/// Reads the document's clusters and puts their objects behind those that the scene has (ig_core/clusters/generate.h).
/// `names` are the objects' names so far. Throws FileError, also where clusters make more than the limits allow.
void add_clusters(const TomlSection& document, Textures& textures, Names& names, Scene& scene);

}  // namespace quadrig::config
