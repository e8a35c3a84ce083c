#include <algorithm>
#include <catch2/catch.hpp>

#include "ig_core/spans/object_spans.h"
#include "ig_core/spans/row_spans.h"
#include "ig_core/spans/sweep.h"
#include "tests/ig_core/exact_solid.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

constexpr int kColumns = 160, kRows = 90;

/// Trees so close together that most pass through some others, seen from the origin: their outlines, and themselves for
/// rays. Some have no holes, some are cut by planes.
struct Wood {
    Wood(Randomness& random, int trees, int sub_lines) {
        const ImagePlane image = ImagePlane::symmetric(kColumns, kRows, {50});
        row.columns = kColumns, row.sub_lines = sub_lines;
        row.left = image.left, row.column_step = image.column_step, row.row_step = image.row_step;
        outlines.resize(static_cast<std::size_t>(trees));
        const double depth = random.between(5, 60);
        for (std::uint32_t i = 0; i < outlines.size(); ++i) {
            Object tree;
            const glm::dvec3 centre(random.between(-25, 25), 60 + random.between(-depth, depth) / 2,
                                    random.between(-12, 12));
            tree.shape = Ellipsoid{
                {centre}, {random.between(2, 7), random.between(2, 7), random.between(2, 9)}, random.attitude()};
            if (random.chance(0.2)) {
                const glm::dvec3 n = random.direction();
                tree.planes.push_back({{n.x, n.y, n.z, random.between(0.5, 3) - glm::dot(n, centre)}});
            }
            opaque.push_back(random.chance(0.15));
            solids.push_back(exact_solid(tree, {}));
            const RowGrid rows{image.top, image.row_step / sub_lines, kRows * sub_lines};
            make_outline(make_solid(tree), i, {}, glm::dmat3(1.0), rows, outlines[i]);
        }
        for (int r = 0; r < kRows; ++r) middles.push_back(image.z(r + 0.5));
    }

    void look_along(int r, RowSweeper& sweeper, RowSweep& sweep) {
        row.row = r;
        const double height = row.row_step / row.sub_lines;
        for (int line = 0; line < row.sub_lines; ++line)
            row.z[static_cast<std::size_t>(line)] =
                middles[static_cast<std::size_t>(r)] + (0.5 * (row.sub_lines - 1) - line) * height;
        sweep.spans.clear();
        for (std::uint32_t i = 0; i < outlines.size(); ++i) {
            BandPlace band = kHighestBand;
            add_object_spans(outlines[i], i, opaque[i], row, band, sweep.spans);
        }
        add_plane_spans({}, {}, row, sweep.spans);
        sweeper.sweep(row, sweep);
    }

    /// What a ray meets, front to back, as far as the first tree without holes.
    [[nodiscard]] std::vector<std::uint32_t> met(double column, double z) const {
        std::vector<std::pair<Real, std::uint32_t>> hits;
        for (std::uint32_t i = 0; i < solids.size(); ++i)
            if (const auto hit = enter(solids[i], Real3(row.x(column), 1, z))) hits.emplace_back(hit->depth, i);
        std::sort(hits.begin(), hits.end());
        std::vector<std::uint32_t> trees;
        for (const auto& [depth, tree] : hits) {
            trees.push_back(tree);
            if (opaque[tree]) break;
        }
        return trees;
    }

    PixelRow row;
    std::vector<Outline> outlines;
    std::vector<ExactSolid> solids;
    std::vector<bool> opaque;
    std::vector<double> middles;  // z of the rows
};

/// The same of a run's layers.
std::vector<std::uint32_t> layers_at(const RowSweep& sweep, const LayerRun& run, double column, std::size_t line) {
    std::vector<std::uint32_t> trees;
    for (std::uint32_t i = run.first_layer; i < run.first_layer + run.layer_count; ++i) {
        const RowSpan& span = sweep.spans[sweep.layers[i]];
        if (span.surface.outline == nullptr || !(span.from[line] <= column && column < span.to[line])) continue;
        trees.push_back(span.surface.index);
        if (span.surface.opaque) break;
    }
    return trees;
}

/// Whether a span has been cut so often that it is not cut any more: a limit, ig_core/README.md.
bool at_the_limit(const RowSweep& sweep, const LayerRun& run) {
    constexpr int kMostCuts = 8;
    for (std::uint32_t i = run.first_layer; i < run.first_layer + run.layer_count; ++i)
        if (sweep.spans[sweep.layers[i]].splits >= kMostCuts) return true;
    return false;
}

}  // namespace

TEST_CASE("in a wood whose trees pass through one another layers lie as a ray meets them") {
    CAPTURE(seed());
    constexpr double kNear = 0.2;  // columns: crossings and ends this close may be seen either way
    long asked = 0, wrong = 0, several = 0, cut = 0;
    for (int trial = 0; trial < trials(60, 20); ++trial) {
        Randomness random(trial);
        Wood wood(random, 5 + random.below(40), 1 + random.below(3));
        RowSweeper sweeper;
        RowSweep sweep;
        for (int r = random.below(4); r < kRows; r += 4) {
            wood.look_along(r, sweeper, sweep);
            for (const RowSpan& span : sweep.spans) cut += span.splits > 0;
            for (const LayerRun& run : sweep.runs) {
                const auto line = static_cast<std::size_t>(random.below(wood.row.sub_lines));
                const double column = random.between(run.from, run.to), z = wood.row.z[line];
                const auto exact = wood.met(column, z);
                if (at_the_limit(sweep, run) || wood.met(column - kNear, z) != exact ||
                    wood.met(column + kNear, z) != exact)
                    continue;
                ++asked;
                several += exact.size() > 1;
                const auto drawn = layers_at(sweep, run, column, line);
                if (drawn == exact) continue;
                ++wrong;
                UNSCOPED_INFO("trial " << trial << ", row " << r << ", column " << column << ", sub-scan line " << line
                                       << " of " << wood.row.sub_lines);
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(several > asked / 4);
    CHECK(cut > asked / 20);
    CHECK(asked > trials(60, 20) * 300);
}
