#include <catch2/catch.hpp>
#include <glm/matrix.hpp>

#include "ig_core/reference/seen_scene.h"
#include "tests/ig_core/random_objects.h"
#include "tests/reference/scene_makers.h"

using namespace quadrig;
using namespace quadrig::reference;
using quadrig::test::Kind;
using quadrig::test::Randomness;

namespace {

/// Colours that neither light nor air changes: the picture tells which object each ray has met.
void paint_flat(Scene& scene) {
    scene.sun.ambient = 1.0;
    scene.sky = {Colour(0.0), Colour(0.0)};
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        scene.objects[i].paint.colour = {static_cast<double>(i + 1), 1.0, 0.0};
    if (scene.ground) scene.ground->paint.colour = {0.0, 0.0, 1.0};
}

/// What a ray meets first of all that there is, asked of quadruple precision.
Colour met(const SeenScene& seen, Quad column, Quad row) {
    const auto direction = ray_direction<Quad>(seen.view, column, row);
    Quad nearest = std::numeric_limits<long double>::infinity();
    Colour colour(0.0);
    for (std::size_t i = 0; i < seen.exact.size(); ++i) {
        const auto hit = entry(seen.exact[i], direction);
        if (hit && in_front(hit->depth, nearest)) nearest = hit->depth, colour = seen.scene.objects[i].paint.colour;
    }
    if (!seen.scene.ground) return colour;
    const auto depth = level_depth(seen.view, 0.0, direction);
    return depth && in_front(*depth, nearest) ? seen.scene.ground->paint.colour : colour;
}

/// Pixels of a picture of 2 x 2 rays each that rays in quadruple precision, none of them left out, do not confirm.
int unconfirmed(const Scene& scene, const View& view) {
    const SeenScene seen(scene, view);
    const LinearImage image = picture(scene, view, {}, 2);
    int count = 0;
    for (int pixel = 0; pixel < image.width * image.height; ++pixel) {
        Colour mean(0.0);
        for (const Quad x : {0.25, 0.75})
            for (const Quad y : {0.25, 0.75})
                mean += 0.25 * met(seen, pixel % image.width + x, pixel / image.width + y);
        const float* rgb = image.rgb.data() + 3 * pixel;
        count += glm::length(mean - Colour(rgb[0], rgb[1], rgb[2])) > 1e-4;
    }
    return count;
}

}  // namespace

TEST_CASE("the horizon of a hill on its base plane is in the picture, from an eye just above that plane") {
    Scene scene = scene_of({solid(Hill{{{100, 500, 60}}, 200, 0.5}, {{{0, 0, 1, 0}}})});
    scene.ground.emplace();
    paint_flat(scene);
    CHECK(unconfirmed(scene, look({0, 60, 4}, {{0}, {3}, {0}}, 120, 90, 40)) == 0);
}

TEST_CASE("every ray of a picture meets what it meets in quadruple precision") {
    INFO("seed " << test::seed());
    for (int trial = 0; trial < test::trials(60); ++trial) {
        Randomness random(200'000 + trial);
        Scene scene;
        if (random.chance(0.5)) scene.ground.emplace();
        const bool level = random.chance(0.5);  // along the planes that hills and boxes stand on
        const Attitude attitude =
            level ? Attitude{{random.between(0, 360)}, {random.between(-5, 5)}, {0}} : random.attitude();
        const glm::dvec3 eye(0, 0, level ? random.between(0, 3) : random.between(-20, 20));
        const View view = look(eye, attitude, 40, 30, random.between(5, 120));
        const glm::dvec3 ahead = 20.0 * glm::transpose(view.eye_from_scene)[1];
        for (int i = 0; i < 5; ++i) {
            const glm::dvec3 centre = eye + ahead + random.vector(8);
            const Kind kind = i == 0 ? Kind::hill : i == 1 ? Kind::cone : test::random_kind(random);
            const bool capped = random.chance(0.6);
            scene.objects.push_back(
                test::random_object(random, kind, centre, random.log_between(0.5, 20), capped, random.below(3)));
            if (level && random.chance(0.5)) scene.objects.back().planes.push_back({{0, 0, 1, 0}});
        }
        paint_flat(scene);
        INFO("trial " << trial);
        CHECK(unconfirmed(scene, view) == 0);
    }
}
