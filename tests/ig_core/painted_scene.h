/// A random scene with everything that a picture can have: textures, holes, decks, haze, ground.
#pragma once

#include "tests/ig_core/random_scene.h"

namespace quadrig::test {

inline Scene painted_scene(Randomness& random, int objects) {
    Scene scene = random_scene(random, objects);
    scene.sun = {{random.between(0, 360)}, {random.between(5, 80)}, random.between(0.2, 0.6)};
    if (random.chance(0.7)) scene.haze = Haze{random.log_between(100, 5000), {0.62, 0.72, 0.82}};
    scene.textures = {{"grass", {{1, 0.05, 0.3}, {0.7, 0.11, 1.9}, {0.5, 0.31, 4}}, 0.0, {0, 0}},
                      {"leaves", {{1, 0.9, 0.4}, {0.7, 1.9, 5}, {0.5, 4.1, 1.65}, {0.35, 8.3, 2.2}}, 0.75, {0, 0}},
                      {"cloud", {{1, 0.02, 0.4}, {0.7, 0.043, 2}, {0.5, 0.09, 5}}, 0.3, {5, 2}}};
    const auto colour = [&] { return Colour(random.between(0, 1), random.between(0, 1), random.between(0, 1)); };
    if (scene.ground) scene.ground->paint = {{0.25, 0.33, 0.14}, 0u, 0.6, {}};
    if (random.chance(0.5)) scene.cloud_decks.push_back({300, {{1, 1, 1}, 2u, 0.3, Translucence{0.25, 0.25, 0.2}}});
    for (Object& object : scene.objects) {
        object.paint.colour = colour();
        if (random.chance(0.6)) {
            object.paint.texture = 1u;
            object.paint.texture_weight = random.between(0, 0.9);
            if (random.chance(0.4)) object.paint.translucence = Translucence{0.12, 0.45, 0.15};
        }
    }
    return scene;
}

}  // namespace quadrig::test
