#include "ig_core/shading/row_shader.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

constexpr int kLongestIdleRun = 12;
constexpr int kSpans = 12;

/// Lights of random colours and skies, all of them over all of a row, in runs of random layers.
struct Row {
    std::vector<LightPoint> lights{kSpans};
    SeenLight seen;
    FramePaints paints;
    FrameShading frame;
    PixelRow row;
    RowSweep sweep;
};

void add_runs(Randomness& random, Row& made) {
    made.row.z[0] = random.between(0, 1);
    for (std::uint32_t i = 0; i < kSpans; ++i) {
        RowSpan& span = made.sweep.spans.emplace_back();
        span.surface.kind = random.chance(0.7) ? Surface::Kind::light : Surface::Kind::sky;
        span.surface.index = i;
        span.surface.light = &made.seen;
        span.from[0] = 0, span.to[0] = made.row.columns;
    }
    for (int from = 0; from < made.row.columns;) {
        const int to = std::min(made.row.columns, from + 1 + random.below(random.chance(0.8) ? 6 : 60));
        const auto first = static_cast<std::uint32_t>(made.sweep.layers.size());
        std::vector<std::uint32_t>& layers = made.sweep.layers;
        for (std::uint32_t i = static_cast<std::uint32_t>(random.below(kSpans)); i < kSpans;
             i += 1 + static_cast<std::uint32_t>(random.below(kSpans)))
            layers.push_back(i);
        made.sweep.runs.push_back({from, to, first, static_cast<std::uint32_t>(layers.size()) - first, false});
        from = to;
    }
}

void make_row(Randomness& random, Row& made) {
    made.seen.u = 1;
    made.row.columns = 1 + random.below(700);
    made.row.left = random.between(-2, 0);
    made.row.column_step = random.between(0.5, 2) / made.row.columns;
    made.frame.paints = &made.paints;
    made.frame.lights = &made.lights;
    made.frame.light.horizon = {0.75F, 0.5F, 0.25F};
    made.frame.light.zenith = {0.0F, 0.125F, 1.0F};
    for (LightPoint& light : made.lights)
        light.colour = {random.between(0, 1), random.between(0, 1), random.between(0, 1)};
    add_runs(random, made);
}

/// Columns that a span is shaded on, and in how many stretches: asked column by column.
struct Shaded {
    std::uint64_t stretches = 0, samples = 0;
};
Shaded shaded(const RowSweep& sweep, std::uint32_t span) {
    Shaded sum;
    std::optional<int> last;
    for (const LayerRun& run : sweep.runs) {
        const auto first = sweep.layers.begin() + run.first_layer;
        if (std::find(first, first + run.layer_count, span) == first + run.layer_count) continue;
        for (int column = run.from; column < run.to; ++column) {
            const int hidden = last ? column - *last - 1 : kLongestIdleRun + 1;
            if (hidden > kLongestIdleRun)
                ++sum.stretches, ++sum.samples;
            else
                sum.samples += static_cast<std::uint64_t>(hidden) + 1;
            last = column;
        }
    }
    return sum;
}

/// Linear light of a span that is in front in a column.
glm::dvec3 colour(const Row& made, std::uint32_t span, int column) {
    if (made.sweep.spans[span].surface.kind == Surface::Kind::light) return made.lights[span].colour;
    const double x = made.row.left + (column + 0.5) * made.row.column_step, z = made.row.z[0];
    const double sine = z / std::sqrt(x * x + 1 + z * z);
    const auto mix = [&](std::size_t i) {
        return made.frame.light.horizon[i] + sine * (made.frame.light.zenith[i] - made.frame.light.horizon[i]);
    };
    return {mix(0), mix(1), mix(2)};
}

/// IEC 61966-2-1, 5.2.
double srgb8(double linear) {
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

}  // namespace

TEST_CASE("every column of a row shows the first layer of its run, by itself and among rows shaded together") {
    CAPTURE(seed());
    RowShader shader;  // one for all rows, long ones and short ones
    for (int trial = 0; trial < trials(300); ++trial) {
        CAPTURE(trial);
        Randomness random(trial);
        std::vector<Row> rows(1 + static_cast<std::size_t>(random.below(8)));
        make_row(random, rows[0]);
        for (std::size_t i = 1; i < rows.size(); ++i) {
            rows[i].lights = rows[0].lights, rows[i].seen = rows[0].seen, rows[i].row = rows[0].row;
            rows[i].frame.light = rows[0].frame.light;
            rows[i].row.row = static_cast<int>(i);
            add_runs(random, rows[i]);
        }
        const auto columns = static_cast<std::size_t>(rows[0].row.columns);
        double most_off = 0;
        std::vector<int> drawn;
        const auto compare = [&](const PixelRow& pixels) {
            const Row& made = rows[static_cast<std::size_t>(pixels.row)];
            drawn.push_back(pixels.row);
            std::vector<std::uint8_t> rgba(4 * columns);
            shader.write(pixels.columns, rgba.data());
            for (const LayerRun& run : made.sweep.runs)
                for (int column = run.from; column < run.to; ++column)
                    for (int i = 0; i < 3; ++i) {
                        const double expected = srgb8(colour(made, made.sweep.layers[run.first_layer], column)[i]);
                        const std::uint8_t shown = rgba[static_cast<std::size_t>(4 * column + i)];
                        most_off = std::max(most_off, std::abs(expected - shown));
                    }
        };
        std::vector<int> expected_rows;
        for (const Row& made : rows) {
            expected_rows.push_back(made.row.row);
            shader.add(made.row, made.sweep);
            if (shader.is_full()) shader.draw(rows[0].frame, compare);
        }
        shader.draw(rows[0].frame, compare);
        CHECK(drawn == expected_rows);
        CHECK(most_off < 0.6);
    }
}

TEST_CASE("a surface is shaded on through columns where it is hidden if they are no more than twelve") {
    CAPTURE(seed());
    RowShader shader;
    for (int trial = 0; trial < trials(300); ++trial) {
        CAPTURE(trial);
        Randomness random(trial);
        Row made;
        make_row(random, made);
        shader.add(made.row, made.sweep);
        shader.draw(made.frame, [](const PixelRow&) {});
        Shaded expected;
        for (std::uint32_t span = 0; span < kSpans; ++span) {
            const Shaded own = shaded(made.sweep, span);
            expected.stretches += own.stretches, expected.samples += own.samples;
        }
        const RowShader::Work work = shader.take_work();
        CHECK(work.stretches == expected.stretches);
        CHECK(work.samples == expected.samples);
    }
}
