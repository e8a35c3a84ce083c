/// Where things are and how they are turned, as files say it.
#pragma once

#include "config/toml_section.h"
#include "ig_core/geometry/space.h"

namespace quadrig::config {

// Far beyond any scene, near enough that squares of products stay finite in a double.
inline constexpr NumberRule kCoordinate{"metres in -1e9..1e9", [](double x) { return x >= -1e9 && x <= 1e9; }};
inline constexpr NumberRule kTurn{"degrees in -360..360", [](double x) { return x >= -360.0 && x <= 360.0; }};

/// A table of `latitude` and `longitude`, degrees, and `altitude`, metres above the WGS-84 ellipsoid; absent where the
/// key is. Throws FileError.
std::optional<GeodeticPosition> optional_geodetic(const TomlSection& section, std::string_view name);

/// `attitude`: an array of heading, pitch and roll, degrees. Throws FileError.
Attitude attitude_in(const TomlSection& section);

/// `position`, three coordinates in the scene, and where it is there `attitude`. Throws FileError.
ScenePose scene_pose_in(const TomlSection& section);

}  // namespace quadrig::config
