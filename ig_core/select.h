/// Which objects may be in view: the first stage of a frame.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "ig_core/outline/image_bounds.h"
#include "ig_core/view.h"

namespace quadrig {

/// A half-space n.p >= offset of the scene, n of unit length.
struct Wall {
    glm::dvec3 normal;
    double offset;
};
/// What bounds a view: near plane and the four sides of the window.
using ViewWalls = std::array<Wall, 5>;
ViewWalls walls_of(const View& view);

/// What holds an object, apart from it: most objects of a large scene are never touched but by this.
struct BoundingSphere {
    glm::dvec3 centre{0.0};
    double radius = 0.0;  ///< may be infinite
    /// Errs on the side of yes.
    [[nodiscard]] bool reaches_into(const ViewWalls& walls) const;
};

/// Whether something within these bounds may show on an image.
bool may_show_on(const ImagePlane& image, const ImageBounds& bounds);

}  // namespace quadrig
