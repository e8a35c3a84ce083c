#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/ig_core/exact_solid.h"
#include "tests/outline/figure_cases.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

double distance_from_segments(const glm::dvec2& p, const Figure& figure) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const VisibleSegment& segment : figure.segments) nearest = std::min(nearest, distance_from(p, segment.pieces));
    return nearest;
}

int surface_at(const ExactSolid& solid, const Case& given, const glm::dvec2& p) {
    return surface_through(solid, given.eye_from_scene, p.x, p.y);
}

}  // namespace

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
