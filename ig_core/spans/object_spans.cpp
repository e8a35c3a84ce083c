#include "ig_core/spans/object_spans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ig_core/spans/row_spans.h"

namespace quadrig {
namespace {

/// What bounds an outline that is nothing but its limb.
constexpr std::array<Change, 2> kLimbAlone{
    {{{Boundary::Kind::rising, 0}, 0}, {{Boundary::Kind::falling, 0}, kNoSurface}}};

Surface surface_of(const Outline& outline, std::uint32_t index, bool opaque, int surface) {
    Surface out;
    out.kind = surface == 0 ? Surface::Kind::quadric : Surface::Kind::face;
    out.opaque = opaque;
    out.surface = surface;
    out.index = index;
    out.priority = outline.object;
    out.outline = &outline;
    out.near_u = outline.near_u, out.far_u = outline.far_u;
    return out;
}

std::size_t lines_of(const PixelRow& row) { return static_cast<std::size_t>(row.sub_lines); }

}  // namespace

void add_object_spans(const Outline& outline, std::uint32_t index, bool opaque, const PixelRow& row, BandPlace& band,
                      std::vector<RowSpan>& spans) {
    const auto lines = static_cast<std::size_t>(row.sub_lines);
    const double z0 = outline.solid.z0;
    if (row.z[0] - z0 < outline.zeta_from || row.z[lines - 1] - z0 > outline.zeta_to) return;
    const double scale = 1.0 / row.column_step;
    const std::size_t first = spans.size();
    std::array<Cut, kMaxCuts> cuts;
    for (std::size_t line = 0; line < lines; ++line) {
        const int count = cuts_on_row(outline, row.z[line], band, cuts.data());
        std::size_t next = first;  // cuts and spans both run from left to right
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            const double from = (cuts[i].from - row.left) * scale, to = (cuts[i].to - row.left) * scale;
            if (!(to > 0.0 && from < row.columns)) continue;
            std::size_t at = next;
            while (at < spans.size() &&
                   !(spans[at].surface.surface == cuts[i].surface && spans[at].from[line] == spans[at].to[line]))
                ++at;
            if (at == spans.size()) {
                empty_span(row, spans).surface = surface_of(outline, index, opaque, cuts[i].surface);
            } else {
                next = at + 1;
            }
            spans[at].from[line] = from;
            spans[at].to[line] = to;
        }
    }
    std::size_t kept = first;
    for (std::size_t i = first; i < spans.size(); ++i)
        if (fit_columns(row, spans[i])) {
            bound_depth(row, spans[i]);
            if (kept != i) spans[kept] = spans[i];
            ++kept;
        }
    spans.resize(kept);
}

void ObjectSpans::start(const Outline& outline, std::uint32_t index, bool opaque, std::span<const PixelRow> rows) {
    outline_ = &outline, index_ = index, opaque_ = opaque, rows_ = rows;
    band_ = kHighestBand;
    solved_ = {0, 0};
}

ObjectSpans::Rows ObjectSpans::that_may_show() const {
    const double z0 = outline_->solid.z0;
    Rows rows{0, rows_.size()};
    while (rows.first < rows.last && rows_[rows.first].z[lines_of(rows_[0]) - 1] - z0 > outline_->zeta_to) ++rows.first;
    while (rows.first < rows.last && rows_[rows.last - 1].z[0] - z0 < outline_->zeta_from) --rows.last;
    return rows;
}

void ObjectSpans::solve_limb_from(std::size_t row) {
    const std::size_t lines = lines_of(rows_[row]);
    const double left = rows_[row].left, scale = 1.0 / rows_[row].column_step;
    solved_ = {row, std::min(rows_.size(), row + BoundaryLanes::kMaxLines / lines)};
    lines_.count = (solved_.last - row) * lines;
    for (std::size_t i = 0; i < lines_.count; ++i) lines_.zeta[i] = rows_[row + i / lines].z[i % lines];
    if (lines_.columns.size() < kLimbAlone.size()) lines_.columns.resize(kLimbAlone.size());
    auto &from = lines_.columns[0], &to = lines_.columns[1];
    limb_on_lines(*outline_, lines_.zeta.data(), lines_.count, from.data(), to.data());
    for (std::size_t i = 0; i < lines_.count; ++i) {
        from[i] = (from[i] - left) * scale;
        to[i] = (to[i] - left) * scale;
        lines_.wrong[i] = 0.0;
    }
    changes_ = kLimbAlone;
}

void ObjectSpans::solve_from(std::size_t row) {
    if (outline_->limb_only) return solve_limb_from(row);
    const std::size_t lines = lines_of(rows_[row]);
    const double z0 = outline_->solid.z0;
    solved_ = {row, row};
    lines_.count = 0;
    const ZBand* band = band_on_row(*outline_, rows_[row].z[0] - z0, band_);
    if (band == nullptr) return;
    // A line just where the next band begins belongs to that.
    while (solved_.last < rows_.size() && rows_[solved_.last].z[lines - 1] - z0 > band->zeta_from &&
           lines_.count + lines <= BoundaryLanes::kMaxLines) {
        for (std::size_t i = 0; i < lines; ++i) lines_.zeta[lines_.count++] = rows_[solved_.last].z[i] - z0;
        ++solved_.last;
    }
    if (solved_.last == row) return;
    boundaries_on_lines(*outline_, *band, {rows_[row].left, 1.0 / rows_[row].column_step}, lines_);
    changes_ = std::span(outline_->changes).subspan(band->first, band->count);
}

bool ObjectSpans::is_solved(std::size_t row) const {
    if (row < solved_.first || row >= solved_.last) return false;
    const std::size_t lines = lines_of(rows_[row]);
    const auto wrong = lines_.wrong.begin() + static_cast<std::ptrdiff_t>((row - solved_.first) * lines);
    return std::all_of(wrong, wrong + static_cast<std::ptrdiff_t>(lines), [](double w) { return w == 0.0; });
}

void ObjectSpans::add(std::size_t r, std::vector<RowSpan>& spans) {
    const PixelRow& row = rows_[r];
    if (r >= solved_.last) solve_from(r);
    if (!is_solved(r)) return add_object_spans(*outline_, index_, opaque_, row, band_, spans);
    const std::size_t lines = lines_of(row), first = (r - solved_.first) * lines;
    for (std::size_t i = 0; i + 1 < changes_.size(); ++i) {
        if (changes_[i].surface == kNoSurface) continue;
        RowSpan& span = spans.emplace_back();
        std::copy_n(&lines_.columns[i][first], lines, span.from.begin());
        std::copy_n(&lines_.columns[i + 1][first], lines, span.to.begin());
        if (fit_columns(row, span)) {
            span.surface = surface_of(*outline_, index_, opaque_, changes_[i].surface);
            bound_depth(row, span);
        } else {
            spans.pop_back();
        }
    }
}

CoveredColumns columns_covered(std::span<const RowSpan> spans) {
    CoveredColumns covered{std::numeric_limits<int>::max(), 0, 1.0 / kNearDepth};
    for (const RowSpan& span : spans) {
        covered.far_u = std::min(covered.far_u, span.surface.far_u);
        if (span.inner_from >= span.inner_to) continue;
        covered.from = std::min(covered.from, span.inner_from);
        covered.to = std::max(covered.to, span.inner_to);
    }
    return covered;
}

}  // namespace quadrig
