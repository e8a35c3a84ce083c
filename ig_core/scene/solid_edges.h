/// The edges of a solid: where two of its bounding planes meet on it.
#pragma once

#include <optional>
#include <span>

#include "ig_core/scene/solid.h"

namespace quadrig {

struct EdgeEnds {
    SolidVertex from, to;
};

/// The edge between planes i > j of `planes`, which bound the solid together with its quadric: nothing where they do
/// not meet on it. A solid without end has none that could be told.
std::optional<EdgeEnds> edge_between(const Solid& solid, std::span<const SolidPlane> planes, std::size_t i,
                                     std::size_t j);

/// Finds all edges between planes that have faces. Where edges meet they have one vertex.
void find_edges(Solid& solid);

}  // namespace quadrig
