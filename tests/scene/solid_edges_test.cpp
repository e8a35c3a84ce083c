#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/scene/solid.h"
#include "tests/ig_core/exact_solid.h"
#include "tests/ig_core/random_objects.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// A solid of size 1 or so that has an end; about its anchor, in extended precision, with unit normals.
struct Case {
    Solid solid;
    ExactSolid exact;
};
Case random_case(Randomness& random) {
    constexpr Kind kCurved[]{Kind::ellipsoid, Kind::hill, Kind::elliptic_cylinder, Kind::cone, Kind::two_sheets};
    const Object object = random_object(random, kCurved[random.below(5)], random.vector(100), 1, true, random.below(8));
    Case result{make_solid(object), {}};
    result.exact = exact_solid(object, result.solid.anchor);
    for (ExactPlane& plane : result.exact.planes) {
        const Real length = glm::length(plane.normal);
        plane.normal /= length, plane.at_eye /= length;
    }
    return result;
}

Real at(const ExactPlane& plane, const Real3& p) { return glm::dot(plane.normal, p) + plane.at_eye; }
const ExactPlane& face(const ExactSolid& solid, int surface) {
    return *std::find_if(solid.planes.begin(), solid.planes.end(),
                         [&](const ExactPlane& plane) { return plane.surface == surface; });
}
/// Least of what all planes but two have left at p; below zero outside.
Real left_of_planes(const ExactSolid& solid, const Real3& p, int surface, int other) {
    Real least = 1e9L;
    for (const ExactPlane& plane : solid.planes)
        if (plane.surface != surface && plane.surface != other) least = std::min(least, at(plane, p));
    return least;
}

}  // namespace

TEST_CASE("a ball cut on six sides has twelve edges where the faces meet within it, chords at 0.6 and a box's at 0.5") {
    CHECK(make_solid(cut_ball(0.8)).edges.empty());
    for (const double distance : {0.6, 0.5}) {
        const Solid solid = make_solid(cut_ball(distance));
        REQUIRE(solid.edges.size() == 12);
        const double length = 2 * std::min(distance, std::sqrt(1 - 2 * distance * distance));
        for (const SolidEdge& edge : solid.edges) {
            const glm::dvec3 from = solid.vertices[edge.from].at, to = solid.vertices[edge.to].at;
            CHECK(glm::length(to - from) == Approx(length).epsilon(1e-14));
            CHECK(glm::length(to + from) == Approx(2 * std::sqrt(2.0) * distance).epsilon(1e-14));
        }
        // A box's corners are common to three edges; chords that end on the ball have ends of their own.
        CHECK(solid.vertices.size() == (distance < 0.55 ? 8 : 24));
    }
}

TEST_CASE("an edge lies in its two planes, and ends on a third or on the quadric") {
    CAPTURE(seed());
    long ends = 0;
    const int count = trials(1500);
    for (int trial = 0; trial < count; ++trial) {
        Randomness random(trial);
        const Case given = random_case(random);
        const Solid& solid = given.solid;
        for (const SolidEdge& edge : solid.edges) {
            const int surface = solid.planes[edge.plane].surface, other = solid.planes[edge.other_plane].surface;
            CAPTURE(trial, surface, other);
            for (const std::uint8_t end : {edge.from, edge.to}) {
                const SolidVertex& vertex = solid.vertices[end];
                const Real3 p(vertex.at);
                constexpr Real kOn = 1e-8L;  // metres, planes that almost agree
                REQUIRE(std::abs(at(face(given.exact, surface), p)) < kOn);
                REQUIRE(std::abs(at(face(given.exact, other), p)) < kOn);
                const Real left = left_of_planes(given.exact, p, surface, other);
                const Real3 gradient = given.exact.m * p + given.exact.v;
                const Real outside = given.exact.quadric_at(p) / (2 * glm::length(gradient));
                REQUIRE(left > -kOn);
                REQUIRE(outside < kOn);
                REQUIRE((left < kOn || outside > -kOn));
                const auto named = [&](std::uint8_t plane) {
                    return std::find(vertex.planes.begin(), vertex.planes.end(), plane) != vertex.planes.end();
                };
                REQUIRE((named(edge.plane) && named(edge.other_plane)));
                const std::uint8_t third = vertex.planes[2];
                if (third != SolidVertex::kNoPlane)
                    REQUIRE(std::abs(at(face(given.exact, solid.planes[third].surface), p)) < kOn);
                ++ends;
            }
        }
    }
    CHECK(ends > count / 2);
}

TEST_CASE("a point common to two planes lies on their edge if the solid holds it, and on none if it does not") {
    CAPTURE(seed());
    long held = 0, not_held = 0;
    const int count = trials(1500);
    for (int trial = 0; trial < count; ++trial) {
        Randomness random(100'000 + trial);
        const Case given = random_case(random);
        const Solid& solid = given.solid;
        if (solid.may_be_endless) continue;
        for (const ExactPlane& a : given.exact.planes) {
            for (const ExactPlane& b : given.exact.planes) {
                if (a.surface == 0 || b.surface == 0 || &a >= &b) continue;
                const Real3 line = glm::cross(a.normal, b.normal);
                const Real length2 = glm::dot(line, line);
                if (length2 < 1e-4L) continue;
                const Real3 foot = glm::cross(line, a.at_eye * b.normal - b.at_eye * a.normal) / length2;
                const Real3 p = foot + Real(random.between(-1, 1)) / std::sqrt(length2) * line;
                const Real left = left_of_planes(given.exact, p, a.surface, b.surface);
                const Real inside = -given.exact.quadric_at(p);
                if (std::min(std::abs(left), std::abs(inside)) < 1e-7L) continue;
                const bool expected = left > 0 && inside > 0;
                const bool found = std::any_of(solid.edges.begin(), solid.edges.end(), [&](const SolidEdge& edge) {
                    const int first = solid.planes[edge.plane].surface, second = solid.planes[edge.other_plane].surface;
                    return std::min(first, second) == std::min(a.surface, b.surface) &&
                           std::max(first, second) == std::max(a.surface, b.surface) &&
                           glm::dot(p - Real3(solid.vertices[edge.from].at), p - Real3(solid.vertices[edge.to].at)) < 0;
                });
                CAPTURE(trial, a.surface, b.surface);
                REQUIRE(found == expected);
                ++(expected ? held : not_held);
            }
        }
    }
    CHECK(held > count / 3);
    CHECK(not_held > count / 3);
}
