#include <catch2/catch.hpp>
#include <iostream>

#include "tests/hard_cases/comparison.h"
#include "tests/hard_cases/random_scenes.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

TEST_CASE("random scenes: no pixel but a tie differs from the exact answer, and depth agrees to 1e-6") {
    const int scenes = trials(200, 8);
    std::cout << "random scenes: seed " << seed() << ", " << scenes << " scenes\n";
    std::int64_t drawn = 0, ties = 0;
    for (int trial = 0; trial < scenes; ++trial) {
        const RandomScene random = random_scene(trial, 320, 240);
        const VisibilityErrors seen = visibility_errors(random.scene, random.view);
        INFO("seed " << seed() << " trial " << trial << " of " << random.scene.objects.size() << " objects");
        INFO(seen.first_wrong_text);
        CHECK(seen.wrong == 0);
        INFO(seen.deepest_text);
        CHECK(seen.depth <= 1e-6);
        drawn += seen.drawn;
        ties += seen.ties;
    }
    CHECK(drawn > 20'000 * scenes);
    CHECK(ties < scenes);
}

TEST_CASE("random scenes: pictures look like the reference's") {
    for (int trial = 0; trial < trials(20, 4); ++trial) {
        const RandomScene random = random_scene(1'000'000 + trial, 120, 90);
        const PictureErrors picture = picture_errors(random.scene, random.view);
        INFO("seed " << seed() << " trial " << trial << " of " << random.scene.objects.size() << " objects");
        INFO(picture.worst_pixel);
        CHECK(picture.mean < 2.0);
        CHECK(picture.outlier < 40);
    }
}
