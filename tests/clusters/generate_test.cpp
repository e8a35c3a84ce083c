#include "ig_core/clusters/generate.h"

#include <catch2/catch.hpp>
#include <set>

#include "tests/clusters/solids.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;
using clusters::Cluster;

namespace {

/// Balls that touch the ground: the lowest point of each is its foot.
Object ball() {
    Object object;
    object.shape = Ellipsoid{{{0, 0, 5}}, {4, 4, 5}, {}};
    object.paint.colour = {0.4, 0.6, 0.2};
    return object;
}
Object mound() {
    Object object;
    object.shape = Hill{{{0, 0, 80}}, 200, 0.6};
    object.planes = {{{0, 0, 1, 0}}};
    return object;
}
Cluster cluster_of(const char* name, const Object& object, double spacing, double reach) {
    Cluster cluster;
    cluster.name = name;
    cluster.spacing = spacing;
    cluster.region = clusters::Ellipse{{0, 0}, {reach, reach}};
    cluster.variation.position = 0.4;
    cluster.templates = {{1.0, object}};
    return cluster;
}
Cluster downs() {
    Cluster cluster = cluster_of("down", mound(), 300, 900);
    cluster.variation.size = 0.3;
    cluster.terrain = true;
    cluster.abutting = 6;
    return cluster;
}

const Ellipsoid& ellipsoid(const Object& object) { return std::get<Ellipsoid>(object.shape); }
glm::dvec3 foot(const Object& object) {
    return ellipsoid(object).centre.metres - glm::dvec3(0, 0, ellipsoid(object).semi_axes.z);
}
std::vector<Object> of_kind(const std::vector<Object>& objects, const std::string& name) {
    std::vector<Object> found;
    for (const Object& object : objects)
        if (object.name.starts_with(name + "-")) found.push_back(object);
    return found;
}

bool stands(const glm::dvec3& foot, std::span<const Object> ground) {
    const double step = 1e-6 * (1.0 + std::abs(foot.z));
    return !in_any(ground, {foot.x, foot.y, foot.z + step}) &&
           (foot.z == 0.0 || in_any(ground, {foot.x, foot.y, foot.z - step}));
}

}  // namespace

TEST_CASE("what is planted on terrain stands on it with its feet, whatever its size and shape") {
    Cluster trees = cluster_of("tree", ball(), 25, 1000);
    trees.variation.size = 0.4;
    trees.variation.shape = 0.3;
    // Named first: terrain comes before it all the same.
    const std::vector<Cluster> both{trees, downs()};
    const auto objects = clusters::generate(both, {});
    const auto hills = of_kind(objects, "down"), planted = of_kind(objects, "tree");
    REQUIRE(hills.size() > 20);
    REQUIRE(planted.size() > 3000);
    CHECK(objects.front().name == "down-1");
    CHECK(objects.size() == hills.size() + planted.size());
    std::size_t raised = 0;
    for (const Object& tree : planted) {
        CAPTURE(tree.name);
        CHECK(stands(foot(tree), hills));
        raised += foot(tree).z > 0.0 ? 1 : 0;
    }
    CHECK(raised > planted.size() / 2);
    for (const Object& hill : hills) CHECK(hill.planes.front().coefficients == std::array<double, 4>{0, 0, 1, 0});
}

TEST_CASE("hills that the scene file has are terrain too") {
    std::vector<Object> written(1, mound());
    Cluster trees = cluster_of("tree", ball(), 20, 250);
    const auto planted = clusters::generate({&trees, 1}, written);
    REQUIRE(planted.size() > 100);
    for (const Object& tree : planted) CHECK(stands(foot(tree), written));
}

TEST_CASE("an altitude puts a cluster in the air, an elevation keeps it to a part of the slopes") {
    std::vector<Cluster> three{downs(), cluster_of("cloud", ball(), 100, 1000), cluster_of("pine", ball(), 25, 1000)};
    three[1].altitude = 700.0;
    three[1].variation.altitude = 50.0;
    three[2].elevation = glm::dvec2(30, 60);
    const auto objects = clusters::generate(three, {});
    double lowest = INFINITY, highest = -INFINITY;
    for (const Object& cloud : of_kind(objects, "cloud")) {
        lowest = std::min(lowest, foot(cloud).z);
        highest = std::max(highest, foot(cloud).z);
    }
    CHECK(lowest >= 650.0);
    CHECK(lowest < 660.0);
    CHECK(highest <= 750.0);
    CHECK(highest > 740.0);
    const auto hills = of_kind(objects, "down"), pines = of_kind(objects, "pine");
    REQUIRE(pines.size() > 300);
    for (const Object& pine : pines) {
        CHECK(foot(pine).z >= 30.0);
        CHECK(foot(pine).z <= 60.0);
        CHECK(stands(foot(pine), hills));
    }
}

TEST_CASE("clusters of clusters of clusters: copses in woods on ranges of hills") {
    Cluster hills = downs();
    hills.terrain = false;  // what places it decides
    hills.region = clusters::Ellipse{{0, 0}, {500, 300}};
    Cluster ranges = cluster_of("range", ball(), 2500, 3000);
    ranges.templates = {{1.0, std::size_t{0}}};
    ranges.terrain = true;
    const Cluster copse = cluster_of("copse", ball(), 10, 30);
    Cluster wood = cluster_of("wood", ball(), 150, 400);
    wood.templates = {{1.0, std::size_t{2}}};
    Cluster forest = cluster_of("forest", ball(), 1500, 3000);
    forest.templates = {{1.0, std::size_t{3}}};
    const std::vector<Cluster> all{hills, ranges, copse, wood, forest};
    const auto objects = clusters::generate(all, {});
    const auto terrain = of_kind(objects, "down"), trees = of_kind(objects, "copse");
    CHECK(objects.size() == terrain.size() + trees.size());
    REQUIRE(terrain.size() > 20);
    REQUIRE(trees.size() > 1000);
    std::set<std::string> names;
    for (const Object& object : objects) names.insert(object.name);
    CHECK(names.size() == objects.size());
    // No two copses are alike.
    std::set<double> sizes;
    for (std::size_t i = 0; i < trees.size(); i += 50) {
        CHECK(stands(foot(trees[i]), terrain));
        sizes.insert(trees[i].paint.colour.r + foot(trees[i]).x);
    }
    CHECK(sizes.size() > trees.size() / 60);
}

TEST_CASE("objects vary about their template as far as they may and no further") {
    Cluster cluster = cluster_of("ball", ball(), 5, 300);
    cluster.variation.size = 0.3;
    cluster.variation.shape = 0.2;
    cluster.variation.colour = 0.5;
    cluster.variation.attitude = {180, 10, 0};
    double least = INFINITY, most = 0.0, sum = 0.0, darkest = 1.0, steepest = 0.0;
    const auto objects = clusters::generate({&cluster, 1}, {});
    for (const Object& object : objects) {
        const double width = ellipsoid(object).semi_axes.x / 4.0;
        least = std::min(least, width);
        most = std::max(most, width);
        sum += width;
        darkest = std::min(darkest, object.paint.colour.g / 0.6);
        steepest = std::max(steepest, std::abs(ellipsoid(object).attitude.pitch.value));
        CHECK(ellipsoid(object).attitude.roll.value == 0.0);
        CHECK(object.paint.colour.g <= 1.0);
    }
    REQUIRE(objects.size() > 10000);
    CHECK(least >= 0.7 * 0.8);
    CHECK(least < 0.7 * 0.8 + 0.03);
    CHECK(most <= 1.3 * 1.2);
    CHECK(most > 1.3 * 1.2 - 0.05);
    CHECK(sum / double(objects.size()) == Approx(1.0).epsilon(0.01));
    CHECK(darkest >= 0.5 * 0.75);
    CHECK(darkest < 0.5);
    CHECK(steepest <= 10.0);
    CHECK(steepest > 9.9);
}

TEST_CASE("templates are taken by their weights") {
    Cluster cluster = cluster_of("mix", ball(), 5, 300);
    Object other = ball();
    other.paint.colour = {1, 0, 0};
    cluster.templates = {{1.0, ball()}, {3.0, other}};
    const auto objects = clusters::generate({&cluster, 1}, {});
    double red = 0;
    for (const Object& object : objects) red += object.paint.colour.r == 1.0 ? 1 : 0;
    CHECK(red / double(objects.size()) == Approx(0.75).epsilon(0.03));
}

TEST_CASE("planes of a template go with its object: the share of it that they leave stays the same") {
    Object cut = ball();
    std::get<Ellipsoid>(cut.shape).attitude = {{20}, {30}, {-40}};
    cut.planes = {{{0.3, -0.5, 1, -4}}, {{-1, 0.2, 0.1, 2}}};
    Cluster cluster = cluster_of("stone", cut, 20, 100);
    cluster.variation = {0.4, 0.5, 0.4, 0.0, 0.0, {180, 90, 180}};
    const auto share = [](const Object& object, int trial) {
        Randomness random(trial);
        const Ellipsoid& e = ellipsoid(object);
        const double reach = std::max({e.semi_axes.x, e.semi_axes.y, e.semi_axes.z});
        int inside = 0, kept = 0;
        for (int i = 0; i < 20000; ++i) {
            const auto within = [&](double middle) { return Long(middle + random.between(-reach, reach)); };
            const LongPoint p{within(e.centre.metres.x), within(e.centre.metres.y), within(e.centre.metres.z)};
            if (quadric_at(object, p) > 0) continue;
            ++inside;
            kept += within_planes(object, p) ? 1 : 0;
        }
        return double(kept) / inside;
    };
    const double expected = share(cut, 0);
    CHECK(expected > 0.2);
    CHECK(expected < 0.8);
    const auto objects = clusters::generate({&cluster, 1}, {});
    for (int i = 0; i < 12; ++i) CHECK(share(objects[std::size_t(i * 5)], i + 1) == Approx(expected).margin(0.04));
}

TEST_CASE("too many places or objects are refused before they are made, with the cluster") {
    const auto refused = [](const std::vector<Cluster>& all) {
        try {
            clusters::generate(all, {});
        } catch (const clusters::TooMany& error) {
            return static_cast<int>(error.cluster);
        }
        return -1;
    };
    Cluster wide = cluster_of("wide", ball(), 0.001, 1e6);
    CHECK(refused({downs(), wide}) == 1);
    Cluster path = wide;
    path.region = clusters::Path{{{0, 0}, {1e6, 0}}, 0.0};
    CHECK(refused({path}) == 0);
    Cluster many = cluster_of("many", ball(), 1, 400);
    Cluster nest = cluster_of("nest", ball(), 1000, 1500);
    nest.templates = {{1.0, std::size_t{0}}};
    CHECK(refused({many, nest}) == 0);
    Cluster heap = downs();
    heap.spacing = 15;
    CHECK(refused({heap}) == 0);
}
