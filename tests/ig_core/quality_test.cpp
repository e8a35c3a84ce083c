#include <array>
#include <catch2/catch.hpp>

#include "tests/ig_core/painted_scene.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// Objects that show nothing but their colour, each its own.
Scene plain_scene(Randomness& random, int objects) {
    Scene scene = random_scene(random, objects);
    scene.sun.ambient = 1.0;
    scene.haze.reset();
    scene.sky.zenith = scene.sky.horizon;
    scene.ground.reset();
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        scene.objects[i].paint = {
            {static_cast<double>(i + 1) / 200.0, random.between(0, 1), random.between(0, 1)}, {}, 0, {}};
    return scene;
}

}  // namespace

TEST_CASE("without antialiasing every pixel shows what is seen at its centre, and nothing else") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(10); ++trial) {
        Randomness random(trial);
        const Scene scene = plain_scene(random, 25);
        const View view = random_view(random, 96, 72);
        const Picture picture = render(scene, view, {}, {.sub_scan_lines = 0});
        const GroundTruth truth = ImageGenerator(scene).ground_truth(view);
        for (int row = 0; row < 72; ++row)
            for (int column = 0; column < 96; ++column) {
                const int object = truth.object_ids[static_cast<std::size_t>(96 * row + column)];
                const Colour colour =
                    object == kSkyId ? scene.sky.horizon : scene.objects[static_cast<std::size_t>(object)].paint.colour;
                CAPTURE(trial, column, row, object);
                REQUIRE(steps_off(picture.at(column, row), colour) < 0.6);
            }
    }
}

TEST_CASE("with every second pixel shaded, neighbours share their colour wherever a surface fills both") {
    Randomness random(1);
    Scene scene = painted_scene(random, 0);
    scene.cloud_decks.clear();
    const View view = look({0, 0, 20}, {{20}, {-50}, {0}}, 96, 72, 40);
    const Picture picture = render(scene, view, {}, {.shading = ShadingRate::half});
    const Picture full = render(scene, view);
    int different = 0;
    for (int row = 0; row < 72; ++row)
        for (int column = 0; column < 96; column += 2) {
            CAPTURE(column, row);
            REQUIRE(std::equal(picture.at(column, row), picture.at(column, row) + 4, picture.at(column + 1, row)));
            different += !std::equal(full.at(column, row), full.at(column, row) + 4, full.at(column + 1, row));
        }
    CHECK(different > 500);
}

TEST_CASE("drawn twice as fine, a pixel is the mean of the four that it would be in a picture twice the size") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(6); ++trial) {
        Randomness random(trial);
        const Scene scene = painted_scene(random, 12);
        View view = random_view(random, 90, 66);
        const Picture fine = render(scene, view, {}, {.shading = ShadingRate::four});
        view.image.width *= 2, view.image.height *= 2;
        view.image.column_step /= 2, view.image.row_step /= 2;
        const Picture large = render(scene, view);
        for (int row = 0; row < 66; ++row)
            for (int column = 0; column < 90; ++column) {
                Colour mean{0.0};
                for (int i = 0; i < 4; ++i)
                    for (int k = 0; k < 3; ++k)
                        mean[k] += linear_light(large.at(2 * column + i % 2, 2 * row + i / 2)[k]) / 4;
                CAPTURE(trial, column, row);
                REQUIRE(steps_off(fine.at(column, row), mean) < 2.5);
            }
    }
}

TEST_CASE("drawn half as fine, every pixel of a picture half the size fills 2 x 2, however many there are") {
    CAPTURE(seed());
    constexpr std::array kRates{std::pair{ShadingRate::quarter, ShadingRate::one},
                                std::pair{ShadingRate::eighth, ShadingRate::half}};
    for (int trial = 0; trial < trials(8); ++trial) {
        Randomness random(trial);
        const Scene scene = painted_scene(random, 15);
        const int width = 1 + random.below(110), height = trial % 4 == 3 ? 1 : 1 + random.below(80);
        const View view = random_view(random, width, height);
        View half = view;
        half.image.width = width / 2 + width % 2, half.image.height = height / 2 + height % 2;
        half.image.column_step *= 2, half.image.row_step *= 2;
        for (const auto& [coarse, rate] : kRates)
            for (const int lines : {0, 2}) {
                const Picture small =
                    render(scene, half, {}, {.sub_scan_lines = lines, .shading = rate, .smallest_feature = 1.5});
                const Picture picture =
                    render(scene, view, {}, {.sub_scan_lines = lines, .shading = coarse, .smallest_feature = 3});
                CAPTURE(trial, width, height, lines);
                for (int row = 0; row < height; ++row)
                    for (int column = 0; column < width; ++column) {
                        const std::uint8_t* pixel = picture.at(column, row);
                        if (!std::equal(pixel, pixel + 4, small.at(column / 2, row / 2))) FAIL(column << ", " << row);
                    }
            }
    }
}

TEST_CASE("ids and depth are of every pixel, by whatever grid the picture is drawn on") {
    Randomness random(3);
    ImageGenerator generator(painted_scene(random, 30), 2);
    const View view = random_view(random, 97, 71);
    const GroundTruth usual = generator.ground_truth(view, {.smallest_feature = 2});
    for (const ShadingRate rate : {ShadingRate::eighth, ShadingRate::quarter, ShadingRate::half, ShadingRate::four}) {
        render(generator, view, {}, {.shading = rate});
        const GroundTruth truth = generator.ground_truth(view, {.shading = rate, .smallest_feature = 2});
        CHECK(truth.object_ids == usual.object_ids);
        CHECK(truth.surface_ids == usual.surface_ids);
        CHECK(truth.depth == usual.depth);
    }
}

TEST_CASE("objects whose outlines are lower than the smallest feature are not drawn, all others are") {
    Scene scene;
    scene.sun.ambient = 1.0;
    for (int i = 0; i < 10; ++i) scene.objects.push_back(ball({-90 + 20.0 * i, 400, 0}, 1 + i));
    const View view = look({0, 0, 0}, {}, 400, 100, 60);
    const double pixels_per_metre = 200 / std::tan(0.5236) / 400;
    for (const double smallest : {0.0, 4.0, 9.0}) {
        const GroundTruth truth = ImageGenerator(scene).ground_truth(view, {.smallest_feature = smallest});
        for (int i = 0; i < 10; ++i) {
            const bool drawn = std::find(truth.object_ids.begin(), truth.object_ids.end(), i) != truth.object_ids.end();
            CAPTURE(smallest, i);
            CHECK(drawn == (2.0 * (1 + i) * pixels_per_metre >= smallest));
        }
    }
}

TEST_CASE("by interpolated distance a ball is as far away as its limb, so a wall that it pokes through hides it") {
    Scene scene;
    Object wall;
    wall.shape = Ellipsoid{{{0, 95, 0}}, {1000, 0.1, 1000}, {}};
    scene.objects = {ball({0, 100, 0}, 10), wall};
    const View view = look({0, 0, 0}, {}, 200, 200, 20);
    ImageGenerator generator(scene);
    const GroundTruth exact = generator.ground_truth(view);
    const GroundTruth paper = generator.ground_truth(view, {.distance = DistanceRule::interpolated});
    const auto shown = [](const GroundTruth& truth) {
        return std::count(truth.object_ids.begin(), truth.object_ids.end(), 0);
    };
    // The cap in front of the wall's face at 94.9 m: its rim has radius sqrt(10^2 - 5.1^2).
    const double rim = std::sqrt(100 - 5.1 * 5.1) / 94.9 / std::tan(10 * std::acos(-1.0) / 180) * 100;
    CHECK(static_cast<double>(shown(exact)) == Approx(std::acos(-1.0) * rim * rim).epsilon(0.01));
    CHECK(shown(paper) == 0);
    CHECK(paper.object_ids[100 * 200 + 100] == 1);
}

TEST_CASE("the paper's formulas in double see an everyday scene as ours do, in float nearly so") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(10); ++trial) {
        Randomness random(trial);
        Scene scene;
        for (int i = 0; i < 20; ++i)
            scene.objects.push_back(ball({random.between(-60, 60), random.between(40, 300), random.between(-30, 30)},
                                         random.between(2, 12)));
        const View view = look({0, 0, 0}, {}, 160, 120, 60);
        ImageGenerator generator(scene);
        const GroundTruth ours = generator.ground_truth(view);
        const auto different = [&](SetUp set_up) {
            const GroundTruth theirs = generator.ground_truth(view, {.set_up = set_up});
            int count = 0;
            for (std::size_t i = 0; i < ours.object_ids.size(); ++i)
                count += ours.object_ids[i] != theirs.object_ids[i];
            return count;
        };
        CAPTURE(trial);
        CHECK(different(SetUp::textbook) == 0);
        CHECK(different(SetUp::textbook_single) < 20);
    }
}

TEST_CASE("every quality gives the same bits for any number of threads") {
    Randomness random(5);
    const Scene scene = painted_scene(random, 40);
    const View view = random_view(random, 130, 99);
    std::vector<Quality> qualities{{.sub_scan_lines = 0},
                                   {.sub_scan_lines = 8},
                                   {.distance = DistanceRule::interpolated},
                                   {.smooth_stretches = false}};
    for (const ShadingRate rate : {ShadingRate::eighth, ShadingRate::quarter, ShadingRate::half, ShadingRate::four})
        qualities.push_back({.shading = rate});
    for (const SineMethod sine : {SineMethod::polynomial, SineMethod::table, SineMethod::library})
        qualities.push_back({.sine = sine});
    for (const SetUp set_up : {SetUp::textbook, SetUp::textbook_single}) qualities.push_back({.set_up = set_up});
    ImageGenerator one(scene, 1), three(scene, 3);
    for (std::size_t i = 0; i < qualities.size(); ++i) {
        CAPTURE(i);
        CHECK(render(one, view, {}, qualities[i]) == render(three, view, {}, qualities[i]));
    }
}
