#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/outline/outline.h"
#include "tests/ig_core/random_objects.h"
#include "tests/outline/eye_forms.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// A form's value at an image point relative to the size of what it sums up.
Real relative(const Real33& m, const Real3& d) { return std::abs(form(m, d)) / (norm(m) * glm::dot(d, d)); }
Real relative(const Real3& line, const Real3& d) { return std::abs(glm::dot(line, d)) / (norm(line) * norm(d)); }

/// Discriminant in xi of a form's row, relative to the form's.
Real discriminant(const Real33& m, Real zeta) {
    const Real beta = m[0][1] + zeta * m[0][2], gamma = m[1][1] + zeta * (2 * m[1][2] + zeta * m[2][2]);
    return std::abs(beta * beta - m[0][0] * gamma) / (norm(m) * norm(m) * (1 + zeta * zeta));
}

constexpr Real kOn = 1e-7L;

Outline outline_from_origin(const Object& object, const glm::dmat3& eye_from_scene = glm::dmat3(1.0)) {
    Outline outline;
    make_outline(make_solid(object), 0, {}, eye_from_scene, {0.15, 0.3 / 480, 480}, outline);
    return outline;
}

long count(const Outline& outline, KeyPoint::Kind kind) {
    return std::count_if(outline.key_points.begin(), outline.key_points.end(),
                         [&](const KeyPoint& k) { return k.kind == kind; });
}

}  // namespace

TEST_CASE("key points lie on the curves and lines that they are named after") {
    CAPTURE(seed());
    long of_kind[4] = {};
    for (int trial = 0; trial < trials(2000); ++trial) {
        Randomness random(trial);
        constexpr Kind kCurved[]{Kind::ellipsoid, Kind::hill,       Kind::elliptic_cylinder,
                                 Kind::cone,      Kind::two_sheets, Kind::paraboloid};
        const glm::dmat3 eye_from_scene = eye_from_scene_rotation(random.attitude());
        const glm::dvec3 ahead(random.between(-1, 1), 1, random.between(-1, 1));
        const Object object =
            random_object(random, kCurved[random.below(6)],
                          random.between(3, 12) * (glm::transpose(eye_from_scene) * ahead), 2, true, random.below(5));
        const Outline outline = outline_from_origin(object, eye_from_scene);
        if (outline.direct) continue;
        const EyeForms forms(exact_solid(object, {}), eye_from_scene, outline.solid);
        // The plane at k_near bounds a solid too.
        std::vector<ExactPlane> planes = forms.planes;
        planes.push_back({{0, 1, 0}, -kNearDepth, 0});
        const auto any_plane = [&](auto&& holds) { return std::any_of(planes.begin(), planes.end(), holds); };
        for (const KeyPoint& key : outline.key_points) {
            ++of_kind[static_cast<int>(key.kind)];
            const Real3 d(key.xi, 1, key.zeta);
            CAPTURE(trial, static_cast<int>(key.kind), key.xi, key.zeta);
            switch (key.kind) {
                case KeyPoint::Kind::limb_extremum:
                    // On a cylinder that lies level every row meets one line: what rounding adds is a band in vain.
                    if (std::abs(forms.limb()[0][0]) < 1e-12L * norm(forms.limb())) break;
                    REQUIRE(relative(forms.limb(), d) < kOn);
                    REQUIRE(discriminant(forms.limb(), key.zeta) < kOn);
                    break;
                case KeyPoint::Kind::curve_extremum:
                    REQUIRE(any_plane([&](const ExactPlane& j) {
                        const Real33 curve = forms.intersection_curve(j);
                        return relative(curve, d) < kOn && discriminant(curve, key.zeta) < kOn;
                    }));
                    break;
                case KeyPoint::Kind::contact:
                    REQUIRE(relative(forms.limb(), d) < kOn);
                    REQUIRE(any_plane([&](const ExactPlane& j) {
                        return relative(forms.visibility_line(j), d) < kOn &&
                               relative(forms.intersection_curve(j), d) < kOn;
                    }));
                    break;
                case KeyPoint::Kind::edge_end: {
                    // An intersection point lies on two curves and their line; a triplet on three lines.
                    const bool holds = any_plane([&](const ExactPlane& i) {
                        return any_plane([&](const ExactPlane& j) {
                            if (&i >= &j || relative(EyeForms::intersection_line(i, j), d) > kOn) return false;
                            const bool on_quadric = relative(forms.intersection_curve(i), d) < kOn &&
                                                    relative(forms.intersection_curve(j), d) < kOn;
                            return on_quadric || any_plane([&](const ExactPlane& k) {
                                       return &k != &i && &k != &j &&
                                              relative(EyeForms::intersection_line(i, k), d) < kOn &&
                                              relative(EyeForms::intersection_line(j, k), d) < kOn;
                                   });
                        });
                    });
                    REQUIRE(holds);
                    break;
                }
            }
        }
    }
    for (const long n : of_kind) CHECK(n > 200);
}

TEST_CASE("a ball cut on six sides, faces apart, has a contact where each side face meets the limb") {
    // Faces at 0.8 are circles of 0.6 that do not meet. Limb: y = -0.1, radius sqrt(0.99) = 0.995; faces cut it at +-x
    // and +-z.
    const Outline outline = outline_from_origin(cut_ball(0.8));
    CHECK(count(outline, KeyPoint::Kind::contact) == 8);
    CHECK(count(outline, KeyPoint::Kind::edge_end) == 0);
    CHECK(count(outline, KeyPoint::Kind::limb_extremum) == 0);  // cut away by top and bottom
    // Two on the front face; top and bottom reach furthest up and down at their front, y = -0.6.
    CHECK(count(outline, KeyPoint::Kind::curve_extremum) == 4);
    const double reach = 0.8 / (10 - 0.6), contact = 0.8 / 9.9;
    double highest = 0, contact_height = 0;
    for (const KeyPoint& key : outline.key_points) {
        if (key.kind == KeyPoint::Kind::curve_extremum) highest = std::max(highest, key.zeta);
        if (key.kind == KeyPoint::Kind::contact) contact_height = std::max(contact_height, key.zeta);
    }
    CHECK(highest == Approx(reach).epsilon(1e-12));
    CHECK(contact_height == Approx(contact).epsilon(1e-12));
}

TEST_CASE("a ball cut on six sides, faces joined by edges, has the ends of the edges in sight and no limb") {
    // Faces at 0.6: edges of half length sqrt(1 - 0.72). The four of the front face, and the front ends of four that
    // run back.
    const Outline outline = outline_from_origin(cut_ball(0.6));
    CHECK(count(outline, KeyPoint::Kind::contact) == 0);
    CHECK(count(outline, KeyPoint::Kind::limb_extremum) == 0);
    CHECK(count(outline, KeyPoint::Kind::curve_extremum) == 0);
    CHECK(count(outline, KeyPoint::Kind::edge_end) == 8 + 4);
    CHECK(outline.lines.size() == 4);
    for (const KeyPoint& key : outline.key_points) {
        const double half = std::sqrt(1 - 0.72);
        const bool front_edge =
            std::abs(std::abs(key.xi) * 9.4 - 0.6) < 1e-12 || std::abs(std::abs(key.zeta) * 9.4 - 0.6) < 1e-12;
        const bool running_back = std::abs(std::abs(key.xi) * (10 - half) - 0.6) < 1e-12 &&
                                  std::abs(std::abs(key.zeta) * (10 - half) - 0.6) < 1e-12;
        CHECK((front_edge || running_back));
    }
}

TEST_CASE("a box within its quadric has the corners of its visible faces as key points") {
    const Outline outline = outline_from_origin(cut_ball(0.5));  // corners at a distance of 0.87 < 1
    CHECK(count(outline, KeyPoint::Kind::contact) + count(outline, KeyPoint::Kind::limb_extremum) +
              count(outline, KeyPoint::Kind::curve_extremum) ==
          0);
    CHECK(outline.lines.size() == 4);
    for (const KeyPoint& key : outline.key_points) {
        CHECK(std::abs(key.xi) == Approx(0.5 / 9.5).epsilon(1e-12));
        CHECK(std::abs(key.zeta) == Approx(0.5 / 9.5).epsilon(1e-12));
    }
}

TEST_CASE("a ball without planes needs no z-bands: one cut on each row between its limb's extrema") {
    Object ball = cut_ball(1);
    ball.planes.clear();
    const Outline outline = outline_from_origin(ball);
    CHECK(outline.limb_only);
    const double limb = 1 / std::sqrt(99.0);
    CHECK(outline.zeta_to == Approx(limb).epsilon(1e-12));
    CHECK(outline.zeta_from == Approx(-limb).epsilon(1e-12));
    Cut cuts[kMaxCuts];
    for (const double z : {-0.1, -0.05, 0.0, 0.03, 0.1}) {
        REQUIRE(cuts_on_row(outline, z, cuts) == 1);
        CHECK(cuts[0].surface == 0);
        CHECK(cuts[0].from == Approx(-std::sqrt(limb * limb - z * z)).epsilon(1e-9));
        CHECK(cuts[0].to == Approx(std::sqrt(limb * limb - z * z)).epsilon(1e-9));
    }
    CHECK(cuts_on_row(outline, 0.1006, cuts) == 0);
    CHECK(cuts_on_row(outline, -0.1006, cuts) == 0);
}
