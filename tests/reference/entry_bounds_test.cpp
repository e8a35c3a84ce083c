#include <catch2/catch.hpp>

#include "ig_core/reference/entry_bounds.h"
#include "ig_core/reference/seen_scene.h"
#include "tests/ig_core/random_objects.h"
#include "tests/reference/scene_makers.h"

using namespace quadrig;
using namespace quadrig::reference;
using quadrig::test::Randomness;
using Verdict = EntryBounds::Verdict;

namespace {

Vector<double> to_vector(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
Vector<Quad> to_quad(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// A direction that has a fair chance to meet a solid of `size` about `place`.
glm::dvec3 random_direction(Randomness& random, const glm::dvec3& place, double size) {
    const glm::dvec3 towards = place + random.vector(size);
    return towards / std::max(1e-9, glm::length(towards)) * random.between(1, 3);
}

}  // namespace

TEST_CASE("what is certain of a bundle of rays holds for every ray of it") {
    INFO("seed " << test::seed());
    int misses = 0, enters = 0, in_doubt = 0;
    for (int trial = 0; trial < test::trials(1500); ++trial) {
        Randomness random(trial);
        const double size = random.log_between(0.01, 100), distance = size * random.log_between(0.01, 1000);
        const glm::dvec3 centre = random.vector(distance);
        const Object object = test::random_object(random, test::random_kind(random), centre, size);
        const Solid<Quad> exact = solid_about_eye(object, {});
        const Solid<double> solid = rounded<double>(exact);
        for (int ray = 0; ray < 10; ++ray) {
            const glm::dvec3 direction = random_direction(random, centre, size);
            const double reach = random.log_between(1e-12, 1e-2);
            const EntryBounds bounds = entry_bounds(solid, to_vector(direction), reach);
            (bounds.verdict == Verdict::misses ? misses : bounds.verdict == Verdict::enters ? enters : in_doubt)++;
            for (int other = 0; other < 8; ++other) {
                const double share = other == 0 ? 0.0 : other < 5 ? 0.999999 : random.between(0, 1);
                const auto hit = entry(exact, to_quad(direction + share * reach * random.direction()));
                INFO("trial " << trial << " ray " << ray << " reach " << reach);
                if (bounds.verdict == Verdict::misses) REQUIRE_FALSE(hit);
                if (bounds.verdict == Verdict::enters) {
                    REQUIRE(hit);
                    REQUIRE(hit->surface == bounds.surface);
                    REQUIRE(static_cast<double>(hit->depth) <= bounds.greatest_depth);
                }
                if (hit) REQUIRE(static_cast<double>(hit->depth) >= bounds.least_depth);
            }
        }
    }
    CHECK(misses > in_doubt);
    CHECK(enters > in_doubt);
}

TEST_CASE("a level plane is certain to be met, or missed, where every ray of a bundle goes down, or up") {
    const EntryBounds down = level_plane_bounds(-2, {0, 1, -0.1}, 0.01);
    CHECK(down.verdict == Verdict::enters);
    CHECK((17 < down.least_depth && down.least_depth <= 2 / 0.11));
    CHECK((2 / 0.09 <= down.greatest_depth && down.greatest_depth < 23));
    CHECK(level_plane_bounds(-2, {0, 1, 0.1}, 0.01).verdict == Verdict::misses);
    CHECK(level_plane_bounds(3, {0, 1, 0.1}, 0.01).verdict == Verdict::enters);
    CHECK(level_plane_bounds(-2, {0, 1, -0.005}, 0.01).verdict == Verdict::in_doubt);
    CHECK(level_plane_bounds(0, {0, 1, -0.1}, 0.01).verdict == Verdict::misses);
}

TEST_CASE("every pixel has the answer of quadruple precision, and is a tie where that changes nearby") {
    INFO("seed " << test::seed());
    const int width = 40, height = 30;
    int drawn = 0, ties = 0;
    for (int trial = 0; trial < test::trials(12); ++trial) {
        Randomness random(100'000 + trial);
        Scene scene;
        if (random.chance(0.5)) scene.ground.emplace();
        const View view = look(random.vector(5), random.attitude(), width, height, random.between(5, 120));
        const glm::dmat3 scene_from_eye = glm::transpose(view.eye_from_scene);
        for (int i = 0; i < 8; ++i)
            scene.objects.push_back(
                test::random_object(random, test::random_kind(random),
                                    view.eye.metres + scene_from_eye * glm::dvec3(0, 20, 0) + random.vector(5),
                                    random.log_between(0.5, 8)));
        scene.objects.push_back(scene.objects.front());  // ties on all of its picture
        const SeenScene seen(scene, view);
        const auto nearest = [&](Quad column, Quad row) {
            const auto direction = ray_direction<Quad>(view, column, row);
            Entry<Quad> best{std::numeric_limits<long double>::infinity(), 0};
            std::int32_t object = kSkyId;
            for (std::size_t i = 0; i < scene.objects.size(); ++i) {
                const auto hit = entry(seen.exact[i], direction);
                if (hit && in_front(hit->depth, best.depth)) best = *hit, object = static_cast<std::int32_t>(i);
            }
            if (scene.ground)
                if (const auto depth = level_depth(view, 0.0, direction); depth && in_front(*depth, best.depth))
                    best = {*depth, 0}, object = kGroundId;
            return std::pair(object, best);
        };
        std::vector<std::uint8_t> is_tie;
        const GroundTruth truth = ground_truth(scene, view, &is_tie);
        for (int pixel = 0; pixel < width * height; ++pixel) {
            const auto at = static_cast<std::size_t>(pixel);
            const Quad column = pixel % width + Quad(0.5), row = pixel / width + Quad(0.5);
            const auto [object, hit] = nearest(column, row);
            INFO("trial " << trial << " column " << pixel % width << " row " << pixel / width);
            REQUIRE(truth.object_ids[at] == object);
            REQUIRE(truth.surface_ids[at] == hit.surface);
            if (object != kSkyId) REQUIRE(truth.depth[at] == Approx(static_cast<double>(hit.depth)).epsilon(1e-12));
            bool changes = false;
            for (const double across : {-1e-6, 0.0, 1e-6})
                for (const double down : {-1e-6, 0.0, 1e-6}) {
                    const auto other = nearest(column + across, row + down);
                    changes = changes || other.first != object || other.second.surface != hit.surface;
                }
            if (changes) REQUIRE(is_tie[at] == kTie);
            if (object == 0) REQUIRE(is_tie[at] != 0);
            drawn += object >= 0;
            ties += is_tie[at] != 0;
        }
    }
    CHECK(drawn > 1500);
    CHECK(ties > 50);
}

TEST_CASE("a quadric that is nowhere positive is all space: its planes alone make the solid") {
    const auto middle_depth = [](const GeneralQuadric& quadric) {
        return seen_in_the_middle(scene_of({solid(quadric, {{{0, 1, 0, -7}}})}), look_north({0, 0, 0})).depth;
    };
    CHECK(middle_depth({{0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}) == 7);
    CHECK(middle_depth({{0, 0, 0, 0, 0, 0, 0, 0, 0, -2}}) == 7);
    CHECK(middle_depth({{-1, -1, -1, 0, 0, 0, 0, 0, 0, 0}}) == 7);
    CHECK(middle_depth({{-1, -2, -1, 0, 0, 0, 0, 0, 0, -1}}) == 7);
    CHECK(std::isinf(middle_depth({{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}})));
    CHECK(std::isinf(middle_depth({{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}})));
}

TEST_CASE("from the apex of a cone its inside is seen, and its outside is not") {
    const Scene scene = scene_of({solid(GeneralQuadric{{1, -1, 1, 0, 0, 0, 0, 0, 0, 0}}, {{{0, 1, 0, -3}}})});
    const View view = look({0, 0, 0}, {}, 65, 65, 120.0);
    CHECK(seen_at(scene, view, 32, 32).depth == 3);
    CHECK(seen_at(scene, view, 40, 32).surface == 1);
    CHECK(seen_at(scene, view, 60, 60).object == kSkyId);
}
