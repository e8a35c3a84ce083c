#include "ig_core/spans/sweep.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "ig_core/spans/row_spans.h"

namespace quadrig {
namespace {

/// From so many spans on, vectors sort them faster.
constexpr std::size_t kMany = 48;

constexpr std::uint32_t kNoSpan = std::numeric_limits<std::uint32_t>::max();

/// Whether `cover` covers all of `span` on every sub-scan line.
bool covers(const RowSpan& cover, const RowSpan& span, const PixelRow& row) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i)
        if (span.from[i] < span.to[i] && !(cover.from[i] <= span.from[i] && cover.to[i] >= span.to[i])) return false;
    return true;
}

}  // namespace

RowSweep::Active RowSweep::active(std::uint32_t index) const {
    const RowSpan& span = spans[index];
    DepthBounds depth{span.surface.near_u, span.surface.far_u, span.surface.outline};
    // Lights have rules of their own.
    if (span.surface.light != nullptr) depth = {std::numeric_limits<double>::infinity(), 0.0, nullptr};
    return {index, span.surface.opaque, span.inner_from, span.inner_to, span.outer_to, depth};
}

std::optional<Priority> RowSweep::order_of_whole(std::uint32_t index, std::uint32_t other) const {
    if (index < first_piece_) return std::nullopt;
    const Piece& piece = pieces_[index - first_piece_];
    const auto first = orders_.begin() + piece.first_order, last = orders_.begin() + piece.last_order;
    const auto found = std::find_if(first, last, [&](const Order& order) { return order.other == other; });
    if (found == last && piece.at_cut.other != other) return std::nullopt;
    return found == last ? piece.at_cut.priority : found->priority;
}

void RowSweep::cut(std::uint32_t first_order, std::uint32_t other, const PixelRow& row) {
    const auto last_order = static_cast<std::uint32_t>(orders_.size());
    for (std::size_t i = 0; i < crossing_pieces_.size(); ++i) {
        RowSpan& piece = crossing_pieces_[i];
        if (piece.splits == 0 || !fit_columns(row, piece)) continue;
        const Start start = start_of(piece.outer_from, static_cast<std::uint32_t>(spans.size()));
        spans.push_back(piece);
        pieces_.push_back({first_order, last_order, {other, i % 2 == 0 ? Priority::front : Priority::behind}});
        starts_.insert(std::upper_bound(starts_.begin(), starts_.end(), start, std::greater<>()), start);
    }
}

void RowSweep::insert(std::uint32_t index, const PixelRow& row) {
    const Active own = active(index);
    const auto covered_by = [&](const Active& other) {
        return other.outer_to >= own.outer_to && covers(spans[other.span], spans[index], row);
    };
    const auto meets = [&](const Active& other) { return overlap(spans[index], spans[other.span], row); };
    const auto first_order = static_cast<std::uint32_t>(orders_.size());
    std::size_t position = active_.size();
    for (std::size_t i = 0; i < active_.size(); ++i) {
        const Active& other = active_[i];
        auto priority = order_by_bounds(own.depth, other.depth);
        if (!priority) {
            priority = order_of_whole(index, other.span);
            if (!priority) priority = priority_of(spans[index], spans[other.span], row, depths_, crossing_pieces_);
            if (*priority == Priority::crossing) return cut(first_order, other.span, row);
            orders_.push_back({other.span, *priority});
        }
        if (*priority == Priority::behind) {
            if (position != active_.size()) {
                // It lies in front of one that stands farther forward: these two have no order, or not in all columns.
                if (!meets(other)) continue;
                const auto last = active_.begin() + static_cast<std::ptrdiff_t>(i);
                const auto front = std::find_if(active_.begin() + static_cast<std::ptrdiff_t>(position), last, meets);
                if (front != last &&
                    part_between(spans[index], spans[front->span], spans[other.span], row, crossing_pieces_))
                    return cut(first_order, kNoSpan, row);
            }
            position = active_.size();
            if (other.opaque && covered_by(other)) {
                orders_.resize(first_order);
                return;
            }
        } else {
            if (position == active_.size()) position = i;
            if (covered_by(other)) break;  // in front of it, so in front of all behind it
        }
    }
    orders_.resize(first_order);
    active_.insert(active_.begin() + static_cast<std::ptrdiff_t>(position), own);
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

void RowSweep::sweep(const PixelRow& row) {
    runs.clear();
    layers.clear();
    active_.clear();
    starts_.clear();
    orders_.clear();
    pieces_.clear();
    first_piece_ = static_cast<std::uint32_t>(spans.size());
    depths_.start(row);
    for (std::uint32_t i = 0; i < spans.size(); ++i) {
        spans[i].depths = -1;
        starts_.push_back(start_of(spans[i].outer_from, i));
    }
    if (starts_.size() < kMany)
        std::sort(starts_.begin(), starts_.end(), std::greater<>());
    else
        sort_many_(starts_.data(), starts_.size(), hwy::SortDescending());
    int column = 0;
    while (column < row.columns) {
        while (!starts_.empty() && column_of(starts_.back()) <= column) {
            const auto index = static_cast<std::uint32_t>(starts_.back());
            starts_.pop_back();
            insert(index, row);
        }
        int next = starts_.empty() ? row.columns : std::min(column_of(starts_.back()), row.columns);
        int first_end = row.columns;
        for (const Active& span : active_) {
            if (span.inner_from > column) next = std::min(next, span.inner_from);
            if (span.inner_to > column) next = std::min(next, span.inner_to);
            first_end = std::min(first_end, span.outer_to);
        }
        next = std::min(next, first_end);
        emit(column, next);
        column = next;
        if (first_end > column) continue;
        active_.erase(
            std::remove_if(active_.begin(), active_.end(), [&](const Active& span) { return span.outer_to <= column; }),
            active_.end());
    }
}

}  // namespace quadrig
