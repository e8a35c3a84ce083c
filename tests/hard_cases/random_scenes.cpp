#include "tests/hard_cases/random_scenes.h"

#include <glm/matrix.hpp>

#include "tests/ig_core/random_objects.h"

namespace quadrig::test {
namespace {

glm::dvec3 random_eye(Randomness& random) {
    const double offset = random.chance(0.7) ? 100.0 : random.log_between(1e3, 1e7);
    glm::dvec3 eye = random.vector(offset);
    if (random.chance(0.7)) eye.z = random.log_between(0.5, 300);
    return eye;
}

double random_field_of_view(Randomness& random) {
    if (random.chance(0.7)) return random.between(20, 100);
    return random.chance(0.5) ? random.log_between(0.1, 20) : random.between(100, 170);
}

}  // namespace

RandomScene random_scene(int trial, int width, int height) {
    Randomness random(trial);
    RandomScene made;
    const glm::dvec3 eye = random_eye(random);
    const Degrees field_of_view{random_field_of_view(random)};
    View& view = made.view;
    view = {{eye}, eye_from_scene_rotation(random.attitude()), ImagePlane::symmetric(width, height, field_of_view)};
    if (random.chance(0.5)) made.scene.ground.emplace();

    const glm::dmat3 scene_from_eye = glm::transpose(view.eye_from_scene);
    const auto place_ahead = [&](double depth) {
        const double x = view.image.x(random.between(-0.1, 1.1) * width);
        const double z = view.image.z(random.between(-0.1, 1.1) * height);
        return eye + scene_from_eye * (depth * glm::dvec3(x, 1, z));
    };
    const auto count = static_cast<int>(random.log_between(1, 201));
    const bool heap = random.chance(0.3);  // all about one place, many of them crossing
    const double heap_depth = random.log_between(3, 3000);
    const glm::dvec3 heap_place = place_ahead(heap_depth);
    const double heap_size = heap_depth * view.image.width * view.image.column_step * random.log_between(0.05, 1);
    for (int i = 0; i < count; ++i) {
        const double depth = random.log_between(1, 3000);
        const glm::dvec3 centre = heap ? heap_place + random.vector(0.3 * heap_size) : place_ahead(depth);
        const double pixels = random.log_between(0.5, random.chance(0.2) ? 3000 : 100);
        const double size = heap ? heap_size * random.log_between(0.02, 1) : depth * view.image.column_step * pixels;
        const int planes = random.chance(0.3) ? 0 : random.below(random.chance(0.1) ? kMaxPlanes + 1 : 6);
        const bool capped = random.chance(count < 10 ? 0.9 : 0.99);
        made.scene.objects.push_back(random_object(random, random_kind(random), centre, size, capped, planes));
    }
    return made;
}

}  // namespace quadrig::test
