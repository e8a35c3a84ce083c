/// Objects and their paint as tables of a scene file, and what their numbers may be.
#pragma once

#include "config/place_section.h"
#include "config/texture_section.h"
#include "config/toml_section.h"
#include "ig_core/scene/scene.h"

namespace quadrig::config {

inline constexpr NumberRule kLength{"metres in 1e-6..1e9", [](double x) { return x >= 1e-6 && x <= 1e9; }};
inline constexpr NumberRule kSlope{"a slope in 1e-6..1e6", [](double x) { return x >= 1e-6 && x <= 1e6; }};
inline constexpr NumberRule kCoefficient{"a coefficient in -1e60..1e60",
                                         [](double x) { return x >= -1e60 && x <= 1e60; }};
inline constexpr NumberRule kColour{"linear light in 0..1", kFraction.holds};

/// Paint of the ground, a cloud deck or an object. Throws FileError.
Paint read_paint(const TomlSection& section, Textures& textures);

/// Shape, planes and paint of an object, without its name. Throws FileError, also where its solid is not convex.
Object read_object(const TomlSection& section, Textures& textures);

}  // namespace quadrig::config
