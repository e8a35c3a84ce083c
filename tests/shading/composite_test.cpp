#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/shading/compositing.h"
#include "tests/ig_core/randomness.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

struct Sample {
    float red, green, blue, opacity;
};

ShadeBuffer buffer_of(const std::vector<Sample>& samples) {
    ShadeBuffer buffer;
    buffer.resize(samples.size() + kShadePadding);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        buffer.red[i] = samples[i].red, buffer.green[i] = samples[i].green;
        buffer.blue[i] = samples[i].blue, buffer.opacity[i] = samples[i].opacity;
    }
    return buffer;
}

RowSpan span_of(std::vector<std::pair<double, double>> lines) {
    RowSpan span;
    span.from.fill(0), span.to.fill(0);
    for (std::size_t i = 0; i < lines.size(); ++i) span.from[i] = lines[i].first, span.to[i] = lines[i].second;
    return span;
}

/// Tells a span which columns it covers whole on so many sub-scan lines.
void set_inner(RowSpan& span, int lines) {
    const auto end = static_cast<std::ptrdiff_t>(lines);
    span.inner_from = static_cast<int>(std::ceil(*std::max_element(span.from.begin(), span.from.begin() + end)));
    span.inner_to = static_cast<int>(std::floor(*std::min_element(span.to.begin(), span.to.begin() + end)));
}

/// A layer whose sample of column `first` is the buffer's `sample`.
CompositeLayer layer_of(std::size_t sample, int first, std::uint32_t group, const RowSpan* span) {
    return {static_cast<std::uint32_t>(sample) - static_cast<std::uint32_t>(first), group, span};
}

std::vector<CompositeRun> run_of(int from, int to, const std::vector<CompositeLayer>& layers) {
    return {{from, to, layers}};
}

template <class Test>
void on_every_target(Test&& test) {
    for (const std::int64_t target : simd_targets()) {
        const SimdTarget held(target);
        CAPTURE(hwy::TargetName(target));
        test();
    }
}

}  // namespace

TEST_CASE("layers of whole pixels: each covers by its opacity what the ones in front let through") {
    on_every_target([] {
        // Three layers of two pixels: 0.25 + 0.75 (0.5 + 0.5 rest), and an opaque front.
        const ShadeBuffer buffer = buffer_of({{1, 0, 0, 0.25F},
                                              {0.9F, 0.8F, 0.7F, 1},  //
                                              {0, 1, 0, 0.5F},
                                              {0, 0, 0, 1},  //
                                              {0, 0, 1, 1},
                                              {1, 1, 1, 1}});
        ShadeBuffer row;
        row.resize(8 + kShadePadding);
        const std::vector<CompositeLayer> layers{layer_of(0, 3, 0, nullptr), layer_of(2, 3, 0, nullptr),
                                                 layer_of(4, 3, 0, nullptr)};
        composite_whole(buffer, run_of(3, 5, layers), row);
        CHECK(row.red[3] == Approx(0.25));
        CHECK(row.green[3] == Approx(0.375));
        CHECK(row.blue[3] == Approx(0.375));
        CHECK(row.red[4] == Approx(0.9));
        CHECK(row.green[4] == Approx(0.8));
        CHECK(row.blue[4] == Approx(0.7));
    });
}

TEST_CASE("a pixel covered in part shows what lies behind for the rest") {
    on_every_target([] {
        const ShadeBuffer buffer = buffer_of({{1, 0, 0, 1}, {0, 0, 1, 1}});
        ShadeBuffer row;
        row.resize(8 + kShadePadding);
        const RowSpan sky = span_of({{0, 8}, {0, 8}, {0, 8}, {0, 8}});
        const auto red_share = [&](const RowSpan& span, int lines) {
            const std::vector<CompositeLayer> layers{layer_of(0, 5, 0, &span), layer_of(1, 5, 99, &sky)};
            composite_partial(buffer, run_of(5, 6, layers), lines, row);
            CHECK(row.red[5] + row.blue[5] == Approx(1).epsilon(1e-6));
            return row.red[5];
        };
        CHECK(red_share(span_of({{5.5, 8}, {5.5, 8}, {5.5, 8}, {5.5, 8}}), 4) == Approx(0.5));
        CHECK(red_share(span_of({{2, 5.3}, {2, 5.3}, {2, 5.3}, {2, 5.3}}), 4) == Approx(0.3));
        CHECK(red_share(span_of({{5.1, 5.3}, {0, 0}, {5.9, 6.5}, {4, 8}}), 4) == Approx((0.2 + 0 + 0.1 + 1) / 4));
        CHECK(red_share(span_of({{5.25, 5.5}}), 1) == Approx(0.25));
        CHECK(red_share(span_of({{5, 6}, {7, 8}}), 2) == Approx(0.5));
        CHECK(red_share(span_of({{5.6, 8}, {5.4, 8}, {5.2, 8}, {5, 8}, {4.8, 8}, {4, 8}, {3, 8}, {2, 8}}), 8) ==
              Approx((0.4 + 0.6 + 0.8 + 5) / 8));
    });
}

TEST_CASE("surfaces of one object that meet within a pixel leave nothing of the background between them") {
    on_every_target([] {
        const ShadeBuffer buffer = buffer_of({{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}});
        ShadeBuffer row;
        row.resize(8 + kShadePadding);
        const RowSpan left = span_of({{0, 2.375}, {0, 2.5}}), right = span_of({{2.375, 8}, {2.5, 8}}),
                      sky = span_of({{0, 8}, {0, 8}});
        const std::vector<CompositeLayer> layers{layer_of(0, 2, 7, &left), layer_of(1, 2, 7, &right),
                                                 layer_of(2, 2, 99, &sky)};
        composite_partial(buffer, run_of(2, 3, layers), 2, row);
        CHECK(row.red[2] == Approx(0.4375));
        CHECK(row.green[2] == Approx(0.5625));
        CHECK(row.blue[2] == Approx(0).margin(1e-6));
    });
}

TEST_CASE("a translucent edge lets its own share through and no more") {
    on_every_target([] {
        const ShadeBuffer buffer = buffer_of({{1, 0, 0, 0.5F}, {0, 1, 0, 0.5F}, {0, 0, 1, 1}});
        ShadeBuffer row;
        row.resize(8 + kShadePadding);
        const RowSpan front = span_of({{3.5, 8}, {3.5, 8}}), all = span_of({{0, 8}, {0, 8}});
        const std::vector<CompositeLayer> layers{layer_of(0, 3, 1, &front), layer_of(1, 3, 2, &all),
                                                 layer_of(2, 3, 99, &all)};
        composite_partial(buffer, run_of(3, 4, layers), 2, row);
        CHECK(row.red[3] == Approx(0.25));
        CHECK(row.green[3] == Approx(0.5 * 0.5 + 0.5 * 0.25));
        CHECK(row.blue[3] == Approx(0.5 * 0.5 + 0.5 * 0.25));
    });
}

namespace {

/// Red that a column shows of layers whose samples all stand at that column: cell by cell, in double.
double red_by_cells(const ShadeBuffer& buffer, const std::vector<CompositeLayer>& layers, int column, int lines) {
    double red = 0;
    for (int cell = 0; cell < lines * kCellsPerLine; ++cell) {
        const auto line = static_cast<std::size_t>(cell / kCellsPerLine);
        const double left = column + (cell % kCellsPerLine) / double{kCellsPerLine}, right = left + 1.0 / kCellsPerLine;
        double through = 1, at_group = 1;
        for (std::size_t i = 0; i < layers.size(); ++i) {
            if (i > 0 && layers[i].group != layers[i - 1].group) at_group = through;
            const double from = std::max(layers[i].span->from[line], left),
                         to = std::min(layers[i].span->to[line], right);
            const std::size_t sample = layers[i].sample(static_cast<std::size_t>(column));
            const double weight = std::max(0.0, to - from) * kCellsPerLine * at_group * double{buffer.opacity[sample]};
            through = std::max(0.0, through - weight);
            red += weight * double{buffer.red[sample]};
        }
    }
    return red / (lines * kCellsPerLine);
}

}  // namespace

TEST_CASE("every pixel of a run is the sum of its cells, for any number of sub-scan lines and layers") {
    CAPTURE(seed());
    on_every_target([] {
        for (int trial = 0; trial < trials(300); ++trial) {
            CAPTURE(trial);
            Randomness random(trial);
            const int first = random.below(4), columns = 1 + random.below(4),
                      lines = 1 + random.below(kMaxSubScanLines);
            const int count = 1 + random.below(6);
            std::vector<Sample> samples;
            std::vector<RowSpan> spans;
            std::vector<std::uint32_t> groups;
            for (int i = 0; i < count; ++i) {
                for (int c = 0; c < columns; ++c)
                    samples.push_back({static_cast<float>(random.between(0, 1)), 0, 0,
                                       random.chance(0.5) ? 1.0F : static_cast<float>(random.between(0, 1))});
                // Lines beyond the row's hold whatever was there before.
                std::vector<std::pair<double, double>> ends(kMaxSubScanLines, {std::nan(""), std::nan("")});
                const bool beside_last = i > 0 && random.chance(0.3), everywhere = !beside_last && random.chance(0.3);
                for (std::size_t line = 0; line < static_cast<std::size_t>(lines); ++line) {
                    const double from = beside_last ? spans.back().to[line] : random.between(-1, 8);
                    ends[line] = {from, from + random.between(0, 6)};
                    if (everywhere) ends[line] = {0, 8};
                }
                spans.push_back(span_of(ends));
                set_inner(spans.back(), lines);
                groups.push_back(beside_last ? groups.back() : static_cast<std::uint32_t>(i));
            }
            std::vector<CompositeLayer> layers;
            for (std::size_t i = 0; i < spans.size(); ++i)
                layers.push_back(layer_of(i * static_cast<std::size_t>(columns), first, groups[i], &spans[i]));
            const ShadeBuffer buffer = buffer_of(samples);
            ShadeBuffer row;
            row.resize(8 + kShadePadding);
            composite_partial(buffer, run_of(first, first + columns, layers), lines, row);
            constexpr double kDark = 1.0 / 4096;  // what is left when the layers behind are given up
            for (int column = first; column < first + columns; ++column)
                CHECK(row.red[static_cast<std::size_t>(column)] ==
                      Approx(red_by_cells(buffer, layers, column, lines)).margin(kDark));
        }
    });
}

TEST_CASE("layers side by side before an opaque whole one are the sum of their cells too") {
    CAPTURE(seed());
    on_every_target([] {
        for (int trial = 0; trial < trials(300); ++trial) {
            CAPTURE(trial);
            Randomness random(trial);
            const int first = random.below(4), columns = 1 + random.below(4),
                      lines = 1 + random.below(kMaxSubScanLines), in_front = random.below(5);
            std::vector<Sample> samples;
            std::vector<RowSpan> spans;
            // Lines beyond the row's hold whatever was there before.
            std::vector<std::pair<double, double>> ends(kMaxSubScanLines, {std::nan(""), std::nan("")});
            std::fill_n(ends.begin(), lines, std::pair(-2.0, random.between(-1, 8)));
            for (int i = 0; i <= in_front; ++i) {
                for (int c = 0; c < columns; ++c)
                    samples.push_back(
                        {static_cast<float>(random.between(0, 1)), 0, 0,
                         i == in_front || random.chance(0.5) ? 1.0F : static_cast<float>(random.between(0, 1))});
                for (std::size_t line = 0; line < static_cast<std::size_t>(lines); ++line) {
                    const double from = ends[line].second + (random.chance(0.3) ? random.between(0, 1) : 0.0);
                    ends[line] = {from, from + (random.chance(0.2) ? 0.0 : random.between(0, 3))};
                    if (i == in_front) ends[line] = {0, 8};
                }
                spans.push_back(span_of(ends));
            }
            std::vector<CompositeLayer> layers;
            for (std::size_t i = 0; i < spans.size(); ++i)
                layers.push_back(
                    layer_of(i * static_cast<std::size_t>(columns), first, i + 1 == spans.size() ? 1U : 0U, &spans[i]));
            const ShadeBuffer buffer = buffer_of(samples);
            ShadeBuffer row;
            row.resize(8 + kShadePadding);
            composite_before_whole(buffer, run_of(first, first + columns, layers), lines, row);
            for (int column = first; column < first + columns; ++column)
                CHECK(row.red[static_cast<std::size_t>(column)] ==
                      Approx(red_by_cells(buffer, layers, column, lines)).margin(1e-6));
        }
    });
}

TEST_CASE("a run of edge pixels leaves the columns beside it as they are") {
    on_every_target([] {
        const ShadeBuffer buffer = buffer_of({{1, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 1, 1}, {0, 0, 1, 1}});
        const RowSpan front = span_of({{2.5, 8}, {2.5, 8}}), sky = span_of({{0, 8}, {0, 8}});
        for (const int columns : {1, 2}) {
            const std::vector<CompositeLayer> layers{layer_of(0, 2, 0, &front), layer_of(2, 2, 1, &sky)};
            const std::vector<CompositeRun> runs = run_of(2, 2 + columns, layers);
            for (const bool before_whole : {false, true}) {
                ShadeBuffer row;
                row.resize(8 + kShadePadding);
                std::fill(row.green.begin(), row.green.end(), 0.75F);
                before_whole ? composite_before_whole(buffer, runs, 2, row) : composite_partial(buffer, runs, 2, row);
                for (std::size_t column = 0; column < 8; ++column) {
                    const bool drawn = column >= 2 && column < 2 + static_cast<std::size_t>(columns);
                    CHECK(row.green[column] == (drawn ? 0.0F : 0.75F));
                }
            }
        }
    });
}

TEST_CASE("whole runs packed straight from their samples show what they do composited first") {
    CAPTURE(seed());
    on_every_target([] {
        for (int trial = 0; trial < trials(100); ++trial) {
            CAPTURE(trial);
            Randomness random(trial);
            const auto light = [&] { return static_cast<float>(random.between(0, 1)); };
            const auto columns = static_cast<std::size_t>(1 + random.below(200));
            std::vector<Sample> samples(4 * columns);
            // The first of them are the last layer's, which is opaque.
            for (std::size_t i = 0; i < samples.size(); ++i)
                samples[i] = {light(), light(), light(), i < columns || random.chance(0.5) ? 1.0F : light()};
            const ShadeBuffer buffer = buffer_of(samples);
            ShadeBuffer row, composited;
            row.resize(columns + kShadePadding), composited.resize(columns + kShadePadding);
            for (std::size_t i = 0; i < columns; ++i)
                row.red[i] = light(), row.green[i] = light(), row.blue[i] = light();
            ShadeBuffer expected = row;
            std::vector<std::vector<CompositeLayer>> layers;
            std::vector<CompositeRun> runs;
            layers.reserve(columns);
            for (std::size_t from = static_cast<std::size_t>(random.below(3)); from < columns;) {
                const std::size_t to = std::min(columns, from + 1 + static_cast<std::size_t>(random.below(60)));
                std::vector<CompositeLayer>& own = layers.emplace_back();
                for (int i = random.below(4); i >= 0; --i)
                    own.push_back(layer_of(static_cast<std::size_t>(i) * columns, 0, 0, nullptr));
                runs.push_back({static_cast<int>(from), static_cast<int>(to), own});
                composite_whole(buffer, std::span(runs).last(1), composited);
                for (std::size_t i = from; i < to; ++i)
                    expected.red[i] = composited.red[i], expected.green[i] = composited.green[i],
                    expected.blue[i] = composited.blue[i];
                from = to + static_cast<std::size_t>(random.chance(0.5) ? 0 : random.below(30));
            }
            std::vector<std::uint8_t> straight(4 * columns + 8, 77), in_two_steps = straight;
            pack_srgb8(buffer, runs, row, static_cast<int>(columns), straight.data());
            pack_srgb8(expected, static_cast<int>(columns), in_two_steps.data());
            CHECK(straight == in_two_steps);
        }
    });
}
