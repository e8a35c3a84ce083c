#include "ig_core/scene/motion.h"

#include <catch2/catch.hpp>

#include "ig_core/scene/placement.h"
#include "tests/clusters/solids.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

Object ball(const glm::dvec3& centre) {
    Object object;
    object.shape = Ellipsoid{{centre}, {4, 4, 6}, {}};
    return object;
}
const Ellipsoid& ellipsoid(const Object& object) { return std::get<Ellipsoid>(object.shape); }

Object at(const Object& object, double seconds) {
    Scene scene;
    scene.objects = {object};
    return scene_at(scene, seconds).objects[0];
}

}  // namespace

TEST_CASE("what has a velocity is where it has got to, and comes in again opposite to where it went out") {
    Object cloud = ball({100, 50, 900});
    CHECK(ellipsoid(at(cloud, 1e4)).centre.metres == glm::dvec3(100, 50, 900));
    cloud.motion = Motion{{12, -3, 0.5}, std::nullopt, std::nullopt};
    CHECK(glm::length(ellipsoid(at(cloud, 40)).centre.metres - glm::dvec3(580, -70, 920)) < 1e-12);
    cloud.motion->within = {-1000, -500, 1000, 500};
    CHECK(glm::length(ellipsoid(at(cloud, 100)).centre.metres - glm::dvec3(-700, -250, 950)) < 1e-9);
    for (int second = 0; second < 4000; second += 7) {
        const glm::dvec3 c = ellipsoid(at(cloud, second)).centre.metres;
        CHECK((c.x >= -1000 && c.x < 1000 && c.y >= -500 && c.y < 500));
    }
    CHECK_FALSE(at(cloud, 5).motion);
}

TEST_CASE("what sways keeps its foot where it is, leans as far as it may, and its neighbours follow") {
    Object tree = ball({10, 20, 8});
    tree.motion = Motion{{}, std::nullopt, Sway{{5}, 4, 100}};
    double most = 0, least = 0;
    for (int i = 0; i < 400; ++i) {
        const Object now = at(tree, 0.02 * i);
        const LongPoint foot{10, 20, 2};
        CHECK(std::abs(quadric_at(now, foot)) < 1e-12);
        const double east = ellipsoid(now).centre.metres.x - 10;
        most = std::max(most, east);
        least = std::min(least, east);
        CHECK(std::abs(ellipsoid(now).centre.metres.y - 20) < 1e-12);
        // 25 m farther east the gust is a quarter of a period later.
        Object next = ball({35, 20, 8});
        next.motion = tree.motion;
        CHECK(ellipsoid(at(next, 0.02 * i + 1.0)).centre.metres.x - 35 == Approx(east).margin(1e-9));
    }
    const double lean = 6 * std::sin(5 * std::acos(-1.0) / 180);
    CHECK(most == Approx(lean).epsilon(1e-3));
    CHECK(least == Approx(-lean).epsilon(1e-3));
}

TEST_CASE("a hill travels with its planes") {
    Object hill;
    hill.shape = Hill{{{0, 0, 50}}, 100, 0.5};
    hill.planes = {{{1, 2, 0, 30}}};
    hill.motion = Motion{{3, 4, 0}, std::nullopt, std::nullopt};
    const Object now = at(hill, 10);
    CHECK(std::get<Hill>(now.shape).apex.metres == glm::dvec3(30, 40, 50));
    CHECK(plane_at(now.planes[0], {30, 40, 0}) == 30);
}

TEST_CASE("a solid moved is the solid of the object moved") {
    int edges = 0;
    for (int trial = 0; trial < trials(500); ++trial) {
        Randomness random(trial);
        const auto some = [&](double size) {
            return glm::dvec3(random.between(-size, size), random.between(-size, size), random.between(-size, size));
        };
        Object object;
        object.planes = {{{random.between(-1, 1), random.between(-1, 1), 0.3, random.between(0, 2)}}};
        GeneralQuadric cylinder;
        cylinder.coefficients = {0.5, 0, 2, 0, 0, 0, 0.3, 0, -0.2, -3};
        if (trial % 2 == 0)
            object.shape =
                Ellipsoid{{some(3)}, {1, 2, random.between(0.1, 4)}, {{some(180).x}, {some(90).x}, {some(180).x}}};
        else
            object.shape = cylinder;
        if (trial % 2 == 0)
            object.planes.push_back({{random.between(-1, 1), 0.4, random.between(-1, 1), random.between(0, 1)}});
        const ScenePose pose{{some(1e4)}, eye_from_scene_rotation({{some(180).x}, {some(90).x}, {some(180).x}})};
        const Solid expected = make_solid(*placed(object, pose));
        Solid moved;
        move(make_solid(object), pose, moved);
        CHECK(moved.planes.size() == expected.planes.size());
        CHECK(moved.ellipsoid == expected.ellipsoid);
        CHECK(moved.radius == expected.radius);
        REQUIRE(moved.edges.size() == expected.edges.size());
        REQUIRE(moved.vertices.size() == expected.vertices.size());
        edges += static_cast<int>(moved.edges.size());
        for (std::size_t j = 0; j < moved.vertices.size(); ++j) {
            CAPTURE(seed(), trial, j);
            CHECK(glm::distance(moved.vertices[j].at, expected.vertices[j].at) < 1e-6);
        }
        for (int i = 0; i < 20; ++i) {
            const ScenePoint p{pose.position.metres + some(6)};
            CAPTURE(seed(), trial, i);
            // M may be scaled otherwise: the sign and the relation to its size count.
            const double scale =
                (moved.m.xx + moved.m.yy + moved.m.zz) / (expected.m.xx + expected.m.yy + expected.m.zz);
            CHECK(moved.quadric_at(p) == Approx(scale * expected.quadric_at(p)).margin(1e-5));
            for (std::size_t j = 0; j < moved.planes.size(); ++j)
                CHECK(moved.plane_at(moved.planes[j], p) ==
                      Approx(expected.plane_at(expected.planes[j], p)).margin(1e-8));
        }
    }
    CHECK(edges > 20);
}
