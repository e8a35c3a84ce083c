#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/image_generator.h"
#include "ig_core/scene/solid.h"
#include "tests/ig_core/random_objects.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

constexpr int kWidth = 160, kHeight = 120;

/// A solid and what its seams are looked at with.
struct Subject {
    Object whole;
    glm::dvec3 centre;
    double size;
};

Subject random_subject(Randomness& random) {
    const double offset = random.chance(0.5) ? 10.0 : random.log_between(100, 1e6);
    const glm::dvec3 centre = random.vector(offset);
    const double size = random.log_between(0.5, 50);
    const Kind kind = random.chance(0.6)   ? Kind::ellipsoid
                      : random.chance(0.5) ? Kind::elliptic_cylinder
                                           : Kind::polyhedron;
    return {random_object(random, kind, centre, size, true, random.below(4)), centre, size};
}

BoundingPlane turned_over(const BoundingPlane& plane) {
    BoundingPlane other = plane;
    for (double& coefficient : other.coefficients) coefficient = -coefficient;
    return other;
}

/// A plane through a place near the subject's centre.
BoundingPlane random_cut(Randomness& random, const Subject& subject) {
    const glm::dvec3 normal = random.direction() * random.log_between(0.1, 10);
    const glm::dvec3 through = subject.centre + random.vector(0.15 * subject.size);
    return {{normal.x, normal.y, normal.z, -glm::dot(normal, through)}};
}

/// Outside the whole solid by more than k_near: where a solid is not drawn because of the eye, a part of it may be.
View random_eye(Randomness& random, const Subject& subject) {
    const glm::dvec3 out = random.direction();
    const Solid whole = make_solid(subject.whole);
    const double reach = glm::distance(whole.anchor.metres, subject.centre) + whole.radius;
    const double distance = std::max(subject.size * random.between(1.2, 6), reach + 2 * kNearDepth);
    return {{subject.centre + distance * out},
            eye_from_scene_rotation(attitude_towards(-out, random.between(-180, 180))),
            ImagePlane::symmetric(kWidth, kHeight, Degrees::from_radians(2.5 * subject.size / distance))};
}

/// Pixel centres at which the whole solid is seen and its parts are not, or the other way round.
int cracks(const Subject& subject, const std::vector<Object>& parts, const View& view) {
    Scene whole, cut;
    whole.objects = {subject.whole};
    cut.objects = parts;
    const GroundTruth expected = ImageGenerator(whole).ground_truth(view),
                      seen = ImageGenerator(cut).ground_truth(view);
    int count = 0;
    for (std::size_t pixel = 0; pixel < seen.object_ids.size(); ++pixel)
        count += (seen.object_ids[pixel] >= 0) != (expected.object_ids[pixel] >= 0);
    return count;
}

/// The picture of solids that are white all over before a black sky.
std::vector<std::uint8_t> silhouette(const std::vector<Object>& objects, const View& view) {
    Scene scene;
    scene.objects = objects;
    scene.sun.ambient = 1.0;
    scene.sky = {Colour(0.0), Colour(0.0)};
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(4 * kWidth * kHeight));
    ImageGenerator(scene).render(view, {}, {}, {rgba.data(), kWidth, kHeight, 4 * kWidth});
    return rgba;
}

/// What a random plane parts a subject into.
std::vector<Object> cut_in_two(Randomness& random, const Subject& subject) {
    const BoundingPlane cut = random_cut(random, subject);
    std::vector<Object> parts{subject.whole, subject.whole};
    parts[0].planes.push_back(cut);
    parts[1].planes.push_back(turned_over(cut));
    return parts;
}

}  // namespace

TEST_CASE("two parts of a solid cut by one common plane leave no crack, from a thousand eyes") {
    int seams = 0;
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(trial);
        const Subject subject = random_subject(random);
        const std::vector<Object> parts = cut_in_two(random, subject);
        const View view = random_eye(random, subject);
        INFO("seed " << seed() << " trial " << trial);
        CHECK(cracks(subject, parts, view) == 0);
        Scene scene;
        scene.objects = parts;
        const GroundTruth seen = ImageGenerator(scene).ground_truth(view);
        seams += std::count(seen.object_ids.begin(), seen.object_ids.end(), 0) > 0 &&
                 std::count(seen.object_ids.begin(), seen.object_ids.end(), 1) > 0;
    }
    CHECK(seams > trials(1000) / 2);
}

TEST_CASE("the seam of two parts painted alike does not show") {
    for (int trial = 0; trial < trials(300); ++trial) {
        Randomness random(100'000 + trial);
        const Subject subject = random_subject(random);
        const std::vector<Object> parts = cut_in_two(random, subject);
        const View view = random_eye(random, subject);
        const auto whole = silhouette({subject.whole}, view), joined = silhouette(parts, view);
        int inside = 0, on_the_outline = 0;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            int& most = whole[i] == 255 ? inside : on_the_outline;
            most = std::max(most, std::abs(whole[i] - joined[i]));
        }
        INFO("seed " << seed() << " trial " << trial);
        CHECK(inside <= 1);
        CHECK(on_the_outline <= 32);
    }
}

TEST_CASE("eight parts of a solid about a common corner leave no crack") {
    for (int trial = 0; trial < trials(200); ++trial) {
        Randomness random(50'000 + trial);
        const Subject subject = random_subject(random);
        std::vector<Object> parts{subject.whole};
        for (int cut = 0; cut < 3; ++cut) {
            const BoundingPlane plane = random_cut(random, subject);
            const std::size_t count = parts.size();
            for (std::size_t i = 0; i < count; ++i) {
                parts.push_back(parts[i]);
                parts[i].planes.push_back(plane);
                parts.back().planes.push_back(turned_over(plane));
            }
        }
        INFO("seed " << seed() << " trial " << trial);
        CHECK(cracks(subject, parts, random_eye(random, subject)) == 0);
    }
}
