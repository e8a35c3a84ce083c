#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/outline/eye_forms.h"
#include "tests/outline/figure_cases.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// The forms in plain image coordinates.
EyeForms forms_of(const Case& given) {
    return {exact_solid(given.object, given.eye), given.eye_from_scene, EyeSolid{}};
}

/// Whether an image point is within `distance` of the curve or line that a stroke is named after, to second order: a
/// conic may cross itself.
bool is_near_named(const Stroke& stroke, const EyeForms& forms, const glm::dvec2& p, double distance) {
    const Real3 d(p.x, 1, p.y);
    const auto plane = [&](int surface) {
        if (surface == kNearSurface) return ExactPlane{{0, 1, 0}, -kNearDepth, 0};
        for (const ExactPlane& other : forms.planes)
            if (other.surface == surface) return other;
        FAIL("no plane " << surface);
        return ExactPlane{};
    };
    const auto near_line = [&](const Real3& line) {
        return std::abs(glm::dot(line, d)) <= distance * std::hypot(line.x, line.z);
    };
    const auto near_curve = [&](const Real33& curve) {
        const Real3 half_gradient = curve * d;
        const Real curvature =
            std::sqrt(curve[0][0] * curve[0][0] + 2 * curve[0][2] * curve[0][2] + curve[2][2] * curve[2][2]);
        return std::abs(form(curve, d)) <=
               distance * (2 * std::hypot(half_gradient.x, half_gradient.z) + distance * curvature);
    };
    switch (stroke.kind) {
        case StrokeKind::limb:
            return near_curve(forms.limb());
        case StrokeKind::intersection_curve:
            return near_curve(forms.intersection_curve(plane(stroke.plane)));
        case StrokeKind::visibility_line:
            return near_line(forms.visibility_line(plane(stroke.plane)));
        case StrokeKind::intersection_line:
            return near_line(EyeForms::intersection_line(plane(stroke.plane), plane(stroke.other_plane)));
    }
    return false;
}

/// Where a window cuts a chord, the end is no point of the curve.
bool on_border(const ImageWindow& w, const glm::dvec2& p) {
    const double close = 1e-9 * w.width();
    return p.x - w.x_from < close || w.x_to - p.x < close || p.y - w.z_from < close || w.z_to - p.y < close;
}

}  // namespace

TEST_CASE("a figure's strokes lie on the curves and lines they are named after, points and chords") {
    CAPTURE(seed());
    long chords = 0, wrong = 0;
    std::vector<int> chosen{34340, 45009};  // of the shipped seed: curves with level asymptotes
    for (int trial = 0; trial < trials(1000); ++trial) chosen.push_back(trial);
    for (const int trial : chosen) {
        Randomness random(300'000 + trial);
        const Case given = random_case(random, random.chance(0.9));
        const Figure figure = figure_of(given);
        const EyeForms forms = forms_of(given);
        const double width = given.window.width();
        for (const Stroke& stroke : figure.strokes) {
            if (stroke.plane == kNoSurface) continue;  // a quadric's own infinity
            for (const Polyline& piece : stroke.pieces)
                for (std::size_t i = 1; i < piece.size(); ++i) {
                    ++chords;
                    const glm::dvec2 middle = 0.5 * (piece[i - 1] + piece[i]);
                    if ((is_near_named(stroke, forms, piece[i], 1e-6 * width) || on_border(given.window, piece[i])) &&
                        is_near_named(stroke, forms, middle, kFigureTolerance * width))
                        continue;
                    if (wrong++ < 5)
                        UNSCOPED_INFO("trial " << trial << ": kind " << static_cast<int>(stroke.kind) << " at ("
                                               << piece[i].x << ", " << piece[i].y << ")");
                }
        }
    }
    CHECK(wrong == 0);
    CHECK(chords > 10000);
}

TEST_CASE("every point of a curve or line in the window and before the eye is drawn") {
    CAPTURE(seed());
    long points = 0, missing = 0;
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(310'000 + trial);
        const Case given = random_case(random, random.chance(0.9));
        const Figure figure = figure_of(given);
        const EyeForms forms = forms_of(given);
        const auto check = [&](StrokeKind kind, int surface, int other, const Real3& d) {
            const glm::dvec2 p(d.x, d.z);
            // A bit cut off by the border may be less than a chord's tolerance.
            const double border = 10 * kFigureTolerance * given.window.width();
            if (!(p.x > given.window.x_from + border && p.x < given.window.x_to - border)) return;
            ++points;
            const bool drawn = std::any_of(figure.strokes.begin(), figure.strokes.end(), [&](const Stroke& stroke) {
                return stroke.kind == kind && stroke.plane == surface && stroke.other_plane == other &&
                       distance_from(p, stroke.pieces) < kFigureTolerance * given.window.width();
            });
            if (!drawn && missing++ < 5)
                UNSCOPED_INFO("trial " << trial << " kind " << static_cast<int>(kind) << " at (" << p.x << ", " << p.y
                                       << ")");
        };
        for (int row = 0; row < 10; ++row) {
            const Real z = random.between(0.99 * given.window.z_from, 0.99 * given.window.z_to);
            const auto roots = [&](const Real33& curve, auto&& found) {
                const Real a = curve[0][0], b = curve[0][1] + z * curve[0][2],
                           c = curve[1][1] + z * (2 * curve[1][2] + z * curve[2][2]), discriminant = b * b - a * c;
                if (!(discriminant > 1e-9L * (b * b + std::abs(a * c)))) return;
                const Real q = -(b + std::copysign(std::sqrt(discriminant), b));
                for (const Real x : {q / a, c / q}) found(Real3(x, 1, z));
            };
            roots(forms.limb(), [&](const Real3& d) {
                if (-glm::dot(forms.v, d) / form(forms.m, d) > 0) check(StrokeKind::limb, 0, 0, d);
            });
            for (std::size_t i = 0; i < forms.planes.size(); ++i) {
                const ExactPlane& plane = forms.planes[i];
                if (plane.surface == 0) continue;
                roots(forms.intersection_curve(plane), [&](const Real3& d) {
                    if (-plane.at_eye / glm::dot(plane.normal, d) > 0)
                        check(StrokeKind::intersection_curve, plane.surface, 0, d);
                });
                const Real3 line = forms.visibility_line(plane);
                check(StrokeKind::visibility_line, plane.surface, 0, {-(line.y + line.z * z) / line.x, 1, z});
                for (std::size_t j = 0; j < i; ++j)
                    if (forms.planes[j].surface != 0) {
                        const Real3 edge = EyeForms::intersection_line(forms.planes[j], plane);
                        if (glm::length(glm::cross(plane.normal, forms.planes[j].normal)) > 1e-9L)
                            check(StrokeKind::intersection_line, forms.planes[j].surface, plane.surface,
                                  {-(edge.y + edge.z * z) / edge.x, 1, z});
                    }
            }
        }
    }
    CHECK(missing == 0);
    CHECK(points > 10000);
}

TEST_CASE("a curve that comes into the window for a short while is followed there") {
    CAPTURE(seed());
    const ImageWindow window{-1, 1, -1, 1};
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(320'000 + trial);
        const double side = random.chance(0.5) ? 1 : -1, bend = random.log_between(1, 1000);
        const double reach = random.between(-0.9, 0.9), height = random.between(-0.9, 0.9);
        const auto x_at = [&](double z) { return side * (reach - bend * (z - height) * (z - height)); };
        const std::vector<Polyline> pieces = follow(-1, 1, x_at, window, kFigureTolerance);
        const double half = std::sqrt((reach + 0.99) / bend);
        for (const double part : {-1.0, -0.7, -0.3, 0.0, 0.2, 0.6, 0.9}) {
            const double z = std::clamp(height + part * half, -1.0, 1.0);
            CAPTURE(trial, bend, reach, height, z);
            REQUIRE(distance_from({x_at(z), z}, pieces) < kFigureTolerance);
        }
    }
}
