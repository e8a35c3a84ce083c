#include "tests/ig_core/against_reference.h"
#include "tests/ig_core/random_objects.h"
#include "tests/ig_core/random_scene.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// Random scenes of about so many objects, one view each.
Agreement compare_scenes(int first_trial, int count, int least_objects, int most_objects) {
    Agreement total;
    int wrong_scenes = 0;
    for (int trial = first_trial; trial < first_trial + trials(count); ++trial) {
        Randomness random(trial);
        const int objects = least_objects + random.below(most_objects - least_objects + 1);
        ImageGenerator generator(random_scene(random, objects), 1 + random.below(3));
        const Agreement agreement = compare_with_reference(generator, random_view(random, 96, 72));
        total += agreement;
        if (agreement.wrong_identity + agreement.wrong_depth == 0) continue;
        ++wrong_scenes;
        UNSCOPED_INFO("trial " << trial << ", " << objects << " objects, " << agreement.wrong_identity << " wrong ids, "
                               << agreement.wrong_depth << " wrong depths");
    }
    UNSCOPED_INFO("wrong scenes " << wrong_scenes << ", ties " << total.ties << " of " << total.pixels);
    return total;
}

}  // namespace

TEST_CASE("a few solids that run into one another show what the reference shows, at every pixel centre") {
    CAPTURE(seed());
    const Agreement total = compare_scenes(0, 60, 1, 8);
    CHECK(total.wrong_identity == 0);
    CHECK(total.wrong_depth == 0);
    CHECK(total.objects > total.pixels / 20);
    CHECK(total.ties < total.pixels / 1000);
}

TEST_CASE("dozens of solids that run into one another show what the reference shows, at every pixel centre") {
    CAPTURE(seed());
    const Agreement total = compare_scenes(10'000, 12, 20, 100);
    CHECK(total.wrong_identity == 0);
    CHECK(total.wrong_depth == 0);
    CHECK(total.objects > total.pixels / 4);
    CHECK(total.ties < total.pixels / 1000);
}
