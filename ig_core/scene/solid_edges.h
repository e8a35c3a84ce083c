/// The edges of a solid: where two of its bounding planes meet on it.
#pragma once

#include <optional>
#include <span>

#include "ig_core/scene/solid.h"

namespace quadrig {

/// The edge between two planes of `planes`, which bound the solid together with its quadric: nothing where they do not
/// meet on it. A solid without end has none that could be told.
std::optional<SolidEdge> edge_between(const Solid& solid, std::span<const SolidPlane> planes, std::size_t i,
                                      std::size_t j);

/// All edges between planes that have faces.
std::vector<SolidEdge> edges_of(const Solid& solid);

}  // namespace quadrig
