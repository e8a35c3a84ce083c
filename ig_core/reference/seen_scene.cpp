#include "ig_core/reference/seen_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace quadrig::reference {
namespace {

/// The image of a light point, if it is in front of the eye and its beam holds the eye.
std::optional<SeenScene::Disc> disc_of(const LightPoint& light, std::uint32_t index, const View& view) {
    const glm::dvec3 away = light.position.metres - view.eye.metres, p = view.eye_from_scene * away;
    if (p.y <= kNearDepth) return std::nullopt;
    if (light.beam) {
        const double heading = light.beam->heading.radians();
        const glm::dvec2 level(-away.x, -away.y), axis(std::sin(heading), std::cos(heading));
        if (glm::dot(level, axis) < glm::length(level) * std::cos(0.5 * light.beam->width.radians()))
            return std::nullopt;
    }
    const ImagePlane& image = view.image;
    const double radius = 0.5 * std::max(light.diameter / p.y, kLeastLightPixels * image.row_step);
    return SeenScene::Disc{index,
                           (p.x / p.y - image.left) / image.column_step,
                           (image.top - p.z / p.y) / image.row_step,
                           radius / image.column_step,
                           radius / image.row_step,
                           p.y};
}

}  // namespace

SeenScene::SeenScene(const Scene& s, const View& v) : scene(s), view(v) {
    for (const Object& object : scene.objects) {
        exact.push_back(solid_about_eye(object, view.eye));
        values.push_back(rounded<long double>(exact.back()));
        triage.push_back(rounded<double>(exact.back()));
        spheres.push_back(bounding_sphere(exact.back()));
    }
    for (std::uint32_t light = 0; light < scene.lights.size(); ++light)
        if (const auto disc = disc_of(scene.lights[light], light, view)) discs.push_back(*disc);
}

Vector<double> SeenScene::direction(double column, double row) const {
    const auto d = ray_direction<long double>(view, column, row);
    return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
}

}  // namespace quadrig::reference
