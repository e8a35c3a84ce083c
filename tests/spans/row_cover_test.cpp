#include "ig_core/spans/row_cover.h"

#include <catch2/catch.hpp>
#include <vector>

#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

TEST_CASE("what a row's cover hides lies behind it in every column") {
    CAPTURE(seed());
    long hidden = 0, seen_for_nothing = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        Randomness random(trial);
        const int width = 1 + random.below(200);
        PixelRow row;  // whose columns are as wide as the image plane's unit
        row.columns = width;
        RowCover cover;
        cover.clear(width);
        std::vector<double> nearest(static_cast<std::size_t>(width), 0.0);  // 1/k of the farthest that is seen
        for (int i = 0; i < 30; ++i) {
            const int from = random.below(width + 1), to = std::min(width, from + random.below(80));
            const double u = random.between(0.0, 1.0);
            const double asked_from = random.between(-20.0, width + 20.0),
                         asked_to = asked_from + random.between(0.0, 60.0);
            bool exact = true;
            for (int column = 0; column < width; ++column)
                if (column + 1 > asked_from && column < asked_to)
                    exact = exact && nearest[static_cast<std::size_t>(column)] > u;
            const bool answer = cover.hides(columns_touched(row, asked_from, asked_to), u);
            if (answer) CHECK(exact);
            hidden += answer && asked_to > 0.0 && asked_from < width;
            seen_for_nothing += exact && !answer;
            cover.add(from, to, u);
            for (int column = from; column < to; ++column)
                nearest[static_cast<std::size_t>(column)] = std::max(nearest[static_cast<std::size_t>(column)], u);
        }
    }
    CHECK(hidden > trials(300));
    CHECK(seen_for_nothing == 0);
}
