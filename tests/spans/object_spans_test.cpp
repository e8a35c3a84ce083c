#include "ig_core/spans/object_spans.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "ig_core/view.h"
#include "tests/ig_core/random_objects.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

constexpr int kImageColumns = 80, kImageRows = 60;

std::vector<PixelRow> rows_of(const ImagePlane& image, int sub_lines, bool point_samples) {
    std::vector<PixelRow> rows(kImageRows);
    for (int r = 0; r < kImageRows; ++r) {
        PixelRow& row = rows[static_cast<std::size_t>(r)];
        row.row = r, row.columns = kImageColumns, row.sub_lines = sub_lines, row.point_samples = point_samples;
        row.left = image.left, row.column_step = image.column_step, row.row_step = image.row_step;
        for (int i = 0; i < sub_lines; ++i) row.z[static_cast<std::size_t>(i)] = image.z(r + (i + 0.5) / sub_lines);
    }
    return rows;
}

/// What a sub-scan line shows, from left to right.
std::vector<Cut> cuts_of(const std::vector<RowSpan>& spans, std::size_t line) {
    std::vector<Cut> cuts;
    for (const RowSpan& span : spans)
        if (span.from[line] < span.to[line]) cuts.push_back({span.from[line], span.to[line], span.surface.surface});
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.from < b.from; });
    return cuts;
}

bool on_all_lines(const RowSpan& span, int sub_lines) {
    for (std::size_t line = 0; line < static_cast<std::size_t>(sub_lines); ++line)
        if (!(span.from[line] < span.to[line])) return false;
    return true;
}

void require_same(const RowSpan& a, const RowSpan& b) {
    REQUIRE(a.surface.surface == b.surface.surface);
    REQUIRE(a.surface.kind == b.surface.kind);
    REQUIRE(a.surface.opaque == b.surface.opaque);
    REQUIRE(a.surface.index == b.surface.index);
    REQUIRE(a.surface.outline == b.surface.outline);
    REQUIRE(a.surface.near_u == b.surface.near_u);
    REQUIRE(a.surface.far_u == b.surface.far_u);
    REQUIRE(a.outer_from == b.outer_from);
    REQUIRE(a.outer_to == b.outer_to);
    REQUIRE(a.inner_from == b.inner_from);
    REQUIRE(a.inner_to == b.inner_to);
}

/// Which span of a surface that shows twice a line's part of it belongs to is told better by a band: only spans on all
/// lines have to be the same.
void require_same(const std::vector<RowSpan>& a, const std::vector<RowSpan>& b, int sub_lines) {
    for (std::size_t line = 0; line < static_cast<std::size_t>(sub_lines); ++line) {
        const std::vector<Cut> of_a = cuts_of(a, line), of_b = cuts_of(b, line);
        REQUIRE(of_a.size() == of_b.size());
        for (std::size_t i = 0; i < of_a.size(); ++i) {
            REQUIRE(of_a[i].surface == of_b[i].surface);
            REQUIRE(of_a[i].from == of_b[i].from);
            REQUIRE(of_a[i].to == of_b[i].to);
        }
    }
    const auto whole = [&](const RowSpan& span) { return on_all_lines(span, sub_lines); };
    if (!std::all_of(a.begin(), a.end(), whole) || !std::all_of(b.begin(), b.end(), whole)) return;
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) require_same(a[i], b[i]);
}

}  // namespace

TEST_CASE("spans of an object are the same, bit for bit, row by row and with its rows solved together") {
    CAPTURE(seed());
    const std::vector<std::int64_t> targets = simd_targets();
    int spans_seen = 0, rows_with_faces = 0, rows_of_limbs = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        Randomness random(trial);
        CAPTURE(trial);
        const SimdTarget on(targets[static_cast<std::size_t>(trial) % targets.size()]);
        const double size = random.log_between(0.5, 200), distance = random.log_between(0.3, 60) * size;
        const ImagePlane image = ImagePlane::symmetric(kImageColumns, kImageRows, {random.log_between(5, 120)});
        const glm::dvec3 centre(distance * random.between(-0.5, 0.5), distance, distance * random.between(-0.4, 0.4));
        const Object object = random_object(random, random_kind(random), centre, size);
        const int sub_lines = 1 + random.below(kMaxSubScanLines);
        Outline outline;
        make_outline(make_solid(object), 0, {}, glm::dmat3(1.0),
                     {image.top, image.row_step / sub_lines, kImageRows * sub_lines}, outline);

        const std::vector<PixelRow> rows = rows_of(image, sub_lines, random.chance(0.2));
        ObjectSpans together;
        BandPlace band = kHighestBand;
        for (std::size_t first = 0; first < rows.size();) {
            const std::size_t count = std::min(rows.size() - first, static_cast<std::size_t>(1 + random.below(70)));
            const std::span strip = std::span(rows).subspan(first, count);
            together.set_rows(strip);
            together.start(outline, 7, true);
            const auto may_show = together.that_may_show();
            for (std::size_t r = 0; r < count; ++r) {
                CAPTURE(first + r);
                std::vector<RowSpan> one_by_one, at_once;
                add_object_spans(outline, 7, true, strip[r], band, one_by_one);
                // Rows may be left out: others hide it there.
                if (r < may_show.first || r >= may_show.last || random.chance(0.2)) {
                    if (r < may_show.first || r >= may_show.last) REQUIRE(one_by_one.empty());
                    continue;
                }
                together.add(r, at_once);
                require_same(at_once, one_by_one, sub_lines);
                spans_seen += static_cast<int>(at_once.size());
                rows_with_faces += at_once.size() > 1;
                rows_of_limbs += outline.limb_only && !at_once.empty();
            }
            first += count;
        }
    }
    CHECK(spans_seen > trials(300));
    CHECK(rows_with_faces > trials(300) / 10);
    CHECK(rows_of_limbs > trials(300) / 20);
}
