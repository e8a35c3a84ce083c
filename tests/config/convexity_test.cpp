#include "config/convexity.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <random>

using namespace quadrig;
using Coefficients = std::array<double, 10>;
using Planes = std::vector<BoundingPlane>;

namespace {

bool accepted(const Coefficients& coefficients, const Planes& planes = {}) {
    return !config::why_not_convex({coefficients}, planes);
}

/// Q1 x2 + Q2 y2 + Q3 z2 + Q0 in axes turned by the attitude about a centre, as the ten coefficients in scene space.
Coefficients moved(const glm::dvec3& squares, double constant, const Attitude& attitude, const glm::dvec3& centre) {
    const glm::dmat3 own_from_scene = eye_from_scene_rotation(attitude);
    const glm::dmat3 diagonal(squares.x, 0, 0, 0, squares.y, 0, 0, 0, squares.z);
    const glm::dmat3 m = glm::transpose(own_from_scene) * diagonal * own_from_scene;
    const glm::dvec3 v = -(m * centre);
    return {m[0][0],     m[1][1], m[2][2], 2 * m[1][0], 2 * m[2][1],
            2 * m[2][0], 2 * v.x, 2 * v.y, 2 * v.z,     glm::dot(centre, m * centre) + constant};
}

}  // namespace

TEST_CASE("convex quadrics are accepted without planes") {
    CHECK(accepted({1, 1, 1, 0, 0, 0, -2, 0, 0, -3}));    // sphere
    CHECK(accepted({1, 1, 0, 0, 0, 0, 0, 0, 0, -1}));     // cylinder
    CHECK(accepted({1, 1, 0, 0, 0, 0, 0, 0, 1, 0}));      // paraboloid
    CHECK(accepted({1, 0, 0, 0, 0, 0, 0, 1, 0, 0}));      // parabolic cylinder
    CHECK(accepted({0, 0, 0, 0, 0, 0, 0, 0, 1, -5}));     // half-space
    CHECK(accepted({0, 0, 1, 0, 0, 0, 0, 0, 0, -1}));     // slab
    CHECK(accepted({1, 1, 1, 0, 0, 0, 0, 0, 0, 1}));      // nothing
    CHECK(accepted({1, 1, 1, 0, 0, 0, 0, 0, 0, 0}));      // a point
    CHECK(accepted({0, 0, 0, 0, 0, 0, 0, 0, 0, -1}));     // everything
    CHECK(accepted({0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));      // everything, barely
    CHECK(accepted({-1, -1, -1, 0, 0, 0, 0, 0, 0, -1}));  // everything: nowhere positive
}

TEST_CASE("quadrics with a hollow side are refused whatever their planes") {
    const Planes planes{{{0, 0, 1, 0}}};
    CHECK_FALSE(accepted({1, 1, -1, 0, 0, 0, 0, 0, 0, -1}, planes));   // one-sheet hyperboloid
    CHECK_FALSE(accepted({1, -1, 0, 0, 0, 0, 0, 0, 1, 0}, planes));    // hyperbolic paraboloid
    CHECK_FALSE(accepted({0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, planes));     // the same, turned: XY + Z
    CHECK_FALSE(accepted({-1, -1, -1, 0, 0, 0, 0, 0, 0, 1}, planes));  // outside of a sphere
    CHECK_FALSE(accepted({-1, -1, 0, 0, 0, 0, 0, 0, 0, 1}, planes));   // outside of a cylinder
    CHECK_FALSE(accepted({-1, -1, 0, 0, 0, 0, 0, 0, 1, 0}, planes));   // outside of a paraboloid
    CHECK_FALSE(accepted({-1, 0, 0, 0, 0, 0, 0, 1, 0, 0}, planes));    // outside of a parabolic cylinder
    CHECK_FALSE(accepted({1, -1, 0, 0, 0, 0, 0, 0, 0, -1}, {}));       // the waist side of a hyperbolic cylinder
}

TEST_CASE("two sheets need a plane that keeps only one of them") {
    const Coefficients hyperboloid{1, 1, -1, 0, 0, 0, 0, 0, 0, 1};  // z2 >= x2 + y2 + 1
    CHECK_FALSE(accepted(hyperboloid));
    CHECK(accepted(hyperboloid, {{{0, 0, 1, 0}}}));
    CHECK(accepted(hyperboloid, {{{0, 0, -1, 0}}}));
    CHECK(accepted(hyperboloid, {{{0, 0, 1, 0.999}}}));       // keeps z > -0.999, and the lower sheet begins at -1
    CHECK_FALSE(accepted(hyperboloid, {{{0, 0, 1, 1.01}}}));  // takes in the tip of the lower sheet
    CHECK(accepted(hyperboloid, {{{0.9, 0, 1, 0}}}));         // slanting, still between the sheets
    CHECK_FALSE(accepted(hyperboloid, {{{1.1, 0, 1, 0}}}));   // too steep: cuts both
    CHECK_FALSE(accepted(hyperboloid, {{{1, 0, 0, 0}}}));     // upright: half of each
    CHECK_FALSE(accepted(hyperboloid, {{{0, 0, 1, 5}}, {{0, 0, -1, 5}}}));
    CHECK(accepted(hyperboloid, {{{0, 0, 1, 5}}, {{0, 0, -1, 0.5}}}));
    CHECK(accepted({1, 1, -1, 0, 0, 0, 0, 0, 0, 0}, {{{0, 0, -1, 0}}}));  // cone, cut at its apex
    CHECK_FALSE(accepted({1, 1, -1, 0, 0, 0, 0, 0, 0, 0}, {{{0, 0, -1, 1}}}));
    CHECK(accepted({1, -1, 0, 0, 0, 0, 0, 0, 0, 1}, {{{0, 1, 0, 0}}}));  // hyperbolic cylinder
    CHECK_FALSE(accepted({1, -1, 0, 0, 0, 0, 0, 0, 0, 1},
                         {{{0, 1, 1, 0}}}));  // slants along the cylinder: both sheets reach over
    CHECK(accepted({0, 0, -1, 0, 0, 0, 0, 0, 0, 1}, {{{0, 0, 1, 0}}}));  // outside of a slab
    CHECK(accepted({1, -1, 0, 0, 0, 0, 0, 0, 0, 0}, {{{0, 1, 0, 0}}}));  // two crossing planes: a wedge
}

TEST_CASE("sheets that several planes together keep out are accepted") {
    // The lower sheet of z2 >= x2 + y2 + 1 lies below z = -1; the two slants meet above that, along x = 0, z = -0.9.
    const Coefficients hyperboloid{1, 1, -1, 0, 0, 0, 0, 0, 0, 1};
    CHECK(accepted(hyperboloid, {{{2, 0, 1, 0.9}}, {{-2, 0, 1, 0.9}}}));
    CHECK_FALSE(accepted(hyperboloid, {{{2, 0, 1, 1.5}}, {{-2, 0, 1, 1.5}}}));
}

TEST_CASE("the verdict does not change when a quadric is turned, moved and scaled") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> turn(-180.0, 180.0), place(-3000.0, 3000.0), size(0.05, 20.0),
        exponent(-6.0, 6.0);
    for (int i = 0; i < 2000; ++i) {
        const Attitude attitude{{turn(random)}, {turn(random)}, {turn(random)}};
        const glm::dvec3 centre(place(random), place(random), place(random));
        const double a = size(random), b = size(random), c = size(random), factor = std::pow(10.0, exponent(random));
        const auto turned = [&](const glm::dvec3& squares, double constant) {
            return moved(factor * squares, factor * constant, attitude, centre);
        };
        const glm::dmat3 own_from_scene = eye_from_scene_rotation(attitude);
        const glm::dvec3 up(own_from_scene[0][2], own_from_scene[1][2], own_from_scene[2][2]);
        // Keeps what lies higher than `height` along the quadric's own third axis.
        const auto above = [&](double height) { return Planes{{{up.x, up.y, up.z, -glm::dot(up, centre) - height}}}; };
        INFO("case " << i << ": " << a << ' ' << b << ' ' << c << " by " << factor);
        CHECK(accepted(turned({a, b, c}, -1.0)));
        CHECK(accepted(turned({a, b, 0.0}, -1.0)));
        CHECK_FALSE(accepted(turned({a, b, -c}, -1.0), above(0.0)));
        CHECK_FALSE(accepted(turned({-a, -b, -c}, 1.0), above(0.0)));
        const Coefficients two_sheets = turned({a, b, -c}, 1.0);
        CHECK_FALSE(accepted(two_sheets));
        CHECK(accepted(two_sheets, above(-0.9 / std::sqrt(c))));
        CHECK_FALSE(accepted(two_sheets, above(-1.2 / std::sqrt(c))));
        CHECK(accepted(turned({a, b, -c}, 0.0), above(0.0)));  // a cone cut at its apex, to rounding
        CHECK_FALSE(accepted(turned({a, b, -c}, 0.0)));
    }
}
