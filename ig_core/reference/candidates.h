/// Which solids a ray can meet at all: bounding spheres, and tiles of the image that share one list.
/// Conservative throughout: a solid left out is missed by every ray concerned, with a margin of 1e-6 of its distance,
/// which also covers rays moved by 1e-6 pixel. Space: scene axes, metres, origin at the eye.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ig_core/reference/solid.h"

namespace quadrig::reference {

/// A sphere that holds a solid; the radius is infinite where no bound was found.
struct BoundingSphere {
    glm::dvec3 centre{0.0};
    double radius = 0.0;
};

/// Because Q <= 0, P_i > 0 and P_j > 0 in the solid, Q - t P_i P_j <= 0 there for every t >= 0. Where planes face each
/// other (n_i.n_j < 0) this closes cylinders, cones and hills too: the sphere is that of the smallest ellipsoid found
/// so.
BoundingSphere bounding_sphere(const Solid<Quad>& solid);

/// Whether the half-line along `direction` comes near the sphere.
bool may_meet(const BoundingSphere& sphere, const glm::dvec3& direction);

/// A block of pixels, ends exclusive, and the solids that can be seen there, in file order.
struct Tile {
    int first_column = 0, end_column = 0;
    int first_row = 0, end_row = 0;
    std::vector<std::uint32_t> candidates;
};

/// Cuts the image into tiles and calls `draw` once for each, on all processors at once, in no order.
void for_each_tile(const View& view, const std::vector<BoundingSphere>& spheres,
                   const std::function<void(const Tile&)>& draw);

}  // namespace quadrig::reference
