#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/outline/framing.h"
#include "tests/outline/figure_cases.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

long count(const Figure& figure, StrokeKind kind) {
    return std::count_if(figure.strokes.begin(), figure.strokes.end(), [&](const Stroke& s) { return s.kind == kind; });
}
long count(const Figure& figure, FigureKeyPoint::Kind kind) {
    return std::count_if(figure.key_points.begin(), figure.key_points.end(),
                         [&](const FigureKeyPoint& k) { return k.kind == kind; });
}

}  // namespace

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
