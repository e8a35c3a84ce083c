#include "ig_core/select.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "ig_core/strip_index.h"
#include "tests/ig_core/exact_solid.h"
#include "tests/ig_core/random_objects.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

struct SelectCase {
    View view;
    std::vector<Object> objects;
    std::vector<Solid> solids;
    std::vector<SolidExtents> extents;
};

/// Solids of every kind all around an eye, some of which hold it.
SelectCase random_case(Randomness& random) {
    constexpr std::size_t kObjects = 45;  // the last vector is not full
    SelectCase given;
    given.view = {{random.vector(1e4)},
                  eye_from_scene_rotation(random.attitude()),
                  ImagePlane::symmetric(32, 24, {random.between(20, 110)})};
    for (std::size_t i = 0; i < kObjects; ++i) {
        const double size = random.log_between(0.5, 200);
        const glm::dvec3 centre = given.view.eye.metres + random.log_between(0.3, 60) * size * random.direction();
        given.objects.push_back(random_object(random, random_kind(random), centre, size));
        given.solids.push_back(make_solid(given.objects.back()));
        given.extents.resize(i / SolidExtents::kSolids + 1);
        given.extents.back().set(i % SolidExtents::kSolids, given.solids.back());
    }
    return given;
}

std::vector<InView> selected(const SelectCase& given, std::uint32_t first) {
    std::vector<InView> in_view(given.extents.size() * SolidExtents::kSolids);
    in_view.resize(select(given.extents, first, given.view, in_view.data()));
    return in_view;
}

bool is_seen(const Object& object, const View& view) {
    const ExactSolid exact = exact_solid(object, view.eye);
    for (int r = 0; r < view.image.height; ++r)
        for (int c = 0; c < view.image.width; ++c)
            if (surface_through(exact, view.eye_from_scene, view.image.x(c + 0.5), view.image.z(r + 0.5)) >= 0)
                return true;
    return false;
}

}  // namespace

TEST_CASE("What is selected has the bounds of its solid by itself, bit for bit on every instruction set") {
    for (const std::int64_t target : simd_targets()) {
        const SimdTarget on(target);
        INFO(hwy::TargetName(target));
        for (int trial = 0; trial < trials(200, 40); ++trial) {
            Randomness random(trial);
            const SelectCase given = random_case(random);
            constexpr std::uint32_t kFirst = 1024;
            for (const InView& seen : selected(given, kFirst)) {
                const Solid& solid = given.solids[seen.object - kFirst];
                const ImageBounds expected = image_bounds(solid, given.view.eye, given.view.eye_from_scene);
                REQUIRE(seen.bounds.x_from == expected.x_from);
                REQUIRE(seen.bounds.x_to == expected.x_to);
                REQUIRE(seen.bounds.z_from == expected.z_from);
                REQUIRE(seen.bounds.z_to == expected.z_to);
                REQUIRE(seen.bounds.nearest == expected.nearest);
                REQUIRE(seen.bounds.farthest == expected.farthest);
            }
        }
    }
}

TEST_CASE("What a ray through a pixel meets is selected, and what lies behind the eye is not") {
    int met = 0, behind = 0;
    for (int trial = 0; trial < trials(40, 10); ++trial) {
        Randomness random(trial);
        const SelectCase given = random_case(random);
        const std::vector<InView> in_view = selected(given, 0);
        const glm::dvec3 look = glm::transpose(given.view.eye_from_scene)[1];
        for (std::uint32_t i = 0; i < given.objects.size(); ++i) {
            const bool found =
                std::any_of(in_view.begin(), in_view.end(), [&](const InView& seen) { return seen.object == i; });
            INFO("trial " << trial << ", object " << i);
            const Solid& solid = given.solids[i];
            if (glm::dot(look, solid.anchor.metres - given.view.eye.metres) + solid.radius < 0.0) {
                ++behind;
                REQUIRE_FALSE(found);
            } else if (is_seen(given.objects[i], given.view)) {
                ++met;
                REQUIRE(found);
            }
        }
    }
    CHECK(met > 50);
    CHECK(behind > 50);
}

TEST_CASE("What has been taken away is not selected") {
    Randomness random(0);
    SelectCase given = random_case(random);
    for (SolidExtents& extents : given.extents)
        for (std::size_t lane = 0; lane < SolidExtents::kSolids; ++lane) extents.clear(lane);
    CHECK(selected(given, 0).empty());
}

TEST_CASE("A thing is on every strip from its first to its last and on no other, in the order of things") {
    Randomness random(0);
    StripIndex index;
    for (const int strips : {1, 2, 7, 135}) {
        std::vector<std::pair<int, int>> of_things;
        for (int i = 0; i < 300; ++i) {
            const int one = static_cast<int>(random.between(0, strips));
            const int other = static_cast<int>(random.between(0, strips));
            of_things.emplace_back(std::min(one, other), std::max(one, other));
            if (i % 5 == 0) of_things.back() = {1, 0};
        }
        index.sort(strips, of_things.size(), [&](std::size_t i) { return of_things[i]; });
        for (int strip = 0; strip < strips; ++strip) {
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < of_things.size(); ++i)
                if (of_things[i].first <= strip && strip <= of_things[i].second) expected.push_back(i);
            const auto on = index.on(strip);
            CHECK(std::vector(on.begin(), on.end()) == expected);
        }
    }
}
