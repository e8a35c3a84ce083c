/// Short ways to write down the scenes and views of these tests.
#pragma once

#include <initializer_list>

#include "ig_core/reference/reference_renderer.h"

namespace quadrig::reference {

inline View look(glm::dvec3 eye, Attitude attitude, int width = 65, int height = 65, double fov = 40.0) {
    return {{eye}, eye_from_scene_rotation(attitude), ImagePlane::symmetric(width, height, {fov})};
}

inline View look_north(glm::dvec3 eye) { return look(eye, {}); }

inline Object solid(Shape shape, std::initializer_list<BoundingPlane> planes = {}) {
    Object object;
    object.shape = std::move(shape);
    object.planes = planes;
    return object;
}

inline Shape sphere(glm::dvec3 centre, double radius) { return Ellipsoid{{centre}, glm::dvec3(radius), {}}; }

/// Planes in the order east, west, north, south, up, down, cutting a sphere that holds all of the box.
inline Object box(glm::dvec3 low, glm::dvec3 high) {
    const double size = 2.0 * (high.x - low.x + high.y - low.y + high.z - low.z);
    return solid(sphere(0.5 * (low + high), size), {{{-1, 0, 0, high.x}},
                                                    {{1, 0, 0, -low.x}},
                                                    {{0, -1, 0, high.y}},
                                                    {{0, 1, 0, -low.y}},
                                                    {{0, 0, -1, high.z}},
                                                    {{0, 0, 1, -low.z}}});
}

inline Scene scene_of(std::initializer_list<Object> objects) {
    Scene scene;
    scene.objects = objects;
    return scene;
}

/// What one pixel shows; by default the middle one of an image of odd size.
struct Seen {
    std::int32_t object;
    std::int32_t surface;
    double depth;
};
inline Seen seen_at(const Scene& scene, const View& view, int column, int row) {
    const GroundTruth truth = ground_truth(scene, view);
    const auto pixel = static_cast<std::size_t>(row * view.image.width + column);
    return {truth.object_ids[pixel], truth.surface_ids[pixel], truth.depth[pixel]};
}
inline Seen seen_in_the_middle(const Scene& scene, const View& view) {
    return seen_at(scene, view, view.image.width / 2, view.image.height / 2);
}

}  // namespace quadrig::reference
