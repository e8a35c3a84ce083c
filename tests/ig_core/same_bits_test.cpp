#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/ig_core/painted_scene.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

View view_of_trial(int trial, int width = 200, int height = 131) {
    Randomness random(500'000 + trial);
    return random_view(random, width, height);
}

}  // namespace

TEST_CASE("the same frame comes out bit for bit with 1, 2, 4 and 7 threads") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(6, 2); ++trial) {
        Randomness random(trial);
        const Scene scene = painted_scene(random, 40);
        const Environment environment{random.between(0, 100), {}, {}};
        ImageGenerator alone(scene, 1);
        const View view = view_of_trial(trial);
        const Picture expected = render(alone, view, environment);
        const GroundTruth truth = alone.ground_truth(view);
        for (const int threads : {2, 4, 7}) {
            ImageGenerator team(scene, threads);
            for (int again = 0; again < 3; ++again) {
                CAPTURE(trial, threads, again);
                CHECK(render(team, view, environment) == expected);
            }
            const GroundTruth same = team.ground_truth(view);
            CHECK(same.object_ids == truth.object_ids);
            CHECK(same.surface_ids == truth.surface_ids);
            CHECK(same.depth == truth.depth);
        }
    }
}

TEST_CASE("a frame does not depend on the frames before it") {
    CAPTURE(seed());
    Randomness random(1);
    const Scene scene = painted_scene(random, 60);
    ImageGenerator busy(scene, 2);
    for (int trial = 0; trial < trials(8); ++trial) {
        const View view = view_of_trial(trial);
        const Environment environment{1.5 * trial, Sun{{20.0 * trial}, {30}, 0.3}, 500.0 + trial};
        ImageGenerator fresh(scene, 1);
        const Picture expected = render(fresh, view, environment);
        for (const int lines : {1, 8, 2}) render(busy, view_of_trial(trial + 100 + lines, 90, 77), {}, {lines});
        busy.ground_truth(view_of_trial(trial + 200, 64, 48));
        CAPTURE(trial);
        CHECK(render(busy, view, environment) == expected);
    }
}

TEST_CASE("in which order a scene has its textures makes no difference") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(6, 2); ++trial) {
        CAPTURE(trial);
        Randomness random(trial);
        Scene scene = painted_scene(random, 40);
        // As many as objects, so that many of one row are shaded by turns.
        const Texture pattern = scene.textures.at(0);
        for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
            scene.objects[i].paint.texture = static_cast<std::uint32_t>(scene.textures.size());
            scene.textures.push_back(pattern);
            for (TextureTerm& term : scene.textures.back().terms) term.phase += random.between(0, 6);
        }
        const View view = view_of_trial(trial);
        const Picture expected = render(scene, view);
        const auto last = static_cast<std::uint32_t>(scene.textures.size() - 1);
        std::reverse(scene.textures.begin(), scene.textures.end());
        const auto reversed = [&](Paint& paint) {
            if (paint.texture) paint.texture = last - *paint.texture;
        };
        for (Object& object : scene.objects) reversed(object.paint);
        for (CloudDeck& deck : scene.cloud_decks) reversed(deck.paint);
        for (GroundPolygon& polygon : scene.ground_polygons) reversed(polygon.paint);
        if (scene.ground) reversed(scene.ground->paint);
        CHECK(render(scene, view) == expected);
    }
}

TEST_CASE("more sub-scan lines than 8 are 8, fewer than none are none") {
    Randomness random(2);
    ImageGenerator generator(painted_scene(random, 30), 1);
    const View view = view_of_trial(3);
    const Picture eight = render(generator, view, {}, {8});
    CHECK(render(generator, view, {}, {100}) == eight);
    CHECK(render(generator, view, {}, {-1}) == render(generator, view, {}, {1}));
    CHECK_FALSE(render(generator, view, {}, {1}) == eight);
}
