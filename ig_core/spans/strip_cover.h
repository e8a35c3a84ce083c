/// What opaque surfaces hide of a strip of pixel rows, column by column: so that what lies behind them need not be
/// looked at.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "ig_core/spans/row_span.h"

namespace quadrig {

/// Columns [from, to) of a row, clipped to it.
struct Columns {
    int from = 0, to = 0;
};
/// Those that the image-plane stretch from x_from to x_to touches; either may be infinite.
Columns columns_touched(const PixelRow& row, double x_from, double x_to);

/// Bounds of 1/k from below over whole columns of some rows. Good when spans come roughly front to back. All rows are
/// asked at a time, since their bounds of one column stand side by side.
class StripCover {
  public:
    static constexpr std::size_t kRows = 8;
    static constexpr int kBlock = 16;         ///< columns
    using Rows = std::uint32_t;               ///< a bit each
    using Bounds = std::array<float, kRows>;  ///< of one column, or of a block of them

    /// Columns that show opaque surfaces alone, and a bound on how near these are everywhere; none if from >= to.
    struct Covered {
        std::array<std::int32_t, kRows> from{}, to{};
        std::array<float, kRows> far_u{};
        int first = std::numeric_limits<int>::max(), last = 0;  ///< of all rows
        /// Of one row, rounded to the safe side.
        void set(std::size_t row, int from_column, int to_column, double u);
    };

    void clear(int columns) { width_ = columns, empty_ = true; }
    void add(const Covered& covered);
    /// Rows on which something may be seen that lies within these columns and nowhere nearer than 1/`near_u`.
    [[nodiscard]] Rows open(const Columns& columns, double near_u) const;

  private:
    // Zero where anything may be seen. Of a column both bounds hold, so that wide spans are noted by the block.
    std::vector<Bounds> columns_, blocks_;
    std::vector<std::uint8_t> parted_;  // by block: whether its columns have bounds of their own, else they are not set
    int width_ = 0;
    bool empty_ = true;  // and then none are set
};

}  // namespace quadrig
