/// Where the objects of a cluster stand: places over a region of the ground, at a typical spacing.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "ig_core/clusters/cluster.h"

namespace quadrig::clusters {

struct Place {
    glm::dvec2 position{0.0};
    std::uint64_t seed = 0;  ///< of everything else that is random there
};

/// How many places a region would have to be searched for, before any is: for a limit.
double places_to_search(const Cluster& cluster);

/// The places of a cluster whose region is moved by `origin`, those that `suits` refuses left out, at most
/// `cluster.count` of them.
///
/// Regions take the points of a triangular lattice through the origin, rows `spacing` sqrt(3)/2 apart, each moved by
/// its own random share of the spacing; those that end up inside are kept. A point's numbers depend on its row and
/// column only, so a region that is made larger keeps the places it had. Paths take rows along them instead.
std::vector<Place> places(const Cluster& cluster, std::uint64_t seed, const glm::dvec2& origin,
                          const std::function<bool(const glm::dvec2&)>& suits);

/// Whether a point lies in a region, its edge included; every point lies in a path.
bool inside(const Region& region, const glm::dvec2& point);

}  // namespace quadrig::clusters
