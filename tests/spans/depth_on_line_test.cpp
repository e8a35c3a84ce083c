#include "ig_core/spans/depth_on_line.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>

#include "ig_core/spans/object_spans.h"
#include "tests/ig_core/exact_solid.h"
#include "tests/ig_core/random_objects.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

constexpr int kPictureColumns = 80, kPictureRows = 60;

/// Two sub-scan lines of a random object's picture, and its spans on them.
struct SeenRow {
    Object object;
    Outline outline;
    PixelRow row;
    std::vector<RowSpan> spans;

    explicit SeenRow(Randomness& random) {
        const double size = random.log_between(0.5, 200), distance = random.log_between(0.6, 60) * size;
        const glm::dvec3 centre(distance * random.between(-0.5, 0.5), distance, distance * random.between(-0.4, 0.4));
        object = random_object(random, random_kind(random), centre, size);
        const ImagePlane image = ImagePlane::symmetric(kPictureColumns, kPictureRows, {random.log_between(5, 120)});
        make_outline(make_solid(object), 0, {}, glm::dmat3(1.0), {image.top, image.row_step / 2, 2 * kPictureRows},
                     outline);
        row.row = random.below(kPictureRows), row.columns = kPictureColumns, row.sub_lines = 2;
        row.left = image.left, row.column_step = image.column_step, row.row_step = image.row_step;
        row.z[0] = image.z(row.row + 0.25), row.z[1] = image.z(row.row + 0.75);
        BandPlace band = kHighestBand;
        add_object_spans(outline, 0, true, row, band, spans);
    }
};

void require_same_bits(double a, double b) {
    REQUIRE(std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b));
}

}  // namespace

TEST_CASE("1/k along a span is that of the point its ray enters, and lies between its bounds") {
    CAPTURE(seed());
    int met = 0;
    for (int trial = 0; trial < trials(3000); ++trial) {
        CAPTURE(trial);
        Randomness random(trial);
        const SeenRow seen(random);
        const ExactSolid exact = exact_solid(seen.object, {});
        for (const RowSpan& span : seen.spans) {
            for (const std::size_t line : {0U, 1U}) {
                const double from = span.from[line], to = span.to[line];
                if (!(to - from > 1e-3)) continue;
                const DepthOnLine depth(span.surface, seen.row, seen.row.z[line]);
                const double column = from + (to - from) * random.between(0.02, 0.98);
                CAPTURE(line, column, from, to);
                const auto hit = enter(exact, Real3(seen.row.x(column), 1, seen.row.z[line]));
                if (!hit || hit->surface != span.surface.surface) continue;  // tests/outline holds ends to the ray
                const double u = depth.value(column);
                REQUIRE(std::abs(static_cast<double>(u * hit->depth) - 1.0) < 1e-6);
                REQUIRE(u >= depth.least(from, to) * (1.0 - 1e-12));
                REQUIRE(u <= depth.most(from, to) * (1.0 + 1e-12));
                ++met;
            }
        }
    }
    REQUIRE(met > trials(3000) / 4);
}

TEST_CASE("1/k on two scan lines at once is, bit for bit, that on each of them") {
    CAPTURE(seed());
    int compared = 0;
    for (int trial = 0; trial < trials(3000); ++trial) {
        CAPTURE(trial);
        Randomness random(trial);
        const SeenRow seen(random);
        for (const RowSpan& span : seen.spans) {
            const DepthOnTwoLines both(span.surface, seen.row, TwoLines{seen.row.z[0], seen.row.z[1]});
            const auto column = [&] { return random.between(span.outer_from, span.outer_to); };  // the limb's too
            const TwoLines from{column(), column()}, to{column(), column()};
            const auto at = both.at(from);
            const TwoLines value = both.value(from), least = both.least(from, to), most = both.most(from, to);
            for (const std::size_t line : {0U, 1U}) {
                const DepthOnLine one(span.surface, seen.row, seen.row.z[line]);
                require_same_bits(at.u[line], one.at(from[line]).u);
                require_same_bits(at.slope[line], one.at(from[line]).slope);
                require_same_bits(both.at(from[line], line).u, one.at(from[line]).u);
                require_same_bits(value[line], one.value(from[line]));
                require_same_bits(least[line], one.least(from[line], to[line]));
                require_same_bits(most[line], one.most(from[line], to[line]));
                ++compared;
            }
        }
    }
    REQUIRE(compared > trials(3000) / 4);
}
