#include "ig_core/spans/row_cover.h"

#include <algorithm>
#include <cmath>

namespace quadrig {
namespace {

constexpr std::size_t kBlock = 16;  // columns
/// Single precision on the safe side.
constexpr double kLess = 1.0 - 1e-6, kMore = 1.0 + 1e-6;

}  // namespace

void RowCover::add(int from_column, int to_column, double far_u) {
    if (from_column >= to_column) return;
    if (empty_) {
        columns_.assign(static_cast<std::size_t>(width_), 0.0F);
        blocks_.assign(static_cast<std::size_t>(width_) / kBlock + 1, 0.0F);
        empty_ = false;
    }
    const auto u = static_cast<float>(far_u * kLess);
    const auto from = static_cast<std::size_t>(from_column), to = static_cast<std::size_t>(to_column);
    const std::size_t first_block = (from + kBlock - 1) / kBlock, last_block = to / kBlock;
    const auto note = [&](std::vector<float>& bounds, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) bounds[i] = std::max(bounds[i], u);
    };
    if (first_block >= last_block) return note(columns_, from, to);
    note(columns_, from, first_block * kBlock);
    note(blocks_, first_block, last_block);
    note(columns_, last_block * kBlock, to);
}

Columns columns_touched(const PixelRow& row, double x_from, double x_to) {
    const auto column = [&](double x) { return std::clamp(row.column(x), 0.0, static_cast<double>(row.columns)); };
    return {static_cast<int>(column(x_from)), static_cast<int>(std::ceil(column(x_to)))};
}

bool RowCover::hides(const Columns& columns, double near_u) const {
    const auto from = static_cast<std::size_t>(columns.from), to = static_cast<std::size_t>(columns.to);
    if (from < to && empty_) return false;
    const auto u = static_cast<float>(near_u * kMore);
    const std::size_t middle = (from + to) / 2;  // what is seen is mostly seen there
    if (from < to && !(blocks_[middle / kBlock] > u || columns_[middle] > u)) return false;
    for (std::size_t column = from; column < to;) {
        const std::size_t block = column / kBlock, end = std::min(to, (block + 1) * kBlock);
        if (blocks_[block] > u)
            column = end;
        else
            for (; column < end; ++column)
                if (!(columns_[column] > u)) return false;
    }
    return true;
}

}  // namespace quadrig
