/// From WGS-84 positions and local attitudes to poses in scene space.
#pragma once

#include <GeographicLib/LocalCartesian.hpp>
#include <vector>

#include "ig_core/geometry/space.h"

namespace quadrig::host {

/// The scene's tangent plane on the WGS-84 ellipsoid: X east, Y north, Z up at its origin, metres.
class SceneFrame {
  public:
    explicit SceneFrame(const GeodeticPosition& origin);

    /// The pose in scene space of a body whose attitude is given in the local level frame at its own position. The
    /// earth's curvature turns that frame against the scene's by the angle between the two verticals, about 0.009
    /// degrees a kilometre. Exact to nanometres and 1e-15 rad (GeographicLib). Does not allocate.
    ScenePose pose(const GeodeticPosition& position, const Attitude& attitude);

    /// Where a scene point is on the earth.
    [[nodiscard]] GeodeticPosition geodetic(const ScenePoint& point) const;

  private:
    GeographicLib::LocalCartesian local_;
    std::vector<double> scene_from_level_;  ///< nine numbers, row-major: as GeographicLib wants it
};

}  // namespace quadrig::host
