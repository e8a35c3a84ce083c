#include "ig_core/spans/object_spans.h"

#include <algorithm>
#include <array>
#include <limits>

#include "ig_core/geometry/fetch.h"
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

/// Cuts of one object on a row, line by line, gathered by surface.
class CutsOfRow {
  public:
    CutsOfRow(const Outline& outline, std::uint32_t index, bool opaque, const PixelRow& row,
              std::vector<RowSpan>& spans)
        : outline_(outline), index_(index), opaque_(opaque), row_(row), spans_(spans), first_(spans.size()) {}

    void start(std::size_t line) { line_ = line, next_ = first_; }
    /// Cuts and spans both come from left to right. Columns.
    void add(double from, double to, int surface) {
        if (!(to > 0.0 && from < row_.columns)) return;
        std::size_t at = next_;
        while (at < spans_.size() &&
               !(spans_[at].surface.surface == surface && spans_[at].from[line_] == spans_[at].to[line_]))
            ++at;
        if (at == spans_.size())
            empty_span(row_, spans_).surface = surface_of(outline_, index_, opaque_, surface);
        else
            next_ = at + 1;
        spans_[at].from[line_] = from;
        spans_[at].to[line_] = to;
    }
    void finish() {
        std::size_t kept = first_;
        for (std::size_t i = first_; i < spans_.size(); ++i)
            if (fit_columns(row_, spans_[i])) {
                bound_depth(row_, spans_[i]);
                if (kept != i) spans_[kept] = spans_[i];
                ++kept;
            }
        spans_.resize(kept);
    }

  private:
    const Outline& outline_;
    std::uint32_t index_;
    bool opaque_;
    const PixelRow& row_;
    std::vector<RowSpan>& spans_;
    std::size_t first_, next_ = 0, line_ = 0;
};

}  // namespace

void add_object_spans(const Outline& outline, std::uint32_t index, bool opaque, const PixelRow& row, BandPlace& band,
                      std::vector<RowSpan>& spans) {
    const std::size_t lines = lines_of(row);
    const double z0 = outline.solid.z0;
    if (row.z[0] - z0 < outline.zeta_from || row.z[lines - 1] - z0 > outline.zeta_to) return;
    const double scale = 1.0 / row.column_step;
    CutsOfRow gathered(outline, index, opaque, row, spans);
    std::array<Cut, kMaxCuts> cuts;
    for (std::size_t line = 0; line < lines; ++line) {
        gathered.start(line);
        const auto count = static_cast<std::size_t>(cuts_on_row(outline, row.z[line], band, cuts.data()));
        for (const Cut& cut : std::span(cuts).first(count))
            gathered.add((cut.from - row.left) * scale, (cut.to - row.left) * scale, cut.surface);
    }
    gathered.finish();
}

void ObjectSpans::set_rows(std::span<const PixelRow> rows) {
    rows_ = rows, lines_ = lines_of(rows[0]);
    z_.clear();
    for (const PixelRow& row : rows) z_.insert(z_.end(), row.z.begin(), row.z.begin() + row.sub_lines);
}

void ObjectSpans::start(const Outline& outline, std::uint32_t index, bool opaque) {
    outline_ = &outline, index_ = index, opaque_ = opaque;
    shallow_ = is_shallow(outline.near_u, outline.far_u);
    band_ = kHighestBand;
    for (Run& run : runs_) run.first = run.last = 0;
    // What the first row will ask for, one after the other.
    fetch(std::span(outline.bands)), fetch(std::span(outline.changes));
    fetch(std::span(outline.curves)), fetch(std::span(outline.lines));
}

ObjectSpans::Rows ObjectSpans::that_may_show() const {
    const double z0 = outline_->solid.z0;
    Rows rows{0, rows_.size()};
    while (rows.first < rows.last && rows_[rows.first].z[lines_ - 1] - z0 > outline_->zeta_to) ++rows.first;
    while (rows.first < rows.last && rows_[rows.last - 1].z[0] - z0 < outline_->zeta_from) --rows.last;
    return rows;
}

void ObjectSpans::solve_limb(Run& run) const {
    const double left = rows_[0].left, scale = 1.0 / rows_[0].column_step;
    BoundaryLanes& lines = run.lines;
    lines.count = std::min(z_.size() - run.first, BoundaryLanes::kMaxLines);
    if (lines.columns.size() < kLimbAlone.size()) lines.columns.resize(kLimbAlone.size());
    auto &from = lines.columns[0], &to = lines.columns[1];
    limb_on_lines(*outline_, &z_[run.first], lines.count, from.data(), to.data());
    for (std::size_t i = 0; i < lines.count; ++i) {
        from[i] = (from[i] - left) * scale;
        to[i] = (to[i] - left) * scale;
    }
    lines.all_hold = true;
    run.changes = kLimbAlone;
}

void ObjectSpans::solve_from(std::size_t line) {
    newest_ ^= 1;
    Run& run = runs_[newest_];
    BoundaryLanes& lines = run.lines;
    run.first = line;
    if (outline_->limb_only) {
        solve_limb(run);
        run.last = line + lines.count;
        return;
    }
    const double z0 = outline_->solid.z0;
    const std::size_t end = std::min(z_.size(), line + BoundaryLanes::kMaxLines);
    double zeta = z_[line] - z0;
    const ZBand* band = band_on_row(*outline_, zeta, band_);
    // A line just where the next band begins belongs to that.
    const double next_at = band != nullptr ? band->zeta_from : zeta > outline_->zeta_to ? outline_->zeta_to : zeta;
    lines.count = 0;
    do {
        lines.zeta[lines.count++] = zeta;
        if (++line == end) break;
        zeta = z_[line] - z0;
    } while (zeta > next_at);
    run.last = line;
    run.changes = {};
    lines.all_hold = true;
    if (band == nullptr) return;
    boundaries_on_lines(*outline_, *band, {rows_[0].left, 1.0 / rows_[0].column_step}, lines);
    run.changes = std::span(outline_->changes).subspan(band->first, band->count);
}

void ObjectSpans::add_from(const Run& run, std::size_t row, std::vector<RowSpan>& spans) const {
    const std::size_t first = row * lines_ - run.first;
    for (std::size_t i = 0; i + 1 < run.changes.size(); ++i) {
        if (run.changes[i].surface == kNoSurface) continue;
        RowSpan& span = spans.emplace_back();
        if (fit_columns(rows_[row], &run.lines.columns[i][first], &run.lines.columns[i + 1][first], span)) {
            span.surface = surface_of(*outline_, index_, opaque_, run.changes[i].surface);
            if (!shallow_) bound_depth(rows_[row], span);
        } else {
            spans.pop_back();
        }
    }
}

bool ObjectSpans::add_from_both(std::size_t row, std::vector<RowSpan>& spans) const {
    const Run &last = runs_[newest_], &before = runs_[newest_ ^ 1];
    if (row * lines_ < before.first || before.last != last.first) return false;
    CutsOfRow gathered(*outline_, index_, opaque_, rows_[row], spans);
    for (std::size_t line = 0; line < lines_; ++line) {
        const Run& run = row * lines_ + line < last.first ? before : last;
        const std::size_t lane = row * lines_ + line - run.first;
        gathered.start(line);
        for (std::size_t i = 0; i + 1 < run.changes.size(); ++i)
            if (const double from = run.lines.columns[i][lane], to = run.lines.columns[i + 1][lane];
                run.changes[i].surface != kNoSurface && from < to)
                gathered.add(from, to, run.changes[i].surface);
    }
    gathered.finish();
    return true;
}

void ObjectSpans::add(std::size_t row, std::vector<RowSpan>& spans) {
    const auto add_alone = [&] { add_object_spans(*outline_, index_, opaque_, rows_[row], band_, spans); };
    if (outline_->direct) return add_alone();
    const std::size_t first = row * lines_, last = first + lines_;
    while (runs_[newest_].last < last) solve_from(std::max(first, runs_[newest_].last));
    const auto holds = [&](const Run& run) {
        if (run.lines.all_hold) return true;
        for (std::size_t line = std::max(first, run.first); line < std::min(last, run.last); ++line)
            if (run.lines.wrong[line - run.first] != 0.0) return false;
        return true;
    };
    const Run& run = runs_[newest_];
    if (!holds(run) || !holds(runs_[newest_ ^ 1])) return add_alone();
    if (first >= run.first) return add_from(run, row, spans);
    if (!add_from_both(row, spans)) add_alone();
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
