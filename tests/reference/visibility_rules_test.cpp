#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/reference/scene_makers.h"

using namespace quadrig;
using namespace quadrig::reference;

namespace {

/// Pixel centres at whole and a half: x and z are -1.5, -0.5, 0.5, 1.5.
View four_by_four(glm::dvec3 eye) { return {{eye}, glm::dmat3(1.0), {4, 4, -2.0, 1.0, 2.0, 1.0}}; }

Scene with_ground(Scene scene) {
    scene.ground = Ground{};
    return scene;
}

std::vector<std::uint8_t> ties_of(const Scene& scene, const View& view) {
    std::vector<std::uint8_t> ties;
    ground_truth(scene, view, &ties);
    return ties;
}

}  // namespace

TEST_CASE("an empty scene is sky everywhere") {
    std::vector<std::uint8_t> ties;
    const GroundTruth truth = ground_truth(Scene{}, four_by_four({0, 0, 0}), &ties);
    CHECK(truth.object_ids == std::vector<std::int32_t>(16, kSkyId));
    CHECK(truth.surface_ids == std::vector<std::int32_t>(16, 0));
    CHECK(truth.depth == std::vector<double>(16, std::numeric_limits<double>::infinity()));
    CHECK(ties == std::vector<std::uint8_t>(16, 0));
}

TEST_CASE("a solid with the eye in it is not drawn, and what stands behind it is") {
    const Scene scene =
        scene_of({solid(sphere({0, 1, 0}, 5)), box({-9, -1, -9}, {9, 3, 9}), solid(sphere({0, 100, 0}, 60))});
    const GroundTruth truth = ground_truth(scene, look({0, 0, 0}, {}));
    CHECK(truth.object_ids == std::vector<std::int32_t>(65 * 65, 2));
}

TEST_CASE("a solid entered at a depth of 0.1 or less is not drawn on that ray") {
    const auto wall_at = [](double distance) { return scene_of({box({-50, distance, -50}, {50, 60, 50})}); };
    CHECK(seen_in_the_middle(wall_at(0.1), four_by_four({0, 0, 0})).object == kSkyId);
    CHECK(seen_in_the_middle(wall_at(0.05), four_by_four({0, 0, 0})).object == kSkyId);
    CHECK(seen_in_the_middle(wall_at(std::nextafter(0.1, 1.0)), four_by_four({0, 0, 0})).object == 0);
    // A wall askew is nearer than that on some rays only: k (1 + x) = 0.2 with x = -1.5, -0.5, 0.5, 1.5.
    const Scene askew = scene_of({solid(sphere({0, 0, 0}, 50), {{{1, 1, 0, -0.2}}})});
    const View view = four_by_four({0, 0, 0});
    CHECK(seen_at(askew, view, 0, 1).object == kSkyId);
    CHECK(seen_at(askew, view, 1, 1).depth == Approx(0.4).epsilon(1e-15));
    CHECK(seen_at(askew, view, 2, 1).depth == Approx(0.2 / 1.5).epsilon(1e-15));
    CHECK(seen_at(askew, view, 3, 1).object == kSkyId);
}

TEST_CASE("what lies behind the eye is not drawn") {
    const Scene scene = scene_of({solid(sphere({0, -100, 0}, 50)), box({-500, -30, -500}, {500, -20, 500})});
    CHECK(ground_truth(scene, look({0, 0, 0}, {})).object_ids == std::vector<std::int32_t>(65 * 65, kSkyId));
}

TEST_CASE("the nearest solid wins, equal depths go to the first in the file, and the ground comes last") {
    const View view = four_by_four({0, 0, 0});
    const Object near_wall = box({-50, 10, -50}, {50, 20, 50}), far_wall = box({-50, 11, -50}, {50, 20, 50});
    CHECK(seen_in_the_middle(scene_of({far_wall, near_wall}), view).object == 1);
    Object same_wall_scaled = near_wall;
    for (auto& plane : same_wall_scaled.planes)
        for (double& b : plane.coefficients) b *= 3.0;
    CHECK(seen_in_the_middle(scene_of({far_wall, near_wall, same_wall_scaled}), view).object == 1);
    CHECK(seen_in_the_middle(scene_of({far_wall, same_wall_scaled, near_wall}), view).object == 1);
    const Scene floor = with_ground(scene_of({box({-90, -90, 0}, {90, 90, 1})}));
    const Seen from_below = seen_in_the_middle(floor, look({0, 0, -3}, {{0}, {90}, {0}}));
    CHECK(from_below.object == 0);
    CHECK(from_below.surface == 6);
    CHECK(from_below.depth == Approx(3).epsilon(1e-15));
}

TEST_CASE("a face given twice at another scale is one face: the first object has it on every ray") {
    const auto slab = [](double scale) {
        const Shape quadric = GeneralQuadric{{scale, scale, scale, 0, 0, 0, 0, 0, 0, -900 * scale}};
        return solid(quadric, {{{-scale, -3 * scale, -7 * scale, 50 * scale}}});
    };
    const View view = look({3.1, 41.7, 30.3}, {{183}, {-31}, {13}});
    for (const auto& [first, second] : {std::pair{1.0, 3.0}, {3.0, 1.0}, {5.0, 7.0}, {7.0, 5.0}}) {
        const GroundTruth truth = ground_truth(scene_of({slab(first), slab(second)}), view);
        int drawn = 0;
        for (const std::int32_t object : truth.object_ids) {
            REQUIRE(object != 1);
            drawn += object == 0;
        }
        CHECK(drawn > 1000);
    }
}

TEST_CASE("the ground is seen from either side, below and above the horizon respectively") {
    const Scene scene = with_ground({});
    const GroundTruth above = ground_truth(scene, four_by_four({7, 8, 3})),
                      below = ground_truth(scene, four_by_four({7, 8, -3}));
    for (std::size_t pixel = 0; pixel < 16; ++pixel) {
        const double z = 1.5 - static_cast<double>(pixel / 4);
        CHECK(above.object_ids[pixel] == (z < 0 ? kGroundId : kSkyId));
        CHECK(below.object_ids[pixel] == (z > 0 ? kGroundId : kSkyId));
        if (z < 0) CHECK(above.depth[pixel] == 3 / -z);
        if (z > 0) CHECK(below.depth[pixel] == 3 / z);
    }
    CHECK(ground_truth(scene, four_by_four({7, 8, 0})).object_ids == std::vector<std::int32_t>(16, kSkyId));
}

TEST_CASE("a ray along the horizon meets no level plane, however its direction was rounded") {
    Scene scene = with_ground({});
    CloudDeck deck;
    deck.altitude = 2000.0;
    deck.paint.colour = {1, 0, 0};
    scene.sky = {{0, 0, 1}, {0, 0, 1}};
    scene.cloud_decks = {deck};
    for (int trial = 0; trial < 400; ++trial) {
        const View view = look({0, 0, 10}, {{0.9 * trial}, {}, {}}, 5, 3 + 2 * (trial % 150), 1.0 + 0.4 * trial);
        CAPTURE(trial);
        CHECK(seen_in_the_middle(scene, view).object == kSkyId);
        const LinearImage image = picture(scene, view, {}, 1);
        const auto middle = 3 * (static_cast<std::size_t>(image.height / 2) * 5 + 2);
        CHECK(image.rgb[middle] == 0.0F);
        CHECK(image.rgb[middle + 2] == 1.0F);
    }
}

TEST_CASE("solids without thickness and rays that only touch draw nothing") {
    const View view = look({0.25, 0, 0}, {{1}, {2}, {3}});
    const auto draws_nothing = [&](const Object& object) {
        const GroundTruth truth = ground_truth(scene_of({object}), view);
        return truth.object_ids == std::vector<std::int32_t>(truth.object_ids.size(), kSkyId);
    };
    CHECK(draws_nothing(solid(GeneralQuadric{{0, 1, 0, 0, 0, 0, 0, -14, 0, 49}})));     // (Y - 7)^2 <= 0
    CHECK(draws_nothing(solid(GeneralQuadric{{1, 9, 0, 6, 0, 0, -10, -30, 0, 25}})));   // (X + 3Y - 5)^2 <= 0
    CHECK(draws_nothing(solid(GeneralQuadric{{1, 1, 0, 0, 0, 0, 0, -2e7, 0, 1e14}})));  // the line X = 0, Y = 1e7
    CHECK(draws_nothing(solid(GeneralQuadric{{1, 1, 1, 0, 0, 0, 0, -14, 0, 49}})));     // the point Y = 7
    CHECK(draws_nothing(solid(GeneralQuadric{{1, 1, 1, 0, 0, 0, 0, -14, 0, 49.01}})));  // empty
    CHECK(draws_nothing(solid(sphere({0, 7, 0}, 3), {{{1, 2, 3, -13}}, {{-3, -6, -9, 39}}})));
    CHECK_FALSE(draws_nothing(solid(sphere({0, 7, 0}, 3), {{{1, 2, 3, -13}}, {{-3, -6, -9, 39.001}}})));

    // A ray that runs in a bounding plane is not inside it.
    const View level{{{0, 0, 2}}, glm::dmat3(1.0), {1, 1, -0.5, 1.0, 0.5, 1.0}};
    CHECK(seen_in_the_middle(scene_of({solid(sphere({0, 20, 2}, 5), {{{0, 0, 1, -2}}})}), level).object == kSkyId);
    CHECK(seen_in_the_middle(scene_of({solid(sphere({0, 20, 2}, 5), {{{0, 0, 1, -1.9}}})}), level).object == 0);

    // The middle ray has the direction (3, 4, 0) / 4 and touches the cylinder of radius 5 about (10, 5) at (6, 8).
    const View touching{{{0, 0, 0}}, glm::dmat3(1.0), {1, 1, 0.5, 0.5, 1.0, 2.0}};
    const auto cylinder = [](double constant) {
        return scene_of({solid(GeneralQuadric{{1, 1, 0, 0, 0, 0, -20, -10, 0, constant}})});
    };
    CHECK(seen_in_the_middle(cylinder(100), touching).object == kSkyId);
    CHECK(seen_in_the_middle(cylinder(100 - 1e-12), touching).object == 0);
}

TEST_CASE("the numbers of the file are exact: scale of coefficients and distance from the origin change nothing") {
    const auto ellipsoid_at = [](double offset, double scale) {
        // ((X - offset)^2 + (Y - offset - 50)^2) / 4 + Z^2 = 1, cut at Z > -1/2
        const double y = offset + 50;
        GeneralQuadric quadric{
            {0.25, 0.25, 1, 0, 0, 0, -0.5 * offset, -0.5 * y, 0, 0.25 * (offset * offset + y * y) - 1}};
        for (double& q : quadric.coefficients) q *= scale;
        return scene_of({solid(quadric, {{{0, 0, 2, 1}}})});
    };
    const auto truth = [&](double offset, double scale) {
        return ground_truth(ellipsoid_at(offset, scale), look({offset, offset, 1}, {{0}, {-1}, {0}}, 65, 65, 8));
    };
    const GroundTruth near_origin = truth(0, 1);
    CHECK(near_origin.object_ids[32 * 65 + 32] == 0);
    for (const auto& [offset, scale] :
         {std::pair{8388608.0, 1.0}, {0.0, 0x1p40}, {0.0, 0x1p-40}, {8388608.0, 0x1p-40}}) {
        INFO("offset " << offset << ", scale " << scale);
        const GroundTruth other = truth(offset, scale);
        CHECK(other.object_ids == near_origin.object_ids);
        CHECK(other.surface_ids == near_origin.surface_ids);
        CHECK(other.depth == near_origin.depth);
    }
}

TEST_CASE("ties are the pixels on an edge and those where two depths agree, and no others") {
    const View view = four_by_four({0, 0, 0});
    // At Y = 10 the wall's west edge projects to x = 0.5, its other edges to +-8.
    const Scene edge = scene_of({box({5, 10, -80}, {80, 20, 80})});
    const auto on_edge = ties_of(edge, view);
    const auto beside = ties_of(scene_of({box({5 + 2e-5, 10, -80}, {80, 20, 80})}), view);
    for (std::size_t pixel = 0; pixel < 16; ++pixel) CHECK(on_edge[pixel] == (pixel % 4 == 2));
    CHECK(beside == std::vector<std::uint8_t>(16, 0));

    const auto two_walls = [&](double second) {
        return ties_of(scene_of({box({-80, 10, -80}, {80, 20, 80}), box({-80, second, -80}, {80, 20, 80})}), view);
    };
    CHECK(two_walls(10 + 1e-9) == std::vector<std::uint8_t>(16, kTieInDepth));
    CHECK(two_walls(10 + 1e-7) == std::vector<std::uint8_t>(16, 0));

    // The line where two faces meet: surfaces change there, the object does not.
    const auto ridge = ties_of(scene_of({solid(sphere({5, 10, 0}, 60), {{{-1, 1, 0, -5}}, {{1, 1, 0, -15}}})}), view);
    for (std::size_t pixel = 0; pixel < 16; ++pixel) CHECK(ridge[pixel] == (pixel % 4 == 2));
}
