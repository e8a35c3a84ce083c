#include "ig_core/spans/sweep.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "ig_core/spans/row_spans.h"

namespace quadrig {
namespace {

/// Whether `cover` covers all of `span` on every sub-scan line.
bool covers(const RowSpan& cover, const RowSpan& span, const PixelRow& row) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i)
        if (span.from[i] < span.to[i] && !(cover.from[i] <= span.from[i] && cover.to[i] >= span.to[i])) return false;
    return true;
}

}  // namespace

void RowSweep::insert(std::uint32_t index, const PixelRow& row) {
    std::size_t position = active_.size();
    for (std::size_t i = 0; i < active_.size(); ++i) {
        const RowSpan &span = spans[index], &other = spans[active_[i].span];
        const Priority priority = priority_of(span, other, row, pieces_);
        if (priority == Priority::crossing) {
            for (RowSpan& piece : pieces_) {
                if (piece.splits == 0 || !fit_columns(row, piece)) continue;
                const Start start(piece.outer_from, static_cast<std::uint32_t>(spans.size()));
                spans.push_back(piece);
                starts_.insert(std::upper_bound(starts_.begin(), starts_.end(), start, std::greater<>()), start);
            }
            return;
        }
        if (priority == Priority::behind) {
            if (other.surface.opaque && covers(other, span, row)) return;
            position = active_.size();
        } else {
            if (position == active_.size()) position = i;
            if (covers(other, span, row)) break;  // in front of it, so in front of all behind it
        }
    }
    const RowSpan& span = spans[index];
    active_.insert(active_.begin() + static_cast<std::ptrdiff_t>(position),
                   {index, span.surface.opaque, span.inner_from, span.inner_to, span.outer_to});
}

void RowSweep::emit(int from, int to) {
    const auto first = static_cast<std::uint32_t>(layers.size());
    bool partial = false;
    std::size_t i = 0;
    for (; i < active_.size(); ++i) {
        const bool whole = active_[i].covers(from);
        layers.push_back(active_[i].span);
        partial = partial || !whole;
        if (whole && active_[i].opaque) break;
    }
    if (i < active_.size()) {
        // What ends before the opaque span in front of it does will not be seen again.
        const int hidden_to = active_[i].inner_to;
        active_.erase(std::remove_if(active_.begin() + static_cast<std::ptrdiff_t>(i) + 1, active_.end(),
                                     [&](const Active& other) { return other.outer_to <= hidden_to; }),
                      active_.end());
    }
    const auto count = static_cast<std::uint32_t>(layers.size()) - first;
    if (!runs.empty()) {
        LayerRun& last = runs.back();
        if (last.to == from && last.layer_count == count && last.partial == partial &&
            std::equal(layers.begin() + last.first_layer, layers.begin() + last.first_layer + count,
                       layers.begin() + first)) {
            last.to = to;
            layers.resize(first);
            return;
        }
    }
    runs.push_back({from, to, first, count, partial});
}

/// By counting, where there are many: comparisons, half of which turn out otherwise than foreseen, take five times as
/// long.
void RowSweep::sort_starts() {
    constexpr std::size_t kFew = 32;
    if (starts_.size() < kFew) return std::sort(starts_.begin(), starts_.end(), std::greater<>());
    constexpr int kBits = 7;  // of the fourteen that a column has
    constexpr std::size_t kBins = 1 << kBits;
    const auto low = [](Start start) { return static_cast<std::size_t>(start.column()) % kBins; };
    const auto high = [](Start start) { return static_cast<std::size_t>(start.column()) / kBins % kBins; };
    std::array<std::uint32_t, kBins> low_at{}, high_at{};  // how many a bin has, then where its next one goes
    for (const Start start : starts_) ++low_at[low(start)], ++high_at[high(start)];
    std::uint32_t lows = 0, highs = 0;
    for (std::size_t bin = kBins; bin-- > 0;) {
        lows += std::exchange(low_at[bin], lows);
        highs += std::exchange(high_at[bin], highs);
    }
    sorted_by_low_.resize(starts_.size(), Start(0, 0));
    for (auto start = starts_.rbegin(); start != starts_.rend(); ++start)
        sorted_by_low_[low_at[low(*start)]++] = *start;
    for (const Start start : sorted_by_low_) starts_[high_at[high(start)]++] = start;
}

void RowSweep::sweep(const PixelRow& row) {
    runs.clear();
    layers.clear();
    active_.clear();
    starts_.clear();
    for (std::uint32_t i = 0; i < spans.size(); ++i) starts_.emplace_back(spans[i].outer_from, i);
    sort_starts();
    int column = 0;
    while (column < row.columns) {
        while (!starts_.empty() && starts_.back().column() <= column) {
            const std::uint32_t index = starts_.back().span();
            starts_.pop_back();
            insert(index, row);
        }
        int next = starts_.empty() ? row.columns : std::min(starts_.back().column(), row.columns);
        for (const Active& span : active_) {
            if (span.inner_from > column) next = std::min(next, span.inner_from);
            if (span.inner_to > column) next = std::min(next, span.inner_to);
            next = std::min(next, span.outer_to);
        }
        emit(column, next);
        column = next;
        active_.erase(
            std::remove_if(active_.begin(), active_.end(), [&](const Active& span) { return span.outer_to <= column; }),
            active_.end());
    }
}

}  // namespace quadrig
