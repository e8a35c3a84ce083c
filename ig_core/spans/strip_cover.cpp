#include "ig_core/spans/strip_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/spans/strip_cover.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One row a vector lane; where vectors are shorter, some rows after the others.
using D = hn::CappedTag<float, StripCover::kRows>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using Bounds = StripCover::Bounds;
constexpr int kBlock = StripCover::kBlock;

void Note(const StripCover::Covered& covered, int from, int to, Bounds* columns, Bounds* blocks, std::uint8_t* parted) {
    const D d;
    const DI di;
    for (std::size_t row = 0; row < StripCover::kRows; row += hn::Lanes(d)) {
        const auto rows_from = hn::LoadU(di, &covered.from[row]), rows_to = hn::LoadU(di, &covered.to[row]);
        const V u = hn::LoadU(d, &covered.far_u[row]);
        const auto all_of = [&](int first, int last) HWY_ATTR {
            return hn::And(hn::Lt(rows_from, hn::Set(di, first + 1)), hn::Gt(rows_to, hn::Set(di, last - 1)));
        };
        const auto any_of = [&](int first, int last) HWY_ATTR {
            return hn::And(hn::Lt(rows_from, hn::Set(di, last)), hn::Gt(rows_to, hn::Set(di, first)));
        };
        const auto note = [&](Bounds& bounds, hn::Mask<DI> rows) HWY_ATTR {
            const V noted = hn::IfThenElseZero(hn::RebindMask(d, rows), u);
            hn::StoreU(hn::Max(hn::LoadU(d, &bounds[row]), noted), d, &bounds[row]);
        };
        for (int column = from; column < to;) {
            const int block = column / kBlock, end = std::min(to, (block + 1) * kBlock);
            if (end - column == kBlock) {
                const auto whole = all_of(column, end);
                note(blocks[block], whole);
                if (hn::AllFalse(di, hn::AndNot(whole, any_of(column, end)))) column = end;
            }
            if (column < end && parted[block] == 0) {
                std::fill_n(columns + block * kBlock, kBlock, Bounds{});
                parted[block] = 1;
            }
            for (; column < end; ++column) note(columns[column], all_of(column, column + 1));
        }
    }
}

StripCover::Rows Open(const Bounds* columns, const Bounds* blocks, const std::uint8_t* parted, int from, int to,
                      float near_u) {
    const D d;
    const V u = hn::Set(d, near_u);
    StripCover::Rows open = 0;
    for (std::size_t row = 0; row < StripCover::kRows; row += hn::Lanes(d)) {
        auto hidden = hn::Gt(hn::Set(d, std::numeric_limits<float>::infinity()), hn::Zero(d));
        const auto look_at = [&](int first, int last, int block) HWY_ATTR {
            const V of_block = hn::LoadU(d, &blocks[block][row]);
            const auto by_block = hn::Gt(of_block, u);
            if (parted[block] == 0) hidden = hn::And(hidden, by_block);
            if (parted[block] == 0 || hn::AllTrue(d, by_block)) return;
            for (int column = first; column < last; ++column)
                hidden = hn::And(hidden, hn::Gt(hn::Max(hn::LoadU(d, &columns[column][row]), of_block), u));
        };
        const int middle = (from + to) / 2;  // what is seen is mostly seen there
        look_at(middle, middle + 1, middle / kBlock);
        for (int column = from; column < to && !hn::AllFalse(d, hidden);) {
            const int block = column / kBlock, end = std::min(to, (block + 1) * kBlock);
            look_at(column, end, block);
            column = end;
        }
        std::uint8_t bits = 0;
        hn::StoreMaskBits(d, hn::Not(hidden), &bits);
        open |= static_cast<StripCover::Rows>(bits & ((1U << hn::Lanes(d)) - 1)) << row;
    }
    return open;
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {
namespace {

HWY_EXPORT(Note);
HWY_EXPORT(Open);

/// Single precision on the safe side.
constexpr double kLess = 1.0 - 1e-6, kMore = 1.0 + 1e-6;
constexpr StripCover::Rows kAllRows = (1U << StripCover::kRows) - 1;

}  // namespace

Columns columns_touched(const PixelRow& row, double x_from, double x_to) {
    const auto column = [&](double x) { return std::clamp(row.column(x), 0.0, static_cast<double>(row.columns)); };
    return {static_cast<int>(column(x_from)), static_cast<int>(std::ceil(column(x_to)))};
}

void StripCover::Covered::set(std::size_t row, int from_column, int to_column, double u) {
    if (from_column >= to_column) return;
    from[row] = from_column, to[row] = to_column, far_u[row] = static_cast<float>(u * kLess);
    first = std::min(first, from_column), last = std::max(last, to_column);
}

void StripCover::add(const Covered& covered) {
    if (covered.first >= covered.last) return;
    if (empty_) {
        const std::size_t blocks = static_cast<std::size_t>(width_ / kBlock) + 1;
        if (columns_.size() < blocks * kBlock) columns_.resize(blocks * kBlock);
        blocks_.assign(blocks, Bounds{});
        parted_.assign(blocks, 0);
        empty_ = false;
    }
    HWY_DYNAMIC_DISPATCH(Note)(covered, covered.first, covered.last, columns_.data(), blocks_.data(), parted_.data());
}

StripCover::Rows StripCover::open(const Columns& columns, double near_u) const {
    if (columns.from >= columns.to) return 0;
    if (empty_) return kAllRows;
    return HWY_DYNAMIC_DISPATCH(Open)(columns_.data(), blocks_.data(), parted_.data(), columns.from, columns.to,
                                      static_cast<float>(near_u * kMore));
}

}  // namespace quadrig
#endif
