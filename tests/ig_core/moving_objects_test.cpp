#include <catch2/catch.hpp>

#include "ig_core/reference/error.h"
#include "ig_core/scene/motion.h"
#include "ig_core/scene/placement.h"
#include "tests/ig_core/painted_scene.h"
#include "tests/ig_core/random_objects.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

void set_moving(Scene& scene, Randomness& random) {
    for (Object& object : scene.objects) {
        if (random.chance(0.4)) continue;
        Motion& motion = object.motion.emplace();
        motion.velocity = random.vector(3);
        if (std::holds_alternative<Ellipsoid>(object.shape) && random.chance(0.5))
            motion.sway = Sway{{random.between(1, 10)}, random.between(2, 6), random.between(50, 200)};
    }
}

Model aircraft(Randomness& random) {
    Model model{"craft", {}};
    for (int i = 0; i < 6; ++i) {
        Object part;
        part.shape = Ellipsoid{{random.vector(6)},
                               {random.between(0.5, 4), random.between(0.5, 8), random.between(0.3, 2)},
                               random.attitude()};
        part.planes = {{{0, 0, 1, 4}}};
        part.paint.colour = {random.between(0, 1), random.between(0, 1), random.between(0, 1)};
        model.objects.push_back(part);
    }
    return model;
}

std::int64_t wrong_pixels(const GroundTruth& answer, const Scene& scene, const View& view) {
    std::vector<std::uint8_t> ties;
    const GroundTruth exact = reference::ground_truth(scene, view, &ties);
    return reference::visibility_error(answer, exact, ties).wrong;
}

}  // namespace

TEST_CASE("objects that move are where the scene has them at that time, frame after frame") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(8); ++trial) {
        Randomness random(trial);
        Scene scene = random_scene(random, 15);
        set_moving(scene, random);
        const View view = random_view(random, 96, 72);
        ImageGenerator generator(scene, 2);
        for (const double seconds : {0.0, 1.7, 0.3, 30.0}) {
            CAPTURE(trial, seconds);
            const Environment environment{seconds, {}, {}, {}};
            CHECK(wrong_pixels(generator.ground_truth(view, {}, environment), scene_at(scene, seconds), view) == 0);
            const Picture moved = render(generator, view, environment);
            const Picture still = render(scene_at(scene, seconds), view, environment);
            int different = 0;  // rounding of a turned solid, at its edges
            for (std::size_t i = 0; i < moved.rgba.size(); ++i)
                different += std::abs(moved.rgba[i] - still.rgba[i]) > 2;
            CHECK(different < 40);
        }
    }
}

TEST_CASE(
    "models are drawn where the host places them, numbered after the scene's objects, and gone when it takes them "
    "away") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(8, 2); ++trial) {
        Randomness random(trial);
        Scene scene = random_scene(random, 5);
        scene.models = {aircraft(random), aircraft(random)};
        const View view = look({0, 0, 50}, {}, 96, 72, 60);
        ImageGenerator generator(scene, 2);
        const Picture before = render(generator, view);
        for (int frame = 0; frame < 3; ++frame) {
            std::vector<PlacedModel> bodies;
            Scene expected = scene;
            for (int i = random.below(4); i >= 0; --i) {
                const ScenePose pose{{{random.between(-20, 20), random.between(30, 90), random.between(35, 65)}},
                                     eye_from_scene_rotation(random.attitude())};
                bodies.push_back({static_cast<std::uint32_t>(random.below(2)), pose});
                for (const Object& object : scene.models[bodies.back().model].objects)
                    expected.objects.push_back(*placed(object, pose));
            }
            Environment environment;
            environment.bodies = bodies;
            CAPTURE(trial, frame, bodies.size());
            CHECK(wrong_pixels(generator.ground_truth(view, {}, environment), expected, view) == 0);
            const Picture drawn = render(generator, view, environment);
            CHECK_FALSE(drawn == before);
            const reference::LinearImage exact = reference::picture(scene, view, environment, 8);
            Picture copy = drawn;
            CHECK(reference::picture_error({copy.rgba.data(), 96, 72, 4 * 96}, exact).psnr() > 36);
        }
        CHECK(render(generator, view) == before);
        const PlacedModel unknown{7, {}};
        Environment environment;
        environment.bodies = {&unknown, 1};
        CHECK(render(generator, view, environment) == before);
    }
}

TEST_CASE("what a still eye keeps from frame to frame changes no bit, whatever else moves, comes, goes or turns") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(6, 2); ++trial) {
        Randomness random(trial);
        Scene scene = painted_scene(random, 30);
        set_moving(scene, random);
        scene.models = {aircraft(random), aircraft(random)};
        ImageGenerator busy(scene, 2);
        View view = random_view(random, 96, 72);
        Quality quality;
        Environment environment;
        std::vector<PlacedModel> bodies;
        std::uint64_t kept = 0;
        for (int frame = 0; frame < 20; ++frame) {
            if (random.chance(0.4)) environment.seconds += 0.1;
            if (random.chance(0.4)) {
                bodies.assign(static_cast<std::size_t>(random.below(4)), {});
                for (PlacedModel& body : bodies)
                    body = {
                        static_cast<std::uint32_t>(random.below(2)),
                        {{view.eye.metres + 40.0 * random.direction()}, eye_from_scene_rotation(random.attitude())}};
            }
            if (random.chance(0.1)) view.eye.metres += random.vector(1);
            if (random.chance(0.1)) view = random_view(random, 96, 72);
            if (random.chance(0.1)) view.image = ImagePlane::symmetric(96, 72, {random.between(20, 100)});
            if (random.chance(0.1)) quality.sub_scan_lines = 1 << random.below(4);
            if (random.chance(0.1)) quality.smallest_feature = random.between(0, 4);
            if (random.chance(0.1)) quality.set_up = random.chance(0.5) ? SetUp::textbook : SetUp::anchored;
            environment.bodies = bodies;
            CAPTURE(trial, frame);
            ImageGenerator fresh(scene, 1);
            REQUIRE(render(busy, view, environment, quality) == render(fresh, view, environment, quality));
            kept += fresh.work().outlines - busy.work().outlines;
            if (random.chance(0.1)) {
                const GroundTruth truth = busy.ground_truth(view, quality, environment);
                CHECK(truth.depth == fresh.ground_truth(view, quality, environment).depth);
            }
        }
        CHECK(kept > 0);
    }
}
