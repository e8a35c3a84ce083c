#include "ig_core/clusters/places.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "ig_core/clusters/dice.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

std::vector<clusters::Place> all_places(const clusters::Cluster& cluster) {
    return clusters::places(cluster, cluster.seed, {0.0, 0.0}, [](const glm::dvec2&) { return true; });
}

double nearest_two(const std::vector<clusters::Place>& places) {
    double nearest = INFINITY;
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            nearest = std::min(nearest, glm::distance(places[i].position, places[j].position));
    return nearest;
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const double along = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(p, a + along * (b - a));
}

bool same(const clusters::Place& a, const clusters::Place& b) { return a.position == b.position && a.seed == b.seed; }

}  // namespace

TEST_CASE("the dice are SplitMix64") {
    clusters::Dice dice(1234567);
    for (const std::uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                         4593380528125082431u, 16408922859458223821u})
        CHECK(dice.next() == expected);
}

TEST_CASE("places fill rectangle, ellipse and polygon at the spacing, and none lies outside") {
    clusters::Cluster cluster;
    cluster.spacing = 7.0;
    const double cell = 7.0 * 7.0 * std::sqrt(3.0) / 2.0;
    for (const double stray : {0.0, 0.4, 1.0}) {
        cluster.variation.position = stray;
        cluster.region = clusters::Rectangle{{-210, 30}, {300, 520}};
        auto found = all_places(cluster);
        CHECK(double(found.size()) == Approx(510.0 * 490.0 / cell).epsilon(0.04));
        for (const auto& place : found) CHECK((place.position.x >= -210 && place.position.y <= 520));
        if (stray == 0.0) CHECK(nearest_two(found) == Approx(7.0));
        if (stray > 0.0) CHECK(nearest_two(found) < 6.0);

        cluster.region = clusters::Ellipse{{40, -80}, {300, 150}};
        found = all_places(cluster);
        CHECK(double(found.size()) == Approx(std::acos(-1.0) * 300 * 150 / cell).epsilon(0.04));
        for (const auto& [p, own_seed] : found)
            CHECK(std::pow((p.x - 40) / 300, 2) + std::pow((p.y + 80) / 150, 2) <= 1.0 + 1e-12);

        // An L: two thirds of its box and a bit.
        cluster.region = clusters::Polygon{{{0, 0}, {400, 0}, {400, 100}, {100, 100}, {100, 400}, {0, 400}}};
        found = all_places(cluster);
        CHECK(double(found.size()) == Approx(70000 / cell).epsilon(0.04));
        for (const auto& [p, own_seed] : found) CHECK((p.x <= 100 || p.y <= 100));
    }
}

TEST_CASE("places along a path keep to its width and follow its length") {
    clusters::Cluster cluster;
    cluster.spacing = 10.0;
    cluster.region = clusters::Path{{{0, 0}, {300, 400}, {300, 900}}, 0.0};
    auto found = all_places(cluster);
    CHECK(found.size() == 101);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double along = 10.0 * double(i);
        const glm::dvec2 expected = along <= 500 ? glm::dvec2(0.6 * along, 0.8 * along) : glm::dvec2(300, along - 100);
        CHECK(glm::distance(found[i].position, expected) < 1e-9);
    }
    cluster.region = clusters::Path{{{0, 0}, {300, 400}, {300, 900}}, 35.0};
    cluster.variation.position = 0.25;
    found = all_places(cluster);
    CHECK(found.size() == 404);
    for (const auto& [p, own_seed] : found)
        CHECK(std::min(distance_to_segment(p, {0, 0}, {300, 400}), distance_to_segment(p, {300, 400}, {300, 900})) <=
              15.0 + 2.5 + 1e-9);
}

TEST_CASE("a region that is made larger keeps the places it had, and another seed has others") {
    clusters::Cluster cluster;
    cluster.spacing = 5.0;
    cluster.seed = 11;
    cluster.variation.position = 0.5;
    cluster.region = clusters::Ellipse{{0, 0}, {60, 90}};
    const auto small = all_places(cluster);
    cluster.region = clusters::Rectangle{{-100, -95}, {100, 140}};
    const auto large = all_places(cluster);
    REQUIRE(small.size() > 500);
    for (const auto& place : small)
        CHECK(std::any_of(large.begin(), large.end(), [&](const auto& other) { return same(place, other); }));
    cluster.seed = 12;
    for (const auto& place : all_places(cluster))
        CHECK(std::none_of(large.begin(), large.end(), [&](const auto& other) { return same(place, other); }));
}

TEST_CASE("a count takes that many of the places, all over the region and in their order") {
    clusters::Cluster cluster;
    cluster.spacing = 5.0;
    cluster.region = clusters::Rectangle{{0, 0}, {500, 500}};
    const auto all = all_places(cluster);
    cluster.count = 400;
    const auto some = all_places(cluster);
    REQUIRE(some.size() == 400);
    auto from = all.begin();
    for (const auto& place : some) {
        from = std::find_if(from, all.end(), [&](const auto& other) { return same(place, other); });
        REQUIRE(from != all.end());
    }
    for (int quarter = 0; quarter < 4; ++quarter)
        CHECK(std::count_if(some.begin(), some.end(), [&](const auto& place) {
                  return (place.position.x > 250) == (quarter % 2 == 1) && (place.position.y > 250) == (quarter > 1);
              }) > 70);
    cluster.count = all.size() + 1;
    CHECK(all_places(cluster).size() == all.size());
}
