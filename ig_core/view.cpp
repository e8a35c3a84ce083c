#include "ig_core/view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace quadrig {

ImagePlane ImagePlane::symmetric(int width, int height, Degrees horizontal_fov) {
    const double step = 2.0 * std::tan(horizontal_fov.radians() / 2.0) / width;
    return {width, height, -0.5 * width * step, step, 0.5 * height * step, step};
}

ImagePlane ImagePlane::window(int width, int height, Degrees left, Degrees right, Degrees top, Degrees bottom) {
    const double tan_left = std::tan(left.radians()), tan_top = std::tan(top.radians());
    return {width,    height,
            tan_left, (std::tan(right.radians()) - tan_left) / width,
            tan_top,  (tan_top - std::tan(bottom.radians())) / height};
}

ViewFrustum view_frustum(const View& view) {
    const ImagePlane& image = view.image;
    const glm::dmat3 scene_from_eye = glm::transpose(view.eye_from_scene);
    const auto half_space = [&](const glm::dvec3& n, double distance) {
        const glm::dvec3 normal = scene_from_eye * glm::normalize(n);
        return HalfSpace{normal, glm::dot(normal, view.eye.metres) + distance};
    };
    return {half_space({0, 1, 0}, kNearDepth), half_space({1, -image.left, 0}, 0),
            half_space({-1, image.x(image.width), 0}, 0), half_space({0, -image.z(image.height), 1}, 0),
            half_space({0, image.top, -1}, 0)};
}

}  // namespace quadrig
