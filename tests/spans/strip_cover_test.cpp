#include "ig_core/spans/strip_cover.h"

#include <catch2/catch.hpp>
#include <vector>

#include "tests/ig_core/randomness.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

TEST_CASE("what a strip's cover hides on a row lies behind it in every column, and all that does is hidden") {
    CAPTURE(seed());
    const std::vector<std::int64_t> targets = simd_targets();
    long hidden = 0, wrong = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        Randomness random(trial);
        const SimdTarget on(targets[static_cast<std::size_t>(trial) % targets.size()]);
        const int width = 1 + random.below(200);
        PixelRow row;  // whose columns are as wide as the image plane's unit
        row.columns = width;
        StripCover cover;
        cover.clear(width);
        // 1/k of the farthest that is seen, by row and column
        std::array<std::vector<double>, StripCover::kRows> nearest;
        nearest.fill(std::vector<double>(static_cast<std::size_t>(width), 0.0));
        for (int i = 0; i < 30; ++i) {
            const double u = random.between(0.0, 1.0), asked_from = random.between(-20.0, width + 20.0),
                         asked_to = asked_from + random.between(0.0, 60.0);
            const StripCover::Rows open = cover.open(columns_touched(row, asked_from, asked_to), u);
            StripCover::Covered covered;
            for (std::size_t r = 0; r < StripCover::kRows; ++r) {
                bool behind = true;
                for (int column = 0; column < width; ++column)
                    if (column + 1 > asked_from && column < asked_to)
                        behind = behind && nearest[r][static_cast<std::size_t>(column)] > u;
                const bool is_hidden = (open >> r & 1U) == 0;
                wrong += is_hidden != behind;
                hidden += is_hidden && asked_to > 0.0 && asked_from < width;
                if (random.chance(0.3)) continue;
                const int from = random.below(width + 1), to = std::min(width, from + random.below(80));
                const double nearer = random.between(0.0, 1.0);
                covered.set(r, from, to, nearer);
                for (int column = from; column < to; ++column) {
                    double& known = nearest[r][static_cast<std::size_t>(column)];
                    known = std::max(known, nearer);
                }
            }
            cover.add(covered);
        }
        REQUIRE(cover.open({0, width}, 2.0) == (1U << StripCover::kRows) - 1);
    }
    CHECK(hidden > trials(300));
    CHECK(wrong == 0);
}

TEST_CASE("a strip's cover hides what touches none of its columns, and begins open") {
    StripCover cover;
    cover.clear(40);
    CHECK(cover.open({3, 3}, 1.0) == 0);
    CHECK(cover.open({3, 4}, 1e-9) == (1U << StripCover::kRows) - 1);
    StripCover::Covered covered;
    covered.set(2, 1, 40, 0.5);
    cover.add(covered);
    CHECK(cover.open({1, 40}, 0.25) == ((1U << StripCover::kRows) - 1 - (1U << 2)));
    CHECK(cover.open({0, 40}, 0.25) == (1U << StripCover::kRows) - 1);
    cover.clear(40);
    CHECK(cover.open({1, 40}, 0.25) == (1U << StripCover::kRows) - 1);
}
