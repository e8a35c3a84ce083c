#include "tests/ig_core/random_scene.h"

#include "tests/ig_core/random_objects.h"

namespace quadrig::test {

Object ball(const glm::dvec3& centre, double radius) {
    Object object;
    object.shape = Ellipsoid{{centre}, glm::dvec3(radius), {}};
    return object;
}

Object box(const glm::dvec3& low, const glm::dvec3& high) {
    Object object = ball(0.5 * (low + high), 2.0 * glm::length(high - low));
    object.planes = {{{-1, 0, 0, high.x}}, {{1, 0, 0, -low.x}},  {{0, -1, 0, high.y}},
                     {{0, 1, 0, -low.y}},  {{0, 0, -1, high.z}}, {{0, 0, 1, -low.z}}};
    return object;
}

Scene random_scene(Randomness& random, int objects) {
    Scene scene;
    if (random.chance(0.6)) scene.ground = Ground{};
    const double spread = random.log_between(10, 60);
    for (int i = 0; i < objects; ++i) {
        const glm::dvec3 centre = random.vector(spread) * glm::dvec3(1, 1, 0.3);
        const double size = random.log_between(0.05, 0.6) * spread;
        // Pairs of planes have a test of their own.
        Kind kind = random_kind(random);
        while (is_degenerate(kind) && kind != Kind::polyhedron) kind = random_kind(random);
        scene.objects.push_back(random_object(random, kind, centre, size, random.chance(0.97), random.below(5)));
    }
    return scene;
}

View random_view(Randomness& random, int width, int height) {
    const glm::dvec3 eye = random.vector(80) * glm::dvec3(1, 1, 0.4);
    Attitude attitude = attitude_towards(random.vector(15) - eye,
                                         random.chance(0.3) ? 90.0 * (random.below(4) - 1) : random.between(-180, 180));
    if (random.chance(0.1)) attitude = random.attitude();
    return look(eye, attitude, width, height, random.log_between(20, 150));
}

}  // namespace quadrig::test
