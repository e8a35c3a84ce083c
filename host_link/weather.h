/// Weather as a host has it: layers everywhere, and regions on the ground that have layers of their own. Plain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "host_link/inplace_vector.h"
#include "ig_core/geometry/space.h"

namespace quadrig::host {

/// A layer of weather, in heights of scene space.
struct WeatherLayer {
    bool enabled = false;
    double base = 0.0, top = 0.0;  ///< m
    double coverage = 1.0;         ///< 0..1
    double visibility = 0.0;       ///< m, between base and top
};

/// CIGI's layers that stand for something: 0 ground fog, 1 to 3 the scene's first cloud decks, 4 to 9 rain, snow,
/// sleet, hail, sand and dust.
inline constexpr std::size_t kWeatherLayers = 10, kCloudLayers = 3;
using WeatherLayers = std::array<std::optional<WeatherLayer>, kWeatherLayers>;

/// A rounded rectangle on the ground, with weather of its own at all heights above it.
struct WeatherRegion {
    std::uint16_t id = 0;
    bool active = false;
    ScenePose middle;                   ///< on the ellipsoid; its axes are the rectangle's: right, forward, up
    double length = 0.0, width = 0.0;   ///< m, forward and to the right
    double corner_radius = 0.0;         ///< m
    double transition_perimeter = 0.0;  ///< m, around the rectangle
    WeatherLayers layers;               ///< those absent are as outside

    /// How much of the region's weather an eye sees, 0..1: all of it above the rectangle, evenly less across the
    /// transition perimeter, nothing beyond. Distances are in the plane that touches the ellipsoid in the middle.
    [[nodiscard]] double share_at(const ScenePoint& eye) const;
};

/// The regions that a host has named, in the order in which it did.
using WeatherRegions = InplaceVector<WeatherRegion, 8>;

}  // namespace quadrig::host
