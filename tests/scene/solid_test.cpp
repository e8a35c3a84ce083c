#include "ig_core/scene/solid.h"

#include <array>
#include <catch2/catch.hpp>

#include "tests/ig_core/exact_solid.h"
#include "tests/ig_core/random_objects.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// Q at a scene point from the file's numbers, 113-bit up to the last rounding.
Real quadric_at(const Object& object, const glm::dvec3& p) { return exact_solid(object, {p}).s; }

/// Largest relative difference of two proportional series, scaled to each other at their largest entry; 2 if the factor
/// is negative.
Real disproportion(const std::vector<Real>& a, const std::vector<Real>& b) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
        if (std::abs(b[i]) > std::abs(b[at])) at = i;
    const Real factor = a[at] / b[at];
    if (!(factor > 0)) return 2;
    Real most = 0;
    for (std::size_t i = 0; i < b.size(); ++i) most = std::max(most, std::abs(a[i] / factor - b[i]) / std::abs(b[at]));
    return most;
}

std::vector<glm::dvec3> points_about(Randomness& random, const glm::dvec3& centre, double size) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 20; ++i) points.push_back(centre + random.vector(size));
    return points;
}

}  // namespace

TEST_CASE("a solid's quadric is the file's at every point, up to one positive factor, also far from the origin") {
    CAPTURE(seed());
    for (const double offset : {0.0, 1e3, 1e5, 1e7}) {
        for (int trial = 0; trial < trials(300); ++trial) {
            Randomness random(trial);
            const glm::dvec3 centre = offset * random.direction() + random.vector(100);
            const double size = random.log_between(1, 100);
            const Kind kind = static_cast<Kind>(random.below(kKinds));
            const Object object = random_object(random, kind, centre, size, true, 0);
            const Solid solid = make_solid(object);
            std::vector<Real> ours, exact;
            for (const glm::dvec3& p : points_about(random, centre, 3 * size)) {
                ours.push_back(solid.quadric_at({p}));
                exact.push_back(quadric_at(object, p));
            }
            CAPTURE(offset, trial, static_cast<int>(kind));
            // What is left is one rounding of M, taken about the centre. Without a centre the anchor may stand as far
            // away as the scene's origin.
            const bool central =
                kind == Kind::ellipsoid || kind == Kind::hill || kind == Kind::cone || kind == Kind::two_sheets;
            const double reach = central ? 0 : glm::length(solid.anchor.metres - centre) / size;
            REQUIRE(disproportion(ours, exact) < 1e-13 * (1 + reach * reach));
        }
    }
}

TEST_CASE("Q = q'Mq + 2 w.q + c about the anchor, and the adjugate and determinant are those of M") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(trial);
        const Object object =
            random_object(random, static_cast<Kind>(random.below(kKinds)), random.vector(50), 10, true, 0);
        const Solid s = make_solid(object);
        const glm::dvec3 q = random.vector(20);
        const double expanded = value(s.m, q) + 2 * glm::dot(s.w, q) + s.c;
        const double size = std::abs(value(s.m, q)) + std::abs(2 * glm::dot(s.w, q)) + std::abs(s.c);
        CAPTURE(trial);
        REQUIRE(std::abs(s.quadric_at({s.anchor.metres + q}) - expanded) < 1e-12 * (size + 1e3));
        const Sym3& m = s.m;
        const Real xx = Real(m.yy) * m.zz - Real(m.yz) * m.yz, yy = Real(m.xx) * m.zz - Real(m.xz) * m.xz;
        const Real zz = Real(m.xx) * m.yy - Real(m.xy) * m.xy, xy = Real(m.xz) * m.yz - Real(m.xy) * m.zz;
        const Real xz = Real(m.xy) * m.yz - Real(m.xz) * m.yy, yz = Real(m.xy) * m.xz - Real(m.xx) * m.yz;
        REQUIRE(std::abs(s.adjugate.xx - xx) < 1e-14);
        REQUIRE(std::abs(s.adjugate.yy - yy) < 1e-14);
        REQUIRE(std::abs(s.adjugate.zz - zz) < 1e-14);
        REQUIRE(std::abs(s.adjugate.xy - xy) < 1e-14);
        REQUIRE(std::abs(s.adjugate.xz - xz) < 1e-14);
        REQUIRE(std::abs(s.adjugate.yz - yz) < 1e-14);
        REQUIRE(std::abs(s.determinant - (m.xx * xx + m.xy * xy + m.xz * xz)) < 1e-14);
    }
}

TEST_CASE("a solid's planes are the file's, of unit length, numbered from 1, and a hill's sheet is 0") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(trial);
        const double offset = random.log_between(1, 1e7);
        const Kind kind = static_cast<Kind>(random.below(kKinds));
        const Object object = random_object(random, kind, offset * random.direction(), 10, true, 1 + random.below(5));
        const Solid solid = make_solid(object);
        const std::size_t extra = kind == Kind::hill ? 1 : 0;
        REQUIRE(solid.planes.size() == object.planes.size() + extra);
        const ScenePoint p{solid.anchor.metres + random.vector(30)};
        const ExactSolid exact = exact_solid(object, p);
        for (std::size_t j = 0; j < solid.planes.size(); ++j) {
            const SolidPlane& plane = solid.planes[j];
            CAPTURE(trial, j);
            REQUIRE(plane.surface == static_cast<int>(j + 1 - extra));
            REQUIRE(glm::length(plane.normal) == Approx(1).epsilon(1e-14));
            const Real expected = exact.planes[j].at_eye / glm::length(exact.planes[j].normal);
            REQUIRE(std::abs(solid.plane_at(plane, p) - expected) < 1e-15L * (std::abs(plane.offset) + 100));
        }
    }
}

TEST_CASE("a hill's apex, curvature and far slope are what the file says") {
    const double h = 120, r = 200, m = 0.5;
    Object hill;
    hill.shape = Hill{{{500, 900, h}}, r, m};
    const Solid solid = make_solid(hill);
    const auto q = [&](double aside, double z) { return solid.quadric_at({{500 + aside, 900, z}}); };
    CHECK(std::abs(q(0, h)) < 1e-12);
    CHECK(q(0, h - 1) < 0);
    CHECK(q(0, h + 1) > 0);
    const double near = 1e-2 * r, drop = near * near / (2 * r);  // circle of curvature at the apex
    CHECK(q(near, h - drop * 1.001) < 0);
    CHECK(q(near, h - drop * 0.999) > 0);
    const double far = 1e7;
    CHECK(q(far, -far * m * 1.0001) < 0);
    CHECK(q(far, -far * m * 0.9999) > 0);
}

TEST_CASE("an ellipsoid's radius holds it, and is infinite where nothing holds a solid") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(500); ++trial) {
        Randomness random(trial);
        const glm::dvec3 centre = random.vector(1000);
        const double a = random.log_between(0.1, 100), b = random.log_between(0.1, 100),
                     c = random.log_between(0.1, 100);
        const Attitude attitude = random.attitude();
        Object given;
        given.shape = Ellipsoid{{centre}, {a, b, c}, attitude};
        // The same one by its ten coefficients.
        const ExactSolid e = exact_solid(given, {});
        Object coefficients;
        const auto d = [](Real x) { return static_cast<double>(x); };
        coefficients.shape =
            GeneralQuadric{{d(e.m[0][0]), d(e.m[1][1]), d(e.m[2][2]), d(2 * e.m[0][1]), d(2 * e.m[1][2]),
                            d(2 * e.m[0][2]), d(2 * e.v.x), d(2 * e.v.y), d(2 * e.v.z), d(e.s)}};
        for (const Object& object : {given, coefficients}) {
            const Solid solid = make_solid(object);
            CAPTURE(trial);
            REQUIRE(solid.ellipsoid);
            REQUIRE_FALSE(solid.may_be_endless);
            REQUIRE(solid.radius >= std::max({a, b, c}) * (1 - 1e-6));
            REQUIRE(glm::length(solid.anchor.metres - centre) <
                    1e-3 * std::min({a, b, c}) + 1e-9 * glm::length(centre));
        }
    }
    Object hill;
    hill.shape = Hill{};
    CHECK(std::isinf(make_solid(hill).radius));
    Object open_cylinder;
    open_cylinder.shape = GeneralQuadric{{1, 1, 0, 0, 0, 0, 0, 0, 0, -9}};
    CHECK(std::isinf(make_solid(open_cylinder).radius));
}

TEST_CASE("no point of a hill, cylinder or cone between planes lies outside its bounding sphere") {
    CAPTURE(seed());
    int closed = 0, inside = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        Randomness random(trial);
        const glm::dvec3 middle = random.vector(1000);
        const double size = random.log_between(1, 100), slope = random.between(0.3, 2);
        const auto level = [&](double up, double at) {
            return BoundingPlane{{0.1, 0.05, up, -up * at - 0.1 * middle.x - 0.05 * middle.y}};
        };
        Object object;
        if (random.chance(0.4)) {
            object.shape = Hill{{middle}, size, slope};
        } else {
            const double cone = random.chance(0.5) ? slope : 0, r2 = cone > 0 ? 0 : size * size;
            const double x = middle.x, y = middle.y, z = middle.z;
            object.shape = GeneralQuadric{{1, 1, -cone * cone, 0, 0, 0, -2 * x, -2 * y, 2 * cone * cone * z,
                                           x * x + y * y - cone * cone * z * z - r2}};
            object.planes.push_back(level(-1, middle.z - 0.1 * size));
        }
        object.planes.push_back(level(1, middle.z - random.between(0.5, 3) * size));
        const Solid solid = make_solid(object);
        if (!std::isfinite(solid.radius)) continue;
        ++closed;
        for (int i = 0; i < 300; ++i) {
            const ScenePoint p{middle + random.vector(6 * size)};
            bool in = solid.quadric_at(p) <= 0;
            for (const SolidPlane& plane : solid.planes) in = in && solid.plane_at(plane, p) > 0;
            if (!in) continue;
            ++inside;
            CAPTURE(trial);
            REQUIRE(glm::distance(p.metres, solid.anchor.metres) <= solid.radius);
        }
    }
    CHECK(closed > trials(300) / 2);
    CHECK(inside > closed);
}

TEST_CASE("the limb function's scale is |Q(centre)|, and 0 where there is no centre or Q vanishes there") {
    const auto scale_of = [](Shape shape) {
        Object object;
        object.shape = std::move(shape);
        const Solid solid = make_solid(object);
        return std::pair{solid.centre_value, std::abs(solid.quadric_at(solid.anchor))};
    };
    for (const Shape& shape :
         {Shape{Ellipsoid{{{1, 2, 3}}, {2, 3, 4}, {{10}, {20}, {30}}}}, Shape{Hill{{{5, 6, 7}}, 30, 0.4}},
          Shape{GeneralQuadric{{1, 2, 3, 0, 0, 0, -4, 0, 0, -9}}},
          Shape{GeneralQuadric{{1, 2, -3, 0, 0, 0, -4, 0, 0, 9}}}}) {
        const auto [scale, at_centre] = scale_of(shape);
        CHECK(scale > 0);
        CHECK(scale == Approx(at_centre).epsilon(1e-12));
    }
    CHECK(scale_of(GeneralQuadric{{1, 1, -1, 0, 0, 0, -2, 0, 0, 1}}).first == 0);  // a cone
    CHECK(scale_of(GeneralQuadric{{1, 1, 0, 0, 0, 0, 0, 0, -1, 0}}).first == 0);   // a paraboloid
    // Cones whose coefficients are rounded: x^2 + 2 y^2 - 3 z^2 about (a, b, c).
    for (const auto& [a, b, c] :
         {std::array{0.1, 0.2, 0.3}, std::array{1e-7 / 3, 1e-6 / 7, 1e-8}, std::array{1e5 / 3, -70.1, 1e3 / 7}}) {
        CAPTURE(a, b, c);
        CHECK(
            scale_of(GeneralQuadric{{1, 2, -3, 0, 0, 0, -2 * a, -4 * b, 6 * c, a * a + 2 * b * b - 3 * c * c}}).first ==
            0);
    }
    CHECK(scale_of(GeneralQuadric{{1, 1, 1, 0, 0, 0, -2e4, 0, 0, 1e8 - 0.01}}).first == Approx(0.01).epsilon(1e-5));
}
