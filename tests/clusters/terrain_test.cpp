#include "ig_core/clusters/terrain.h"

#include <catch2/catch.hpp>

#include "ig_core/clusters/turn.h"
#include "tests/clusters/solids.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

TEST_CASE("the terrain's height is where hills end: in one just below, in none above") {
    long raised = 0;
    for (int trial = 0; trial < trials(400); ++trial) {
        Randomness random(trial);
        std::vector<Object> hills(5);
        clusters::Terrain terrain;
        for (Object& hill : hills) {
            hill.shape = Hill{{{random.between(-900, 900), random.between(-900, 900), random.between(5, 400)}},
                              random.between(20, 800),
                              random.between(0.1, 2)};
            for (double planes = random.between(0, 3); planes > 1.0; planes -= 1.0)
                hill.planes.push_back({{random.between(-1, 1), random.between(-1, 1), random.between(-0.4, 0.4),
                                        random.between(-200, 800)}});
            terrain.add(hill);
        }
        for (int i = 0; i < 20; ++i) {
            const glm::dvec2 at(random.between(-1000, 1000), random.between(-1000, 1000));
            const double height = terrain.height(at);
            const double step = 1e-6 * (1.0 + std::abs(height));
            CAPTURE(seed(), trial, at.x, at.y, height);
            for (const double above : {step, 1.0, 30.0, 500.0})
                CHECK_FALSE(in_any(hills, {at.x, at.y, height + above}));
            CHECK(height >= 0.0);
            if (height == 0.0) continue;
            CHECK(in_any(hills, {at.x, at.y, height - step}));
            ++raised;
        }
    }
    CHECK(raised > trials(400) * 5L);
}

TEST_CASE("a point in the plane that two hills share stands on them, not between them") {
    Object west, east;
    west.shape = Hill{{{-10, 0, 50}}, 100, 0.5};
    east.shape = Hill{{{10, 0, 50}}, 100, 0.5};
    west.planes = {{{-1, 0, 0, 0}}};
    east.planes = {{{1, 0, 0, 0}}};
    clusters::Terrain terrain;
    terrain.add(west);
    terrain.add(east);
    CHECK(terrain.height({0.0, 3.0}) == Approx(clusters::surface_height(std::get<Hill>(west.shape), {0, 3})));
    CHECK(terrain.height({0.0, 3.0}) > 49.0);
}

TEST_CASE("sines by addition and multiplication are sines") {
    for (int i = 0; i < trials(20000); ++i) {
        Randomness random(i);
        const double degrees = i < 100 ? 15.0 * (i - 50) : random.between(-1e3, 1e3);
        const auto [sine, cosine] = clusters::sine_cosine({degrees});
        const Long radians = std::fmod(static_cast<Long>(degrees), 360.0L) * std::acos(-1.0L) / 180;
        CAPTURE(degrees);
        CHECK(std::abs(sine - std::sin(radians)) < 4e-16L);
        CHECK(std::abs(cosine - std::cos(radians)) < 4e-16L);
    }
    CHECK(clusters::sine_cosine({90}).cosine == 0.0);
    CHECK(clusters::sine_cosine({180}).sine == 0.0);
    CHECK(clusters::sine_cosine({-360}).cosine == 1.0);
}
