#include "ig_core/outline/convex_rows.h"

#include <catch2/catch.hpp>

#include "ig_core/view.h"
#include "tests/ig_core/random_objects.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

struct Tally {
    long rows = 0, told = 0;
};

/// On the middle rows of all z-bands.
void compare_rows(const Outline& outline, Tally& tally) {
    const ConvexRows rows(outline);
    RowOrder told, solved;
    for (const ZBand& band : outline.bands) {
        const double zeta = 0.5 * (band.zeta_from + band.zeta_to);
        ++tally.rows;
        if (!rows.tell(zeta, told)) continue;
        ++tally.told;
        solve_row(outline, zeta, solved);
        CAPTURE(zeta);
        REQUIRE(told.end() - told.begin() == solved.end() - solved.begin());
        for (auto a = told.begin(), b = solved.begin(); a != told.end(); ++a, ++b) {
            CHECK(a->surface == b->surface);
            CHECK(intercept(outline, a->boundary, zeta) == Approx(intercept(outline, b->boundary, zeta)).margin(1e-11));
        }
    }
}

}  // namespace

TEST_CASE("a row told from edges and curves is the row solved by itself, and hardly ever left untold") {
    CAPTURE(seed());
    Tally tally;
    for (int trial = 0; trial < trials(1500); ++trial) {
        Randomness random(trial);
        const double size = random.log_between(0.1, 100), distance = size * random.log_between(2.5, 1000);
        const Object object = random_object(random, Kind::ellipsoid, {0, distance, 0}, size, true, random.below(17));
        const ImagePlane image = ImagePlane::symmetric(400, 400, {random.log_between(1, 120)});
        Outline outline;
        make_outline(make_solid(object), 0, {}, glm::dmat3(1.0), {image.top, image.row_step, image.height}, outline);
        CAPTURE(trial);
        if (outline.solid.plane_count == static_cast<int>(object.planes.size())) compare_rows(outline, tally);
    }
    CHECK(tally.rows > 3000 * trials(100) / 100);
    CHECK(100 * tally.told > 99 * tally.rows);
}
