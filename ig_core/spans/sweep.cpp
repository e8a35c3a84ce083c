#include "ig_core/spans/sweep.h"

#include <algorithm>
#include <limits>

#include "ig_core/spans/row_spans.h"

namespace quadrig {
namespace {

constexpr std::uint32_t kNoSpan = std::numeric_limits<std::uint32_t>::max();

/// Whether `cover` covers all of `span` on every sub-scan line.
bool covers(const RowSpan& cover, const RowSpan& span, const PixelRow& row) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i)
        if (span.from[i] < span.to[i] && !(cover.from[i] <= span.from[i] && cover.to[i] >= span.to[i])) return false;
    return true;
}

}  // namespace

RowSweeper::Extent RowSweeper::extent_of(const RowSpan& span) {
    DepthBounds depth = depth_bounds(span.surface);
    // Lights have rules of their own.
    if (span.surface.light != nullptr) depth = {std::numeric_limits<double>::infinity(), 0.0, nullptr};
    return {span.outer_from, {span.inner_from, span.inner_to, span.outer_to}, span.surface.opaque, depth};
}

std::optional<Priority> RowSweeper::order_of_whole(std::uint32_t index, std::uint32_t other) const {
    if (index < first_piece_) return std::nullopt;
    const Piece& piece = pieces_[index - first_piece_];
    const auto first = orders_.begin() + piece.first_order, last = orders_.begin() + piece.last_order;
    const auto found = std::find_if(first, last, [&](const Order& order) { return order.other == other; });
    if (found == last && piece.at_cut.other != other) return std::nullopt;
    return found == last ? piece.at_cut.priority : found->priority;
}

void RowSweeper::cut(std::uint32_t first_order, std::uint32_t other, const PixelRow& row) {
    const auto last_order = static_cast<std::uint32_t>(orders_.size());
    for (std::size_t i = 0; i < crossing_pieces_.size(); ++i) {
        RowSpan& piece = crossing_pieces_[i];
        if (piece.splits == 0 || !fit_columns(row, piece)) continue;
        starts_.add_last(piece.outer_from);
        out_->spans.push_back(piece);
        extents_.push_back(extent_of(piece));
        pieces_.push_back({first_order, last_order, {other, i % 2 == 0 ? Priority::front : Priority::behind}});
    }
}

void RowSweeper::insert(std::uint32_t index, const PixelRow& row) {
    std::vector<RowSpan>& spans = out_->spans;
    const Extent& own = extents_[index];
    const auto covered_by = [&](std::uint32_t other) {
        const Extent& cover = extents_[other];
        if (cover.inner_from() <= own.outer_from && own.outer_to() <= cover.inner_to()) return true;
        return cover.outer_to() >= own.outer_to() && covers(spans[other], spans[index], row);
    };
    const auto meets = [&](std::uint32_t other) { return overlap(spans[index], spans[other], row); };
    const auto first_order = static_cast<std::uint32_t>(orders_.size());
    std::size_t position = active_.size();
    for (std::size_t i = 0; i < active_.size(); ++i) {
        const std::uint32_t other = active_[i];
        auto priority = order_by_bounds(own.depth, extents_[other].depth);
        if (!priority) {
            priority = order_of_whole(index, other);
            if (!priority) {
                priority = priority_of(spans[index], spans[other], row, depths_, crossing_pieces_);
                ++out_->pairs;
            }
            if (*priority == Priority::crossing) return cut(first_order, other, row);
            orders_.push_back({other, *priority});
        }
        if (*priority == Priority::behind) {
            if (position != active_.size()) {
                // It lies in front of one that stands farther forward: these two have no order, or not in all columns.
                if (!meets(other)) continue;
                const auto last = active_.begin() + static_cast<std::ptrdiff_t>(i);
                const auto front = std::find_if(active_.begin() + static_cast<std::ptrdiff_t>(position), last, meets);
                if (front != last && part_between(spans[index], spans[*front], spans[other], row, crossing_pieces_))
                    return cut(first_order, kNoSpan, row);
            }
            position = active_.size();
            if (extents_[other].opaque && covered_by(other)) {
                orders_.resize(first_order);
                return;
            }
        } else {
            if (position == active_.size()) position = i;
            if (covered_by(other)) break;  // in front of it, so in front of all behind it
        }
    }
    orders_.resize(first_order);
    active_.push_back(index);  // and those behind it move on: there are few
    for (std::size_t i = active_.size() - 1; i > position; --i) active_[i] = active_[i - 1];
    active_[position] = index;
}

int RowSweeper::emit(int from, int to) {
    std::vector<LayerRun>& runs = out_->runs;
    std::vector<std::uint32_t>& layers = out_->layers;
    const Extent* const extents = extents_.data();
    std::uint32_t* const active = active_.data();
    const std::size_t count = active_.size();
    bool partial = false;
    int first_end = to, hidden_to = from;
    std::size_t shown = 0;
    while (shown < count) {
        const Extent& span = extents[active[shown++]];
        const std::size_t changed = span.changes_until(from);
        const bool whole = changed == 1;
        partial |= !whole;
        to = std::min(to, span.changes[changed]);
        first_end = std::min(first_end, span.outer_to());
        if (whole & span.opaque) {
            hidden_to = span.inner_to();
            break;
        }
    }
    const auto same_as = [&](const LayerRun& before) {
        return before.layer_count == shown && before.partial == partial &&
               std::equal(active, active + shown, layers.begin() + before.first_layer);
    };
    if (!runs.empty() && same_as(runs.back())) {
        runs.back().to = to;
    } else {
        const auto first = static_cast<std::uint32_t>(layers.size()), layer_count = static_cast<std::uint32_t>(shown);
        runs.push_back({from, to, first, layer_count, partial});
        for (std::size_t i = 0; i < shown; ++i) layers.push_back(active[i]);
    }
    // What ends before the opaque span in front of it does will not be seen again. Nothing could foresee what is kept:
    // no branch.
    std::size_t kept = first_end <= to ? 0 : shown;
    for (std::size_t i = kept; i < count; ++i) {
        const std::uint32_t index = active[kept] = active[i];
        kept += extents[index].outer_to() > (i < shown ? to : hidden_to) ? 1 : 0;
    }
    active_.resize(kept);
    return to;
}

void RowSweeper::sweep(const PixelRow& row, RowSweep& out) {
    out_ = &out;
    out.runs.clear();
    out.layers.clear();
    out.pairs = 0;
    active_.clear();
    orders_.clear();
    pieces_.clear();
    const std::vector<RowSpan>& spans = out.spans;
    first_piece_ = static_cast<std::uint32_t>(spans.size());
    depths_.start(row);
    starts_.clear(row.columns, spans.size());
    extents_.resize(spans.size());
    for (std::uint32_t i = first_piece_; i-- > 0;) {
        starts_.add_first(spans[i].outer_from, i);
        extents_[i] = extent_of(spans[i]);
    }
    for (int column = 0; column < row.columns;) {
        for (std::uint32_t i = starts_.first(column); i != SpanStarts::kNone; i = starts_.next(i)) insert(i, row);
        column = emit(column, starts_.next_column(column));
    }
}

}  // namespace quadrig
