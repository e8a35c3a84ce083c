/// Clusters become objects: the same ones for ever, on every machine, compiler and number of threads.
///
/// Only operations that IEEE 754 rounds correctly (+, -, *, /, square root) are used, on integers from an exactly
/// specified generator (dice.h), and nothing is contracted (-ffp-contract=off).
#pragma once

#include <span>
#include <stdexcept>
#include <vector>

#include "ig_core/clusters/cluster.h"

namespace quadrig::clusters {

/// Most objects of all clusters together, and most points of the ground plane that are tried for them.
inline constexpr std::size_t kMostObjects = 1'000'000;
inline constexpr double kMostPlacesTried = 16e6;

/// A cluster would make more than these limits allow, or overlap in too many places.
struct TooMany : std::runtime_error {
    TooMany(std::size_t index, const std::string& what) : std::runtime_error(what), cluster(index) {}
    std::size_t cluster;
};

/// Whether the cluster is placed by another: then it stands there, and not by itself.
bool is_placed(std::span<const Cluster> clusters, std::size_t index);

/// The objects of all clusters: first those of terrain, then the others, each in the clusters' order. Clusters may
/// place only clusters before them. Terrain stands at Z = 0; other clusters stand on it, on the hills among `written`,
/// on Z = 0 between them, or at their own altitude. Throws TooMany.
std::vector<Object> generate(std::span<const Cluster> clusters, std::span<const Object> written);

}  // namespace quadrig::clusters
