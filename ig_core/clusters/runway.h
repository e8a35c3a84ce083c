/// A runway with its markings and lights, after ICAO Annex 14, Volume I (5.2 markings, 5.3 lights), as polygons of the
/// ground and light points.
#pragma once

#include <optional>

#include "ig_core/scene/scene.h"

namespace quadrig::clusters {

/// Edge, threshold and end lights at both ends.
struct RunwayLights {
    double intensity = 20.0;  ///< times white
    double spacing = 60.0;    ///< m, along the edges
    double approach = 0.0;    ///< m, length of the approach lights before the threshold
};

struct Runway {
    glm::dvec2 threshold{0.0};  ///< middle of the threshold, scene X and Y
    Degrees heading;            ///< of a take-off from that threshold, clockwise from north
    double length = 2000.0;     ///< m, between the two thresholds
    double width = 45.0;        ///< m
    Paint paint{Colour{0.09, 0.09, 0.1}, {}, 0.0, {}};
    bool markings = true;
    Colour marking_colour{0.8, 0.8, 0.8};
    std::optional<RunwayLights> lights;
};

/// Threshold stripes for the width, centre line, aiming point, touchdown zone and side stripes at both ends.
std::vector<GroundPolygon> polygons_of(const Runway& runway);

/// White edge lights 1.5 m outside; green threshold lights every 3 m, seen from the approach; red end lights, seen from
/// the runway; approach lights in bars of five every 30 m, with a crossbar at 300 m, seen from the approach.
std::vector<LightPoint> lights_of(const Runway& runway);

}  // namespace quadrig::clusters
