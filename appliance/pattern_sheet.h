/// A page on which every texture pattern is seen on a plane, a hill and an ellipsoid, each from three distances.
#pragma once

#include <span>

#include "display/picture.h"
#include "ig_core/scene/scene.h"

namespace quadrig::appliance {

/// One row of nine pictures a pattern. Things are of the size of the pattern's longest wave, and the eye is 2.5, 6 and
/// 15 of them away. `seconds` is scene time.
display::Picture pattern_sheet(std::span<const Texture> patterns, double seconds);

}  // namespace quadrig::appliance
