#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <iostream>
#include <random>

#include "ig_core/reference/candidates.h"
#include "tests/reference/scene_makers.h"

using namespace quadrig;
using namespace quadrig::reference;

namespace {

using Position = glm::tvec3<long double>;

/// Q at a point of scene space, from the definition of each shape.
long double value_at(const Ellipsoid& e, const Position& p) {
    const glm::tmat3x3<long double> body_from_scene(eye_from_scene_rotation(e.attitude));
    const Position q = body_from_scene * (p - Position(e.centre.metres)) / Position(e.semi_axes);
    return glm::dot(q, q) - 1;
}
long double value_at(const Hill& h, const Position& p) {
    // Negative on and below the lower sheet only.
    const long double c = h.radius_of_curvature * h.slope * h.slope, a = h.radius_of_curvature * h.slope;
    const Position q = p - Position(h.apex.metres);
    return q.z - c * (1 - std::sqrt(1 + (q.x * q.x + q.y * q.y) / (a * a)));
}
long double value_at(const GeneralQuadric& g, const Position& p) {
    const auto& c = g.coefficients;
    return c[0] * p.x * p.x + c[1] * p.y * p.y + c[2] * p.z * p.z + c[3] * p.x * p.y + c[4] * p.y * p.z +
           c[5] * p.x * p.z + c[6] * p.x + c[7] * p.y + c[8] * p.z + c[9];
}
long double value_at(const Object& object, const Position& p) {
    return std::visit([&](const auto& shape) { return value_at(shape, p); }, object.shape);
}
long double value_at(const BoundingPlane& plane, const Position& p) {
    const auto& b = plane.coefficients;
    return b[0] * p.x + b[1] * p.y + b[2] * p.z + b[3];
}
bool contains(const Object& object, const Position& p) {
    bool inside = value_at(object, p) <= 0;
    for (const auto& plane : object.planes) inside = inside && value_at(plane, p) > 0;
    return inside;
}

struct OwnRandomness {
    std::mt19937_64 engine;
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
    glm::dvec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
};

/// An elliptic cylinder, cone or paraboloid with axis Z, its convex part about the origin's upper side.
Object random_quadric_of_revolution(OwnRandomness& random) {
    const double a = random.between(0.1, 1), b = random.between(0.1, 1);
    switch (random.engine() % 3) {
        case 0:
            return solid(GeneralQuadric{{a, b, 0, 0, 0, 0, 0.1 * a, -0.2 * b, 0, -random.between(1, 40)}});
        case 1:
            return solid(GeneralQuadric{{a, b, -0.3, 0, 0, 0, 0, 0, 0, 0}}, {{{0, 0, 1, 0}}});
        default:
            return solid(GeneralQuadric{{a, b, 0, 0, 0, 0, 0, 0, -random.between(0.5, 5), 0}});
    }
}

Object random_solid(OwnRandomness& random) {
    Object object;
    switch (random.engine() % 3) {
        case 0:
            object =
                solid(Ellipsoid{{random.vector(3)},
                                {random.between(1, 9), random.between(1, 9), random.between(1, 9)},
                                {{random.between(0, 360)}, {random.between(-90, 90)}, {random.between(-180, 180)}}});
            break;
        case 1:
            object = solid(Hill{{random.vector(3)}, random.between(1, 10), random.between(0.2, 3)});
            break;
        default:
            object = random_quadric_of_revolution(random);
    }
    const std::size_t planes = object.planes.size() + random.engine() % 5;
    while (object.planes.size() < planes) {
        const glm::dvec3 normal = random.vector(1);
        object.planes.push_back({{normal.x, normal.y, normal.z, random.between(0, 5)}});
    }
    return object;
}

View random_view(OwnRandomness& random) {
    glm::dvec3 out;
    do out = random.vector(1);
    while (glm::length(out) < 0.1);
    const glm::dvec3 eye = random.between(5, 60) * glm::normalize(out);
    const glm::dvec3 ahead = glm::normalize(random.vector(4) - eye);
    const Attitude attitude{Degrees::from_radians(std::atan2(ahead.x, ahead.y)),
                            Degrees::from_radians(std::asin(ahead.z)),
                            {random.between(-180, 180)}};
    return look(eye, attitude, 24, 18, random.between(20, 120));
}

}  // namespace

TEST_CASE("rays enter random solids on the named surface, from outside to inside, and nowhere before") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::cout << "random solids: seed " << seed << '\n';
    OwnRandomness random{std::mt19937_64(seed)};
    int hits = 0;
    for (int trial = 0; trial < 150; ++trial) {
        const Object object = random_solid(random);
        const View view = random_view(random);
        const GroundTruth truth = ground_truth(scene_of({object}), view);
        for (int pixel = 0; pixel < 24 * 18; ++pixel) {
            const int column = pixel % 24, row = pixel / 24;
            const Position d(view.image.x(column + 0.5), 1, view.image.z(row + 0.5));
            const Position direction = glm::transpose(glm::tmat3x3<long double>(view.eye_from_scene)) * d;
            const auto at = [&](long double k) { return Position(view.eye.metres) + k * direction; };
            const long double depth = truth.depth[static_cast<std::size_t>(pixel)];
            INFO("trial " << trial << " column " << column << " row " << row << " depth "
                          << static_cast<double>(depth));
            if (depth < 1e9L) {
                ++hits;
                const int surface = truth.surface_ids[static_cast<std::size_t>(pixel)];
                const Position p = at(depth);
                const long double scale = 1 + glm::dot(p, p);
                const long double value = surface == 0
                                              ? value_at(object, p)
                                              : value_at(object.planes[static_cast<std::size_t>(surface - 1)], p);
                REQUIRE(std::abs(value) < 1e-12L * scale);
                REQUIRE_FALSE(contains(object, at(depth * (1 - 1e-9L))));
                REQUIRE(contains(object, at(depth * (1 + 1e-9L))));
            }
            if (contains(object, at(kNearDepth))) {
                REQUIRE(std::isinf(depth));
                continue;
            }
            for (int step = 1; step < 60; ++step) {
                const long double k = std::min(depth, 200.0L) * step / 60 * (1 - 1e-9L);
                if (k > kNearDepth) REQUIRE_FALSE(contains(object, at(k)));
            }
        }
    }
    CHECK(hits > 5000);
}

TEST_CASE("a bounding sphere holds its solid, and is finite where planes close the quadric") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::cout << "bounding spheres: seed " << seed << '\n';
    OwnRandomness random{std::mt19937_64(seed)};
    int inside = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Object object = random_solid(random);
        const glm::dvec3 eye = random.vector(100);
        const BoundingSphere bound = bounding_sphere(solid_about_eye(object, {eye}));
        for (int sample = 0; sample < 500; ++sample) {
            const glm::dvec3 p = random.vector(12);
            if (!contains(object, p)) continue;
            ++inside;
            REQUIRE(glm::length(p - eye - bound.centre) <= bound.radius);
        }
    }
    CHECK(inside > 5000);

    const auto radius = [](const Object& object) {
        return bounding_sphere(solid_about_eye(object, {{500, -300, 2}})).radius;
    };
    CHECK(radius(solid(sphere({0, 0, 0}, 5))) < 10);
    CHECK(radius(box({-1, -2, -3}, {1, 2, 3})) < 12);
    CHECK(radius(solid(Hill{{{0, 0, 50}}, 40, 0.5}, {{{0, 0, 1, 0}}})) < 500);
    CHECK(radius(solid(GeneralQuadric{{1, 1, 0, 0, 0, 0, 0, 0, 0, -9}}, {{{0, 0, 1, 0}}, {{0, 0, -1, 8}}})) < 30);
    CHECK(radius(solid(GeneralQuadric{{1, 1, -1, 0, 0, 0, 0, 0, 0, 0}}, {{{0, 0, 1, 0}}, {{0, 0, -1, 8}}})) < 50);
}
