#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/outline/boundary_lanes.h"
#include "ig_core/outline/curve_lanes.h"
#include "tests/ig_core/random_objects.h"
#include "tests/ig_core/simd_targets.h"
#include "tests/outline/eye_forms.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// An object ahead of an eye, seen about as large as it is far: nothing in the table's own formulas cancels badly.
struct Sight {
    Object object;
    ScenePoint eye;
    glm::dmat3 eye_from_scene;
    ExactSolid exact;
    EyeSolid solid;
    EyeForms forms;
};

Sight random_sight(int trial) {
    Randomness random(trial);
    constexpr Kind kCurved[]{Kind::ellipsoid, Kind::hill,       Kind::elliptic_cylinder,
                             Kind::cone,      Kind::two_sheets, Kind::paraboloid};
    const glm::dvec3 eye = random.vector(50);
    const glm::dmat3 eye_from_scene = eye_from_scene_rotation(random.attitude());
    const double size = random.log_between(1, 30), distance = size * random.between(1.5, 6);
    const glm::dvec3 ahead = glm::normalize(glm::dvec3(random.between(-1, 1), 1, random.between(-1, 1)));
    Object object =
        random_object(random, kCurved[random.below(6)], eye + distance * (glm::transpose(eye_from_scene) * ahead), size,
                      true, 1 + random.below(4));
    ExactSolid exact = exact_solid(object, {eye});
    EyeSolid solid;
    look_at(make_solid(object), {eye}, eye_from_scene, false, false, SetUp::anchored, solid);
    EyeForms forms(exact, eye_from_scene, solid);
    return {std::move(object), {eye}, eye_from_scene, std::move(exact), solid, std::move(forms)};
}

const EyePlane& plane(const EyeSolid& solid, std::size_t j) { return solid.planes[j]; }

/// What the forms of well-conditioned cases are good for.
constexpr double kRounding = 1e-11;

/// Whether a row conic's discriminant is beta^2 - alpha gamma of the form that it stands for.
bool has_discriminant(const RowConic& conic, const Real33& f, Real zeta) {
    const Real scale = inner(full(conic), f) / inner(f, f);
    const Real beta = f[0][1] + zeta * f[0][2];
    const Real gamma = f[1][1] + zeta * (2 * f[1][2] + zeta * f[2][2]);
    const Real expected = scale * scale * (beta * beta - f[0][0] * gamma);
    const Real size = scale * scale * inner(f, f) * (1 + zeta * zeta);
    return std::abs(conic.discriminant_at(static_cast<double>(zeta)) - expected) < kRounding * size;
}

CurveLanes lanes_of(const EyeSolid& solid) {
    CurveLanes curves;
    for (std::size_t j = 0; j < solid.planes.size(); ++j)
        if (solid.planes[j].cuts) curves.add(j, solid.planes[j]);
    return curves;
}

/// All of a curve: that of a solid without end or planes.
RowRoots roots_on_row(const RowConic& conic, double zeta) {
    Outline outline;
    outline.direct = true;
    outline.curves.push_back({conic, {}, {}});
    return roots_on_solid(outline, 0, nullptr, zeta);
}

Real3 random_ray(Randomness& random) { return {random.between(-2, 2), 1, random.between(-2, 2)}; }

}  // namespace

TEST_CASE(
    "limb, intersection curves, visibility and intersection lines are the table's formulas, up to rounding and scale") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(2000); ++trial) {
        const Sight sight = random_sight(trial);
        const EyeForms& forms = sight.forms;
        CAPTURE(trial);
        REQUIRE(difference_up_to_scale(full(sight.solid.limb), forms.limb()) < kRounding);
        REQUIRE(difference_up_to_scale(full(limb_on_rows(sight.solid)), forms.limb()) < kRounding);
        for (std::size_t j = 0; j < forms.planes.size(); ++j) {
            CAPTURE(j);
            const EyePlane& pj = plane(sight.solid, j);
            REQUIRE(difference_up_to_scale(full(intersection_curve_on_rows(sight.solid, pj)),
                                           forms.intersection_curve(forms.planes[j])) < kRounding);
            REQUIRE(difference_up_to_scale(Real3(visibility_line(sight.solid, pj)),
                                           forms.visibility_line(forms.planes[j])) < kRounding);
            for (std::size_t i = 0; i < j; ++i) {
                const Real3 expected = EyeForms::intersection_line(forms.planes[i], forms.planes[j]);
                const Real scale = norm(forms.planes[i].normal) * norm(forms.planes[j].normal);
                if (norm(expected) < 1e-6L * scale) continue;  // parallel planes about the eye: no line to speak of
                REQUIRE(difference_up_to_scale(Real3(intersection_line(sight.solid, plane(sight.solid, i), pj)),
                                               expected) < kRounding);
            }
        }
    }
}

TEST_CASE("a row conic's discriminant is beta^2 - alpha gamma") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(2000); ++trial) {
        const Sight sight = random_sight(trial);
        Randomness random(trial);
        const Real zeta = random.between(-2, 2);
        CAPTURE(trial);
        REQUIRE(has_discriminant(limb_on_rows(sight.solid), sight.forms.limb(), zeta));
        for (std::size_t j = 0; j < sight.forms.planes.size(); ++j)
            REQUIRE(has_discriminant(intersection_curve_on_rows(sight.solid, plane(sight.solid, j)),
                                     sight.forms.intersection_curve(sight.forms.planes[j]), zeta));
    }
}

TEST_CASE("curves of all planes at once are the table's formulas, too, on every instruction set") {
    CAPTURE(seed());
    const std::vector<std::int64_t> targets = simd_targets();
    long checked = 0;
    for (int trial = 0; trial < trials(2000); ++trial) {
        const Sight sight = random_sight(trial);
        if (sight.solid.anchor.x != 0.0 || sight.solid.anchor.z != 0.0) continue;
        const Real zeta = Randomness(trial).between(-2, 2);
        const std::int64_t target = targets[static_cast<std::size_t>(trial) % targets.size()];
        const SimdTarget held(target);
        CurveLanes curves = lanes_of(sight.solid);
        find_curves_about_axis(sight.solid, curves);
        for (std::size_t lane = 1; lane < curves.count; ++lane, ++checked) {
            const ExactPlane& pj = sight.forms.planes[static_cast<std::size_t>(curves.plane[lane])];
            const Real33 expected = sight.forms.intersection_curve(pj);
            CAPTURE(trial, target, lane);
            REQUIRE(difference_up_to_scale(full(curves.conic(lane)), expected) < kRounding);
            REQUIRE(has_discriminant(curves.conic(lane), expected, zeta));
            REQUIRE(difference_up_to_scale(Real3(curves.line(lane)), sight.forms.visibility_line(pj)) < kRounding);
        }
    }
    CHECK(checked > trials(2000));
}

TEST_CASE("extrema and contacts are the same numbers on every instruction set") {
    CAPTURE(seed());
    long points = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        const Sight sight = random_sight(trial);
        CurveLanes first;
        for (const std::int64_t target : simd_targets()) {
            const SimdTarget held(target);
            CurveLanes curves = lanes_of(sight.solid);
            for (std::size_t lane = 1; lane < curves.count; ++lane) {
                const EyePlane& of = plane(sight.solid, static_cast<std::size_t>(curves.plane[lane]));
                curves.set_curve(lane, intersection_curve_on_rows(sight.solid, of), visibility_line(sight.solid, of));
            }
            find_points(sight.solid, limb_on_rows(sight.solid), curves);
            const auto compare = [&](const CurveLanes::Point& point, const CurveLanes::Point& other, std::size_t lane) {
                CAPTURE(trial, target, lane);
                REQUIRE(std::isnan(point.zeta[lane]) == std::isnan(other.zeta[lane]));
                if (std::isnan(point.zeta[lane])) return;
                REQUIRE(point.zeta[lane] == other.zeta[lane]);
                REQUIRE(point.xi[lane] == other.xi[lane]);
                ++points;
            };
            if (first.count == 1) first = curves;
            for (std::size_t lane = 0; lane < curves.count; ++lane)
                for (std::size_t i = 0; i < 2; ++i) {
                    compare(curves.extrema[i], first.extrema[i], lane);
                    if (lane > 0) compare(curves.contacts[i], first.contacts[i], lane);
                }
        }
    }
    CHECK(points > 5 * trials(300));
}

TEST_CASE("intersection curve and limb touch where the visibility line crosses them: s E = V V' - b^2 L") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(2000); ++trial) {
        const Sight sight = random_sight(trial);
        const Real s = sight.solid.s;
        for (std::size_t j = 0; j < sight.forms.planes.size(); ++j) {
            const EyePlane& pj = plane(sight.solid, j);
            const Real b = pj.at_eye;
            const Real3 line(visibility_line(sight.solid, pj));
            const Real33 left = s * full(intersection_curve_on_rows(sight.solid, pj));
            const Real33 both = glm::outerProduct(line, line), limb = b * b * full(sight.solid.limb);
            CAPTURE(trial, j);
            REQUIRE(norm(left - (both - limb)) < 1e-11L * (norm(both) + norm(limb)));
        }
    }
}

TEST_CASE("the limb form is positive exactly where a ray meets the quadric") {
    CAPTURE(seed());
    int met = 0, missed = 0;
    for (int trial = 0; trial < trials(1000); ++trial) {
        const Sight sight = random_sight(trial);
        Randomness random(trial);
        for (int i = 0; i < 50; ++i) {
            const Real3 d = random_ray(random);
            // Eq 4 in scene space: A k^2 + 2 B k + C has a root.
            const Real3 along = ray(sight.eye_from_scene, d.x + sight.solid.x0, d.z + sight.solid.z0);
            const Real a = glm::dot(along, sight.exact.m * along), b = glm::dot(sight.exact.v, along),
                       c = sight.exact.s;
            if (std::abs(b * b - a * c) < 1e-9L * (b * b + std::abs(a * c))) continue;
            const bool meets = b * b > a * c;
            (meets ? met : missed) += 1;
            REQUIRE((value(sight.solid.limb, glm::dvec3(d)) > 0) == meets);
        }
    }
    CHECK(met > 1000);
    CHECK(missed > 1000);
}

TEST_CASE("an intersection curve holds the rays that meet plane and quadric at one point") {
    CAPTURE(seed());
    int points = 0;
    for (int trial = 0; trial < trials(2000); ++trial) {
        const Sight sight = random_sight(trial);
        Randomness random(trial);
        for (std::size_t j = 0; j < sight.forms.planes.size(); ++j) {
            const RowConic curve = intersection_curve_on_rows(sight.solid, plane(sight.solid, j));
            const ExactPlane& pj = sight.forms.planes[j];
            const Real zeta = random.between(-1, 1);
            if (curve.discriminant_at(static_cast<double>(zeta)) <= 0) continue;
            const RowRoots roots = roots_on_row(curve, static_cast<double>(zeta));
            for (const double xi : {roots.rising, roots.falling}) {
                if (!std::isfinite(xi) || std::abs(xi) > 10) continue;
                const Real3 d(xi, 1, zeta);
                const Real slope = glm::dot(pj.normal, d);
                if (std::abs(slope) < 1e-3L * norm(pj.normal)) continue;
                const Real3 p = -pj.at_eye / slope * d;
                const Real terms = std::abs(form(sight.forms.m, p)) + 2 * std::abs(glm::dot(sight.forms.v, p)) +
                                   std::abs(sight.forms.s);
                const Real q = form(sight.forms.m, p) + 2 * glm::dot(sight.forms.v, p) + sight.forms.s;
                CAPTURE(trial, j, xi);
                REQUIRE(std::abs(q) < 1e-7L * terms);
                ++points;
            }
        }
    }
    CHECK(points > 1000);
}

TEST_CASE("a visibility line's positive side is the part of the limb that its plane keeps") {
    CAPTURE(seed());
    int kept = 0, cut = 0;
    for (int trial = 0; trial < trials(2000); ++trial) {
        const Sight sight = random_sight(trial);
        Randomness random(trial);
        if (!(sight.forms.s > 0)) continue;  // the eye is inside the quadric: no limb
        const RowConic limb = limb_on_rows(sight.solid);
        const double zeta = random.between(-1, 1);
        if (limb.discriminant_at(zeta) <= 0) continue;
        const RowRoots roots = roots_on_row(limb, zeta);
        for (const double xi : {roots.rising, roots.falling}) {
            if (!std::isfinite(xi) || std::abs(xi) > 10) continue;
            const Real3 d(xi, 1, zeta);
            const Real k = -sight.forms.s / glm::dot(sight.forms.v, d);  // Eq 5: the double root of Eq 4
            if (!(k > 0)) continue;
            for (std::size_t j = 0; j < sight.forms.planes.size(); ++j) {
                const ExactPlane& pj = sight.forms.planes[j];
                const Real at = k * glm::dot(pj.normal, d) + pj.at_eye;
                if (std::abs(at) < 1e-6L * (std::abs(pj.at_eye) + k * norm(pj.normal) * norm(d))) continue;
                CAPTURE(trial, j, xi);
                REQUIRE((glm::dot(visibility_line(sight.solid, plane(sight.solid, j)), glm::dvec3(d)) > 0) == (at > 0));
                (at > 0 ? kept : cut) += 1;
            }
        }
    }
    CHECK(kept > 500);
    CHECK(cut > 500);
}

TEST_CASE("an intersection line holds the rays to the points that lie on both planes") {
    CAPTURE(seed());
    int points = 0;
    for (int trial = 0; trial < trials(2000); ++trial) {
        const Sight sight = random_sight(trial);
        Randomness random(trial);
        for (std::size_t j = 1; j < sight.forms.planes.size(); ++j) {
            const ExactPlane &pi = sight.forms.planes[j - 1], &pj = sight.forms.planes[j];
            const glm::dvec3 line = intersection_line(sight.solid, plane(sight.solid, j - 1), plane(sight.solid, j));
            const double zeta = random.between(-1, 1), xi = -(line.y + line.z * zeta) / line.x;
            if (!(std::abs(xi) < 10)) continue;
            const Real3 d(xi, 1, zeta);
            const Real slope = glm::dot(pi.normal, d);
            if (std::abs(slope) < 1e-3L * norm(pi.normal)) continue;
            const Real k = -pi.at_eye / slope, at = k * glm::dot(pj.normal, d) + pj.at_eye;
            CAPTURE(trial, j);
            REQUIRE(std::abs(at) < 1e-8L * (std::abs(pj.at_eye) + std::abs(k) * norm(pj.normal) * norm(d)));
            ++points;
        }
    }
    CHECK(points > 500);
}

TEST_CASE(
    "row roots are the conic's zeros, the rising one where the form grows to the right, on every instruction set") {
    CAPTURE(seed());
    const std::vector<std::int64_t> targets = simd_targets();
    int checked = 0;
    for (int trial = 0; trial < trials(5000); ++trial) {
        Randomness random(trial);
        RowConic conic;
        conic.alpha = random.between(-1, 1);
        conic.beta = {random.between(-1, 1), random.between(-1, 1)};
        conic.gamma = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
        const auto& [b0, b1] = conic.beta;
        const auto& [g0, g1, g2] = conic.gamma;
        if (random.chance(0.1)) conic.alpha = 0;
        const double alpha = conic.alpha;
        conic.discriminant = {b0 * b0 - alpha * g0, 2 * b0 * b1 - alpha * g1, b1 * b1 - alpha * g2};
        const double zeta = random.between(-1, 1);
        if (conic.discriminant_at(zeta) < 1e-6) continue;
        const SimdTarget held(targets[static_cast<std::size_t>(trial) % targets.size()]);
        const RowRoots roots = roots_on_row(conic, zeta);
        const Real beta = b0 + static_cast<Real>(zeta) * b1,
                   gamma = g0 + static_cast<Real>(zeta) * (g1 + static_cast<Real>(zeta) * g2);
        const auto check = [&](double xi, int sign) {
            if (!std::isfinite(xi)) return;
            const Real at = alpha * static_cast<Real>(xi) * xi + 2 * beta * xi + gamma;
            const Real size = std::abs(alpha * static_cast<Real>(xi) * xi) + 2 * std::abs(beta * xi) + std::abs(gamma);
            CAPTURE(trial, xi);
            REQUIRE(std::abs(at) < 1e-9L * size);
            REQUIRE(sign * (alpha * xi + beta) > 0);
            ++checked;
        };
        check(roots.rising, 1);
        check(roots.falling, -1);
    }
    CHECK(checked > 3000);
}

TEST_CASE("the first surface of a ray through an outline's solid is the one that a ray cast finds") {
    CAPTURE(seed());
    int seen = 0;
    for (int trial = 0; trial < trials(1000); ++trial) {
        const Sight sight = random_sight(trial);
        EyeSolid solid;
        look_at(make_solid(sight.object), sight.eye, sight.eye_from_scene, true, false, SetUp::anchored, solid);
        Randomness random(trial);
        for (int i = 0; i < 30; ++i) {
            const Real3 d = random_ray(random);
            const Real x = d.x + solid.x0, z = d.z + solid.z0;
            if (is_tie(sight.exact, sight.eye_from_scene, x, z, 1e-9L, 1e-9L)) continue;
            const int expected = surface_through(sight.exact, sight.eye_from_scene, x, z);
            CAPTURE(trial, i);
            REQUIRE(surface_at(solid, static_cast<double>(d.x), static_cast<double>(d.z)) == expected);
            seen += expected >= 0;
        }
    }
    CHECK(seen > 500);
}

TEST_CASE("a face is found by its surface, and what shading takes of quadric and faces is theirs in scene axes") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(1000); ++trial) {
        const Sight sight = random_sight(trial);
        const EyeSolid& e = sight.solid;
        CAPTURE(trial);
        for (std::size_t j = 0; j < sight.object.planes.size(); ++j) {
            CAPTURE(j);
            const EyePlane& face = e.face(static_cast<int>(j) + 1);
            REQUIRE(face.surface == static_cast<int>(j) + 1);
            const auto& b = sight.object.planes[j].coefficients;
            const glm::dvec3 inward = glm::normalize(glm::dvec3(b[0], b[1], b[2]));
            const auto& n = face.scene_outward;
            REQUIRE(glm::length(inward + glm::dvec3(n[0], n[1], n[2])) < 1e-6);
        }
        // The gradient at the eye, M (eye - anchor) + w, is v of Eq 4 in other axes.
        const SceneQuadric& q = e.in_scene;
        const glm::dvec3 p(q.eye_from_anchor[0], q.eye_from_anchor[1], q.eye_from_anchor[2]),
            w(q.gradient[0], q.gradient[1], q.gradient[2]);
        const glm::dvec3 at_eye = Sym3{q.m[0], q.m[1], q.m[2], q.m[3], q.m[4], q.m[5]} * p + w;
        const glm::dvec3 turned = sight.eye_from_scene * at_eye;
        REQUIRE(std::abs(turned.x - e.v.x) < 1e-5 * (glm::length(at_eye) + glm::length(p)));
        REQUIRE(std::abs(turned.z - e.v.z) < 1e-5 * (glm::length(at_eye) + glm::length(p)));
    }
}
