#include "ig_core/clusters/abutting.h"

#include <catch2/catch.hpp>

#include "ig_core/clusters/generate.h"
#include "ig_core/reference/reference_renderer.h"
#include "tests/clusters/solids.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// A random cluster of hills of one slope or ellipsoids of one shape, near enough to one another to meet.
clusters::Cluster crowd(Randomness& random, bool hills, int neighbours) {
    clusters::Cluster cluster;
    cluster.name = "crowd";
    cluster.seed = static_cast<std::uint64_t>(random.between(0, 1e9));
    const glm::dvec2 middle(random.between(-5000, 5000), random.between(-5000, 5000));
    cluster.spacing = random.between(5, 400);
    cluster.region = clusters::Ellipse{middle, glm::dvec2(random.between(1.5, 4.0) * cluster.spacing)};
    cluster.variation.position = random.between(0.0, 0.6);
    cluster.variation.size = random.between(0.0, 0.5);
    cluster.abutting = neighbours;
    Object object;
    if (hills) {
        const double radius = cluster.spacing * random.between(0.2, 1.5);
        object.shape = Hill{{{0, 0, cluster.spacing * random.between(0.1, 0.6)}}, radius, random.between(0.2, 1.5)};
    } else {
        Ellipsoid ellipsoid;
        for (int i = 0; i < 3; ++i) ellipsoid.semi_axes[i] = cluster.spacing * random.between(0.3, 1.0);
        ellipsoid.attitude = {{random.between(-360, 360)}, {random.between(-90, 90)}, {random.between(-180, 180)}};
        cluster.altitude = random.between(-100, 5000);
        object.shape = ellipsoid;
    }
    cluster.templates.push_back({1.0, object});
    return cluster;
}

std::vector<Object> grown(const clusters::Cluster& cluster) { return clusters::generate({&cluster, 1}, {}); }

/// The same objects with no planes.
std::vector<Object> uncut(std::vector<Object> objects) {
    for (Object& object : objects) object.planes.clear();
    return objects;
}

glm::dvec3 middle_of(const Object& object) {
    if (const auto* hill = std::get_if<Hill>(&object.shape)) return hill->apex.metres;
    return std::get<Ellipsoid>(object.shape).centre.metres;
}

struct SharedPlane {
    std::size_t a, b;
    BoundingPlane keeps_a;
};

/// Pairs of which one has a plane and the other its exact negative.
std::vector<SharedPlane> shared_planes(const std::vector<Object>& objects) {
    std::vector<SharedPlane> pairs;
    for (std::size_t i = 0; i < objects.size(); ++i)
        for (std::size_t j = i + 1; j < objects.size(); ++j)
            for (const BoundingPlane& p : objects[i].planes)
                for (const BoundingPlane& q : objects[j].planes) {
                    bool negative = true;
                    for (std::size_t k = 0; k < 4; ++k) negative &= p.coefficients[k] == -q.coefficients[k];
                    if (negative) pairs.push_back({i, j, p});
                }
    return pairs;
}

/// A point of one of the pair, or close by.
LongPoint point_about(const Object& a, const Object& b, double spread, Randomness& random) {
    const glm::dvec3 p = glm::mix(middle_of(a), middle_of(b), random.between(-0.5, 1.5));
    return {p.x + random.between(-spread, spread), p.y + random.between(-spread, spread),
            p.z + random.between(-spread, spread)};
}

}  // namespace

TEST_CASE("10,000 random adjacent pairs lose nothing and keep nothing twice by the plane they share") {
    const int wanted = trials(10000);
    int pairs = 0;
    long in_either = 0, in_both = 0;
    for (int trial = 0; pairs < wanted; ++trial) {
        Randomness random(trial);
        const bool hills = trial % 2 == 0;
        const clusters::Cluster cluster = crowd(random, hills, 6);
        const std::vector<Object> objects = grown(cluster);
        for (const SharedPlane& shared : shared_planes(objects)) {
            ++pairs;
            const Object &a = objects[shared.a], &b = objects[shared.b];
            for (int i = 0; i < 20; ++i) {
                const LongPoint p = point_about(a, b, cluster.spacing, random);
                const Long side = plane_at(shared.keeps_a, p);
                const bool in_a = quadric_at(a, p) <= 0, in_b = quadric_at(b, p) <= 0;
                // Where the surfaces are within rounding of one another, either answer is right.
                if (std::abs(side) < 1e-7 || std::abs(quadric_at(a, p)) < 1e-9 || std::abs(quadric_at(b, p)) < 1e-9)
                    continue;
                const bool kept_by_a = in_a && side > 0, kept_by_b = in_b && side < 0;
                in_either += in_a || in_b ? 1 : 0;
                in_both += in_a && in_b ? 1 : 0;
                if ((kept_by_a || kept_by_b) == (in_a || in_b)) continue;
                CAPTURE(seed(), trial, shared.a, shared.b, static_cast<double>(side));
                FAIL("a point of the pair is in neither object once they are cut");
            }
        }
    }
    CHECK(in_either > 20L * pairs / 10);
    CHECK(in_both > 20L * pairs / 100);
}

TEST_CASE(
    "a crowd of objects fills the same space cut as uncut, also where an object has more neighbours than planes") {
    long held = 0;
    for (int trial = 0; trial < trials(150); ++trial) {
        Randomness random(trial);
        const clusters::Cluster cluster = crowd(random, trial % 2 == 0, 1 + trial % 5);
        const std::vector<Object> cut = grown(cluster), whole = uncut(cut);
        for (int i = 0; i < 200; ++i) {
            const auto pick = [&] { return static_cast<std::size_t>(random.between(0, 0.999) * double(cut.size())); };
            const LongPoint p = point_about(cut[pick()], cut[pick()], 0.3 * cluster.spacing, random);
            bool close_call = false;
            for (const Object& object : cut) {
                close_call |= std::abs(quadric_at(object, p)) < 1e-9;
                for (const BoundingPlane& plane : object.planes) close_call |= std::abs(plane_at(plane, p)) < 1e-7;
            }
            if (close_call) continue;
            CAPTURE(seed(), trial, i);
            REQUIRE(in_any(cut, p) == in_any(whole, p));
            held += in_any(whole, p) ? 1 : 0;
        }
    }
    CHECK(held > trials(150) * 20L);
}

TEST_CASE("the reference sees the same depth of a crowd cut as uncut: no crack, no step") {
    long seen = 0;
    for (int trial = 0; trial < trials(24); ++trial) {
        Randomness random(trial);
        const clusters::Cluster cluster = crowd(random, trial % 2 == 0, 6);
        Scene cut, whole;
        cut.objects = grown(cluster);
        whole.objects = uncut(cut.objects);
        const glm::dvec2 middle = std::get<clusters::Ellipse>(cluster.region).centre;
        const double height = cluster.altitude.value_or(0.0), away = 6.0 * cluster.spacing;
        const View view{{{middle.x, middle.y - away, height + 0.35 * away}},
                        eye_from_scene_rotation({{0}, {-18}, {0}}),
                        ImagePlane::symmetric(48, 36, {60})};
        const GroundTruth a = reference::ground_truth(cut, view), b = reference::ground_truth(whole, view);
        for (std::size_t i = 0; i < a.depth.size(); ++i) {
            CAPTURE(seed(), trial, i, a.depth[i], b.depth[i]);
            const bool sky = b.object_ids[i] == kSkyId;
            REQUIRE((a.object_ids[i] == kSkyId) == sky);
            if (sky) continue;
            ++seen;
            REQUIRE(std::abs(a.depth[i] - b.depth[i]) <= 1e-9 * b.depth[i]);
        }
    }
    CHECK(seen > trials(24) * 100L);
}

TEST_CASE("objects of different shapes, apart, or one inside the other share no plane") {
    const Ellipsoid one{{{0, 0, 0}}, {2, 3, 4}, {}}, far{{{4.1, 0, 0}}, {2, 3, 4}, {}},
        near{{{3.9, 0, 0}}, {2, 3, 4}, {}};
    const auto quadric = [](const Ellipsoid& e, double size) { return clusters::centred(e, e.semi_axes / size, size); };
    CHECK(clusters::abut(quadric(one, 1), quadric(near, 1)));
    CHECK_FALSE(clusters::abut(quadric(one, 1), quadric(far, 1)));
    const Ellipsoid inner{{{0.2, 0, 0}}, {1, 1.5, 2}, {}}, other_shape{{{3, 0, 0}}, {3, 3, 4}, {}};
    CHECK_FALSE(clusters::abut(quadric(one, 1), quadric(inner, 0.5)));
    CHECK_FALSE(clusters::abut(quadric(one, 1), quadric(other_shape, 1)));
    const Hill low{{{0, 0, 10}}, 20, 0.5}, steep{{{5, 0, 10}}, 20, 0.6};
    CHECK_FALSE(clusters::abut(clusters::centred(low, 0), clusters::centred(steep, 0)));
}
