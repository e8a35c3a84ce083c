#include "tests/ig_core/against_reference.h"
#include "tests/ig_core/random_objects.h"
#include "tests/ig_core/random_scene.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

TEST_CASE("a scene of 10,000 objects shows what the reference shows") {
    CAPTURE(seed());
    Scene scene;
    scene.ground = Ground{};
    Randomness random(1);
    for (int i = 0; i < 10'000; ++i) {
        const glm::dvec3 centre(random.between(-3000, 3000), random.between(0, 6000), 0);
        scene.objects.push_back(random_object(random, i % 4 == 0 ? Kind::hill : Kind::ellipsoid,
                                              centre + glm::dvec3(0, 0, random.between(5, 40)),
                                              random.log_between(3, 60), true, random.below(3)));
    }
    ImageGenerator generator(scene, 2);
    const Agreement agreement = compare_with_reference(generator, look({0, -200, 150}, {{2}, {-8}, {0}}, 160, 120, 70));
    CHECK(agreement.wrong_identity == 0);
    CHECK(agreement.wrong_depth == 0);
    CHECK(agreement.objects > agreement.pixels / 4);
    render(generator, look({0, -200, 150}, {{2}, {-8}, {0}}, 160, 120, 70));
}

TEST_CASE("objects hidden behind others change no pixel, whatever they are") {
    CAPTURE(seed());
    Randomness random(2);
    Scene scene;
    scene.ground = Ground{};
    scene.objects.push_back(ball({0, 100, 0}, 60));
    Scene crowded = scene;
    for (int i = 0; i < 500; ++i) {
        // Behind the ball, as seen from anywhere at 5 m about the origin.
        const double y = random.between(200, 900), reach = 0.4 * y;
        crowded.objects.push_back(random_object(random, i % 3 == 0 ? Kind::hill : Kind::ellipsoid,
                                                {random.between(-reach, reach), y, random.between(-reach, reach)},
                                                random.log_between(1, 20), true, random.below(4)));
    }
    for (const int lines : {0, 2}) {
        const View view = look({1, -2, 0.5}, {{2}, {1}, {3}}, 160, 120, 100);
        Quality quality;
        quality.sub_scan_lines = lines;
        ImageGenerator alone(scene, 1), among(crowded, 2);
        CHECK(render(alone, view, {}, quality) == render(among, view, {}, quality));
    }
}

TEST_CASE("hundreds of layers on a line of sight are drawn in order") {
    // Shells of decreasing opacity about one another would take a deck of cards: thin boxes, one behind the other, all
    // half open.
    Scene scene;
    scene.sun.ambient = 1;
    scene.sky = {{0, 0, 0}, {0, 0, 0}};
    scene.textures = {{"even", {{1, 1e-9, 0}}, 0, {0, 0}}};
    for (int i = 0; i < 300; ++i) {
        const double y = 10 + i;
        scene.objects.push_back(box({-500, y, -500}, {500, y + 0.5, 500}));
        scene.objects.back().paint = {
            {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i > 1 ? 1.0 : 0.0}, 0u, 0, Translucence{0.25, 1, 0.2}};
    }
    const Picture picture = render(scene, look({0, 0, 0}, {}, 33, 33, 40));
    for (int c = 0; c < 33; c += 4) CHECK(steps_off(picture.at(c, 16), {0.5, 0.25, 0.25}) < 1);
}

TEST_CASE("a scene of one object, and one of none, are drawn") {
    Scene scene;
    const View view = look({0, 0, 0}, {}, 65, 49, 40);
    const Picture sky = render(scene, view);
    CHECK(steps_off(sky.at(32, 48), scene.sky.horizon) < 0.6);
    scene.objects = {ball({0, 50, 0}, 5)};
    scene.sun = {{180}, {0}, 0.0};
    const Picture one = render(scene, view);
    CHECK(steps_off(one.at(32, 24), {1, 1, 1}) < 1);
    CHECK(steps_off(one.at(2, 46), scene.sky.horizon) < 0.6);
}
