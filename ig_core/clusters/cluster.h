/// Clusters of scene features as plain data: what a scene file says of a wood, a range of hills or a sky of clouds in a
/// few lines (Gardner 1984, 2.3). Scene space, metres; angles in degrees; lengths of a template are relative to its
/// place.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ig_core/scene/scene.h"

namespace quadrig::clusters {

/// Where a cluster lies on the ground plane.
struct Rectangle {
    glm::dvec2 low{0.0}, high{0.0};
};
struct Ellipse {
    glm::dvec2 centre{0.0}, semi_axes{1.0};
};
struct Polygon {
    std::vector<glm::dvec2> corners;  ///< at least 3; inside by the even-odd rule
};
/// A band along a line; of width 0 it is the line.
struct Path {
    std::vector<glm::dvec2> points;  ///< at least 2
    double width = 0.0;
};
using Region = std::variant<Rectangle, Ellipse, Polygon, Path>;

/// How far an object may differ from its template; all of it evenly distributed.
struct Variation {
    double position = 0.0;     ///< share of the spacing, east and north each, 0..1
    double size = 0.0;         ///< factor 1 - size .. 1 + size, 0..1 exclusive
    double shape = 0.0;        ///< the same for every semi-axis, or for a hill's slope
    double colour = 0.0;       ///< brightness by that share, each channel by half of it, 0..1
    double altitude = 0.0;     ///< m
    glm::dvec3 attitude{0.0};  ///< heading, pitch, roll
};

/// What stands at a place: an object whose origin is the place, or all of an earlier cluster about it.
struct Template {
    double weight = 1.0;  ///< > 0: how often it is taken
    std::variant<Object, std::size_t> what;
};

struct Cluster {
    std::string name;  ///< its objects are NAME-1, NAME-2, ...
    std::uint64_t seed = 0;
    Region region;
    double spacing = 1.0;              ///< between neighbours, m
    std::optional<std::size_t> count;  ///< at most so many places, drawn at random
    Variation variation;
    bool terrain = false;                 ///< hills that later clusters stand on
    int abutting = 0;                     ///< cut an object by the planes in which it meets so many neighbours at most
    std::optional<double> altitude;       ///< m, instead of standing on the terrain
    std::optional<glm::dvec2> elevation;  ///< only where the terrain's height lies between these
    std::vector<Template> templates;      ///< at least 1; hills and ellipsoids only
};

}  // namespace quadrig::clusters
