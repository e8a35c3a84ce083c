#include <catch2/catch.hpp>
#include <vector>

#include "ig_core/spans/row_spans.h"
#include "ig_core/spans/sweep.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

TEST_CASE("a row of up to a thousand spans shows in every column what is nearest there") {
    CAPTURE(seed());
    RowSweeper sweeper;
    RowSweep sweep;
    for (int trial = 0; trial < trials(60); ++trial) {
        CAPTURE(trial);
        Randomness random(trial);
        PixelRow row;
        row.sub_lines = 1 + random.below(2);
        row.columns = static_cast<int>(random.log_between(2, 16384));
        const int count = static_cast<int>(random.log_between(1, 1000));
        sweep.spans.clear();
        std::vector<std::size_t> nearest(static_cast<std::size_t>(row.columns), 0);
        const auto add = [&](int from, int to, double u) {
            RowSpan& span = sweep.spans.emplace_back();
            span.surface.kind = Surface::Kind::ground;
            span.surface.plane = {u, 0.0, 0.0};
            span.surface.near_u = span.surface.far_u = u;
            span.from.fill(from), span.to.fill(to);
            REQUIRE(fit_columns(row, span));
            for (auto column = static_cast<std::size_t>(from); column < static_cast<std::size_t>(to); ++column)
                if (sweep.spans[nearest[column]].surface.near_u < u) nearest[column] = sweep.spans.size() - 1;
        };
        add(0, row.columns, 0.001);
        for (int i = 0; i < count; ++i) {
            // Many begin where others do.
            const int from = random.chance(0.3) ? 0 : random.below(row.columns);
            const int to = from + 1 + static_cast<int>(random.log_between(1, 300));
            add(from, std::min(to, row.columns), random.between(0.01, 1.0));
        }
        sweeper.sweep(row, sweep);
        int column = 0, wrong = 0;
        for (const LayerRun& run : sweep.runs) {
            REQUIRE(run.from == column);
            REQUIRE(run.layer_count == 1);
            for (; column < run.to; ++column)
                wrong += sweep.layers[run.first_layer] != nearest[static_cast<std::size_t>(column)];
        }
        CHECK(column == row.columns);
        CHECK(wrong == 0);
    }
}
