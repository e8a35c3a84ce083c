#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/outline/figure.h"
#include "ig_core/outline/framing.h"
#include "tests/ig_core/random_objects.h"
#include "tests/outline/eye_forms.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

struct Case {
    Object object;
    ScenePoint eye;
    glm::dmat3 eye_from_scene;
    ImageWindow window;
};

ImageWindow window_of(double half_width) { return {-half_width, half_width, -0.75 * half_width, 0.75 * half_width}; }

/// A solid with a curved quadric, about the line of sight, from near to far.
Case random_case(Randomness& random, bool capped = true) {
    constexpr Kind kCurved[]{Kind::ellipsoid, Kind::hill,       Kind::elliptic_cylinder,
                             Kind::cone,      Kind::two_sheets, Kind::paraboloid};
    const double size = random.log_between(0.5, 200), distance = random.log_between(1.5, 8) * size;
    const double half_width = random.between(0.2, 1.2);
    const glm::dvec3 eye = random.vector(100);
    const glm::dmat3 eye_from_scene = eye_from_scene_rotation(random.attitude());
    const glm::dvec3 ahead(random.between(-half_width, half_width), 1, random.between(-half_width, half_width));
    const Object object = random_object(random, kCurved[random.below(6)],
                                        eye + distance * (glm::transpose(eye_from_scene) * glm::normalize(ahead)), size,
                                        capped, random.below(7));
    return {object, {eye}, eye_from_scene, window_of(half_width)};
}

Figure figure_of(const Case& given) {
    return make_figure(make_solid(given.object), given.eye, given.eye_from_scene, given.window);
}

/// The forms in plain image coordinates.
EyeForms forms_of(const Case& given) {
    return {exact_solid(given.object, given.eye), given.eye_from_scene, EyeSolid{}};
}

double distance_from(const glm::dvec2& p, const std::vector<Polyline>& pieces) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Polyline& piece : pieces)
        for (std::size_t i = 1; i < piece.size(); ++i) {
            const glm::dvec2 along = piece[i] - piece[i - 1];
            const double length2 = glm::dot(along, along);
            const double t = length2 > 0 ? std::clamp(glm::dot(p - piece[i - 1], along) / length2, 0.0, 1.0) : 0.0;
            nearest = std::min(nearest, glm::distance(p, piece[i - 1] + t * along));
        }
    return nearest;
}
double distance_from_segments(const glm::dvec2& p, const Figure& figure) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const VisibleSegment& segment : figure.segments) nearest = std::min(nearest, distance_from(p, segment.pieces));
    return nearest;
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

Object sphere_with_six_planes() {
    Object sphere;
    sphere.shape = Ellipsoid{{{0, 0, 6}}, {5, 5, 5}, {}};
    sphere.planes = {{{0.38, 0.50, -0.78, 8.84}},  {{0.95, 0.06, -0.30, 5.59}},   {{0.43, 0.90, 0.04, 3.75}},
                     {{-0.65, 0.65, -0.41, 6.64}}, {{-0.50, -0.46, -0.74, 8.86}}, {{0.70, 0.37, 0.61, 0.04}}};
    return sphere;
}

/// From where the figure in the documentation is drawn.
Case documented_case() {
    const Object sphere = sphere_with_six_planes();
    const glm::dmat3 eye_from_scene = eye_from_scene_rotation({{30}, {-20}, {0}});
    const double reach = std::tan(Degrees{15}.radians());
    const auto eye = eye_that_frames(make_solid(sphere), eye_from_scene, 0.8 * reach, 0.8 * reach);
    REQUIRE(eye);
    return {sphere, *eye, eye_from_scene, {-reach, reach, -reach, reach}};
}

/// Where a window cuts a chord, the end is no point of the curve.
bool on_border(const ImageWindow& w, const glm::dvec2& p) {
    const double close = 1e-9 * w.width();
    return p.x - w.x_from < close || w.x_to - p.x < close || p.y - w.z_from < close || w.z_to - p.y < close;
}

long count(const Figure& figure, StrokeKind kind) {
    return std::count_if(figure.strokes.begin(), figure.strokes.end(), [&](const Stroke& s) { return s.kind == kind; });
}
long count(const Figure& figure, FigureKeyPoint::Kind kind) {
    return std::count_if(figure.key_points.begin(), figure.key_points.end(),
                         [&](const FigureKeyPoint& k) { return k.kind == kind; });
}

int surface_at(const ExactSolid& solid, const Case& given, const glm::dvec2& p) {
    return surface_through(solid, given.eye_from_scene, p.x, p.y);
}

}  // namespace

TEST_CASE("a figure's strokes lie on the curves and lines they are named after, points and chords") {
    CAPTURE(seed());
    long chords = 0, wrong = 0;
    for (int trial = 0; trial < trials(1000); ++trial) {
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

TEST_CASE("every key point of a figure is an extremum or where two of its strokes meet, and is on what is seen") {
    CAPTURE(seed());
    long of_kind[5] = {}, wrong = 0, hidden = 0;
    for (int trial = -1; trial < trials(1000); ++trial) {
        Randomness random(320'000 + trial);
        const Case given = trial < 0 ? documented_case() : random_case(random);
        const Figure figure = figure_of(given);
        const double width = given.window.width();
        for (const FigureKeyPoint& key : figure.key_points) {
            ++of_kind[static_cast<int>(key.kind)];
            long on = 0;
            for (const Stroke& stroke : figure.strokes)
                on += distance_from(key.at, stroke.pieces) < kFigureTolerance * width;
            const bool extremum =
                key.kind == FigureKeyPoint::Kind::limb_extremum || key.kind == FigureKeyPoint::Kind::curve_extremum;
            if (on < (extremum ? 1 : 2) && wrong++ < 5)
                UNSCOPED_INFO("trial " << trial << " kind " << static_cast<int>(key.kind) << " at (" << key.at.x << ", "
                                       << key.at.y << ") on " << on);
            if (distance_from_segments(key.at, figure) > kFigureTolerance * width && hidden++ < 5)
                UNSCOPED_INFO("trial " << trial << " kind " << static_cast<int>(key.kind) << " at (" << key.at.x << ", "
                                       << key.at.y << ") hidden by " << distance_from_segments(key.at, figure) / width);
        }
    }
    CHECK(hidden == 0);
    CHECK(wrong == 0);
    for (const long n : of_kind) CHECK(n > 100);
}

TEST_CASE("a ray just left of a visible segment meets what the segment has at its left, and so at its right") {
    CAPTURE(seed());
    long points = 0, wrong = 0;
    for (int trial = -1; trial < trials(1000); ++trial) {
        Randomness random(330'000 + trial);
        const Case given = trial < 0 ? documented_case() : random_case(random, random.chance(0.8));
        const Figure figure = figure_of(given);
        const ExactSolid exact = exact_solid(given.object, given.eye);
        const double width = given.window.width(), beside = 1e-7 * width, clear = 3e-3 * width;
        for (const VisibleSegment& segment : figure.segments)
            for (const Polyline& piece : segment.pieces)
                for (std::size_t i = 1; i < piece.size(); ++i) {
                    // Points of a curve are exact; of a straight piece, all between.
                    const bool straight = piece.size() == 2 && segment.kind == StrokeKind::intersection_line;
                    const glm::dvec2 p = straight ? glm::mix(piece[0], piece[1], random.between(0.1, 0.9)) : piece[i];
                    // Curves touch each other where segments end, and some all but touch on their way.
                    if (glm::distance(p, piece.front()) < clear || glm::distance(p, piece.back()) < clear) continue;
                    const auto is_close = [&](const VisibleSegment& other) {
                        return &other != &segment && distance_from(p, other.pieces) < 10 * beside;
                    };
                    if (std::any_of(figure.segments.begin(), figure.segments.end(), is_close)) continue;
                    ++points;
                    const bool level = piece.front().y == piece.back().y;
                    const glm::dvec2 left = level ? glm::dvec2(0, beside) : glm::dvec2(-beside, 0);
                    const int at_left = surface_at(exact, given, p + left),
                              at_right = surface_at(exact, given, p - left);
                    if ((at_left != segment.left || at_right != segment.right) && wrong++ < 5)
                        UNSCOPED_INFO("trial " << trial << " kind " << static_cast<int>(segment.kind) << " at (" << p.x
                                               << ", " << p.y << "): " << segment.left << " | " << segment.right
                                               << ", by ray " << at_left << " | " << at_right);
                }
    }
    CAPTURE(points);
    CHECK(wrong == 0);
    CHECK(points > 5000);
}

TEST_CASE("wherever the surface that rays meet changes, along a row or a column, there is a visible segment") {
    CAPTURE(seed());
    long changes = 0, wrong = 0;
    for (int trial = -1; trial < trials(1000); ++trial) {
        Randomness random(340'000 + trial);
        const Case given = trial < 0 ? documented_case() : random_case(random, random.chance(0.8));
        const Figure figure = figure_of(given);
        const ExactSolid exact = exact_solid(given.object, given.eye);
        const ImageWindow& w = given.window;
        for (int scan = 0; scan < 8; ++scan) {
            const double x = random.between(w.x_from, w.x_to), z = random.between(w.z_from, w.z_to);
            const glm::dvec2 start = scan % 2 == 0 ? glm::dvec2(w.x_from, z) : glm::dvec2(x, w.z_from);
            const glm::dvec2 end = scan % 2 == 0 ? glm::dvec2(w.x_to, z) : glm::dvec2(x, w.z_to);
            constexpr int kSteps = 100;
            int last = surface_at(exact, given, start);
            for (int i = 1; i <= kSteps; ++i) {
                glm::dvec2 from = glm::mix(start, end, (i - 1.0) / kSteps),
                           to = glm::mix(start, end, static_cast<double>(i) / kSteps);
                const int next = surface_at(exact, given, to);
                if (next != last) {
                    for (int halving = 0; halving < 40; ++halving) {
                        const glm::dvec2 middle = 0.5 * (from + to);
                        (surface_at(exact, given, middle) == last ? from : to) = middle;
                    }
                    ++changes;
                    const double off = distance_from_segments(from, figure) / w.width();
                    if (off > kFigureTolerance && wrong++ < 5)
                        UNSCOPED_INFO("trial " << trial << " at (" << from.x << ", " << from.y << "): " << last
                                               << " to " << next << ", nearest segment " << off
                                               << " of the width away");
                }
                last = next;
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(changes > 2000);
}

TEST_CASE("the sphere with six planes has every kind of stroke and key point") {
    const Figure figure = figure_of(documented_case());
    CHECK(count(figure, StrokeKind::limb) == 1);
    CHECK(count(figure, StrokeKind::intersection_curve) == 6);
    CHECK(count(figure, StrokeKind::visibility_line) == 6);
    CHECK(count(figure, StrokeKind::intersection_line) >= 12);  // 15 pairs, some of whose lines pass by the window
    for (const auto kind :
         {FigureKeyPoint::Kind::limb_extremum, FigureKeyPoint::Kind::curve_extremum, FigureKeyPoint::Kind::contact,
          FigureKeyPoint::Kind::intersection, FigureKeyPoint::Kind::triplet})
        CHECK(count(figure, kind) > 0);
    // The two corners by Cramer's rule, from the planes of the file.
    const auto corner = [&](int i, int j, int k) {
        const auto planes = sphere_with_six_planes().planes;
        glm::dmat3 normals;
        glm::dvec3 at;
        glm::length_t row = 0;
        for (const int n : {i, j, k}) {
            const auto& b = planes[static_cast<std::size_t>(n) - 1].coefficients;
            for (glm::length_t axis = 0; axis < 3; ++axis) normals[axis][row] = b[static_cast<std::size_t>(axis)];
            at[row++] = -b[3];
        }
        const Case given = documented_case();
        const glm::dvec3 p = given.eye_from_scene * (glm::inverse(normals) * at - given.eye.metres);
        return glm::dvec2(p.x / p.y, p.z / p.y);
    };
    CHECK(count(figure, FigureKeyPoint::Kind::triplet) == 2);
    for (const glm::dvec2& at : {corner(1, 2, 3), corner(2, 3, 6)})
        CHECK(std::any_of(figure.key_points.begin(), figure.key_points.end(), [&](const FigureKeyPoint& key) {
            return key.kind == FigureKeyPoint::Kind::triplet && glm::distance(key.at, at) < 1e-12;
        }));
}

TEST_CASE(
    "where a solid is seen whole, each z-band begins and ends at a key point's height, and each key point is at such a "
    "height") {
    CAPTURE(seed());
    long borders = 0;
    for (int trial = 0; trial < trials(500); ++trial) {
        Randomness random(350'000 + trial);
        Case given = random_case(random);
        given.window = window_of(0.3);
        const auto eye = eye_that_frames(make_solid(given.object), given.eye_from_scene, 0.25, 0.18);
        if (!eye) continue;
        given.eye = *eye;
        const Figure figure = figure_of(given);
        CAPTURE(trial);
        const double close = 1e-6 * given.window.height();
        for (const FigureBand& band : figure.bands)
            for (const double z : {band.z_from, band.z_to}) {
                ++borders;
                REQUIRE(std::any_of(figure.key_points.begin(), figure.key_points.end(),
                                    [&](const FigureKeyPoint& key) { return std::abs(key.at.y - z) < close; }));
            }
        for (const FigureKeyPoint& key : figure.key_points)
            REQUIRE(std::any_of(figure.bands.begin(), figure.bands.end(), [&](const FigureBand& band) {
                return std::abs(key.at.y - band.z_from) < 10 * close || std::abs(key.at.y - band.z_to) < 10 * close;
            }));
    }
    CHECK(borders > 1000);
}

TEST_CASE("edges seen level are drawn, with what is above at their left and what is below at their right") {
    Object box;
    box.shape = Ellipsoid{{{0, 10, 0}}, {1, 1, 1}, {}};
    for (const double side : {1.0, -1.0}) {
        box.planes.push_back({{side, 0, 0, 0.5}});
        box.planes.push_back({{0, side, 0, 0.5 - 10 * side}});
        box.planes.push_back({{0, 0, side, 0.5}});
    }
    const Figure figure = figure_of({box, {}, glm::dmat3(1.0), window_of(0.1)});
    const double reach = 0.5 / 9.5;
    int level = 0;
    for (const VisibleSegment& segment : figure.segments) {
        REQUIRE(segment.kind == StrokeKind::intersection_line);
        REQUIRE(segment.pieces.size() == 1);
        const glm::dvec2 from = segment.pieces[0].front(), to = segment.pieces[0].back();
        if (std::abs(from.y - to.y) > 1e-6) continue;
        ++level;
        CHECK(from.x == Approx(-reach).epsilon(1e-9));
        CHECK(to.x == Approx(reach).epsilon(1e-9));
        CHECK(std::abs(from.y) == Approx(reach).epsilon(1e-9));
        CHECK(segment.left == (from.y > 0 ? kNoSurface : 2));  // surface 2 keeps y > 9.5
        CHECK(segment.right == (from.y > 0 ? 2 : kNoSurface));
    }
    CHECK(level == 2);
    CHECK(figure.segments.size() == 4);
    CHECK(count(figure, FigureKeyPoint::Kind::triplet) == 4);
    CHECK(figure.key_points.size() == 4);
    CHECK(figure.bands.size() == 1);
}

TEST_CASE("a ball's figure is its limb, its two extrema and the one band between them") {
    Object ball;
    ball.shape = Ellipsoid{{{0, 10, 0}}, {1, 1, 1}, {}};
    const Figure figure = figure_of({ball, {}, glm::dmat3(1.0), window_of(0.2)});
    const double limb = 1 / std::sqrt(99.0);
    REQUIRE(figure.strokes.size() == 1);
    CHECK(figure.strokes[0].kind == StrokeKind::limb);
    for (const Polyline& piece : figure.strokes[0].pieces)
        for (const glm::dvec2& p : piece) CHECK(glm::length(p) == Approx(limb).epsilon(1e-9));
    CHECK(figure.segments.size() == 2);
    REQUIRE(figure.bands.size() == 1);
    CHECK(figure.bands[0].z_from == Approx(-limb).epsilon(1e-12));
    CHECK(figure.bands[0].z_to == Approx(limb).epsilon(1e-12));
    CHECK(count(figure, FigureKeyPoint::Kind::limb_extremum) == 2);
    CHECK_FALSE(figure.solved_by_row);
}

TEST_CASE("a solid without end is solved by row, and its changes are found all the same") {
    Object post;  // X2 + (Y - 10)2 <= 1 above Z = -1
    post.shape = GeneralQuadric{{1, 1, 0, 0, 0, 0, 0, -20, 0, 99}};
    post.planes.push_back({{0, 0, 1, 1}});
    const Figure figure = figure_of({post, {}, glm::dmat3(1.0), window_of(0.3)});
    CHECK(figure.solved_by_row);
    // The eye is above the base: the limb ends where the base's rim touches it, y = 9.9, the rim is lowest at y = 9.
    REQUIRE(figure.bands.size() == 2);
    CHECK(figure.bands[0].z_from == Approx(-1.0 / 9.0).epsilon(1e-9));
    CHECK(figure.bands[0].z_to == Approx(-1.0 / 9.9).epsilon(1e-6));
    CHECK(figure.bands[1].z_to == Approx(figure.window.z_to).epsilon(1e-12));
}

TEST_CASE("what is out of the window, or nothing, leaves a figure empty") {
    Object ball;
    ball.shape = Ellipsoid{{{0, -10, 0}}, {1, 1, 1}, {}};
    const Figure behind = figure_of({ball, {}, glm::dmat3(1.0), window_of(0.2)});
    CHECK(behind.segments.empty());
    CHECK(behind.strokes.empty());
    CHECK(behind.bands.empty());
    Object nothing;  // X2 + Y2 + Z2 + 1 <= 0
    nothing.shape = GeneralQuadric{{1, 1, 1, 0, 0, 0, 0, 0, 0, 1}};
    const Figure none = figure_of({nothing, {{0, -10, 0}}, glm::dmat3(1.0), window_of(0.2)});
    CHECK(none.segments.empty());
    CHECK_FALSE(eye_that_frames(make_solid(nothing), glm::dmat3(1.0), 1, 1));
}

TEST_CASE("an eye that frames a solid sees all of it, in its reach, and nearly fills that where the solid is round") {
    CAPTURE(seed());
    int framed = 0;
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(360'000 + trial);
        Case given = random_case(random);
        const Solid solid = make_solid(given.object);
        const double x_reach = random.between(0.1, 0.5), z_reach = random.between(0.1, 0.5);
        const auto eye = eye_that_frames(solid, given.eye_from_scene, x_reach, z_reach);
        if (!eye) continue;
        ++framed;
        given.eye = *eye;
        given.window = {-2 * x_reach, 2 * x_reach, -2 * z_reach, 2 * z_reach};
        CAPTURE(trial);
        glm::dvec2 reach(0);
        for (const VisibleSegment& segment : figure_of(given).segments)
            for (const Polyline& piece : segment.pieces)
                for (const glm::dvec2& p : piece) reach = glm::max(reach, glm::abs(p) / glm::dvec2(x_reach, z_reach));
        REQUIRE(std::max(reach.x, reach.y) <= 1.01);
        REQUIRE(std::max(reach.x, reach.y) > 0);
    }
    CHECK(framed > trials(1000) / 2);

    Object ball;
    ball.shape = Ellipsoid{{{1e6, -2e6, 30}}, {2, 2, 2}, {}};
    const glm::dmat3 eye_from_scene = eye_from_scene_rotation({{70}, {-10}, {30}});
    const auto eye = eye_that_frames(make_solid(ball), eye_from_scene, 0.4, 0.25);
    REQUIRE(eye);
    // Its nearest point at 2 / 0.25, in the middle.
    const glm::dvec3 centre = eye_from_scene * (glm::dvec3(1e6, -2e6, 30) - eye->metres);
    CHECK(centre.x == Approx(0).margin(1e-3));
    CHECK(centre.y == Approx(2 + 2 / 0.25).epsilon(1e-2));
    CHECK(centre.z == Approx(0).margin(1e-3));
}
