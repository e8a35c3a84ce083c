#include "ig_core/outline/convex_rows.h"

#include <catch2/catch.hpp>

#include "ig_core/outline/boundary_lanes.h"
#include "ig_core/view.h"
#include "tests/ig_core/random_objects.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

struct Tally {
    long rows = 0, told = 0;
};

void compare(const Outline& outline, double zeta, const RowOrder& told) {
    RowOrder solved;
    solve_row(outline, zeta, solved);
    CAPTURE(zeta);
    REQUIRE(told.end() - told.begin() == solved.end() - solved.begin());
    for (auto a = told.begin(), b = solved.begin(); a != told.end(); ++a, ++b) {
        CHECK(a->surface == b->surface);
        CHECK(intercept(outline, a->boundary, zeta) == Approx(intercept(outline, b->boundary, zeta)).margin(1e-11));
    }
}

/// On the middle rows of all z-bands, some at a time.
void compare_rows(const Outline& outline, std::size_t together, Tally& tally) {
    const ConvexRows rows(outline);
    ConvexRows::Told told;
    std::vector<double> zeta;
    for (std::size_t i = 0; i < outline.bands.size(); ++i) {
        zeta.push_back(0.5 * (outline.bands[i].zeta_from + outline.bands[i].zeta_to));
        if (zeta.size() < together && i + 1 < outline.bands.size()) continue;
        rows.tell(zeta, told);
        for (std::size_t r = 0; r < zeta.size(); ++r) {
            ++tally.rows;
            if (!told.sure[r]) continue;
            ++tally.told;
            compare(outline, zeta[r], told.orders[r]);
        }
        zeta.clear();
    }
}

}  // namespace

TEST_CASE("rows told from edges and curves are the rows solved by themselves, and hardly ever left untold") {
    CAPTURE(seed());
    const std::vector<std::int64_t> targets = simd_targets();
    Tally tally;
    for (int trial = 0; trial < trials(1500); ++trial) {
        Randomness random(trial);
        const double size = random.log_between(0.1, 100), distance = size * random.log_between(2.5, 1000);
        const Object object = random_object(random, Kind::ellipsoid, {0, distance, 0}, size, true, random.below(17));
        const ImagePlane image = ImagePlane::symmetric(400, 400, {random.log_between(1, 120)});
        Outline outline;
        make_outline(make_solid(object), 0, {}, glm::dmat3(1.0), {image.top, image.row_step, image.height}, outline);
        const std::int64_t target = targets[static_cast<std::size_t>(trial) % targets.size()];
        const SimdTarget held(target);
        CAPTURE(trial, target);
        if (outline.solid.planes.size() == object.planes.size())
            compare_rows(outline, 1 + static_cast<std::size_t>(random.below(kRowsTogether)), tally);
    }
    CHECK(tally.rows > 3000 * trials(100) / 100);
    CHECK(100 * tally.told > 99 * tally.rows);
}
