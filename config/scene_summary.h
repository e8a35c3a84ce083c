/// A scene in a few lines of text: what `quadrig check` says of one that is in order.
#pragma once

#include <string>

#include "ig_core/scene/scene.h"

namespace quadrig::config {

/// Counts by kind, textures, planes, extents and origin; lines end in '\n'.
std::string summary(const Scene& scene);

}  // namespace quadrig::config
