#include "ig_core/select.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace quadrig {

ViewWalls walls_of(const View& view) {
    const ImagePlane& image = view.image;
    const glm::dmat3 scene_from_eye = glm::transpose(view.eye_from_scene);
    const auto wall = [&](const glm::dvec3& n, double distance) {
        const glm::dvec3 normal = scene_from_eye * glm::normalize(n);
        return Wall{normal, glm::dot(normal, view.eye.metres) + distance};
    };
    return {wall({0, 1, 0}, kNearDepth), wall({1, -image.left, 0}, 0), wall({-1, image.x(image.width), 0}, 0),
            wall({0, -image.z(image.height), 1}, 0), wall({0, image.top, -1}, 0)};
}

bool may_show_on(const ImagePlane& image, const ImageBounds& bounds) {
    return !bounds.behind() && bounds.x_to >= image.left && bounds.x_from <= image.x(image.width) &&
           bounds.z_from <= image.top && bounds.z_to >= image.z(image.height);
}

bool BoundingSphere::reaches_into(const ViewWalls& walls) const {
    constexpr double kRounding = 1e-9;
    return std::all_of(walls.begin(), walls.end(), [&](const Wall& wall) {
        const double along = glm::dot(wall.normal, centre);
        return along - wall.offset + radius >= -kRounding * (std::abs(along) + std::abs(wall.offset));
    });
}

}  // namespace quadrig
