/// What opaque surfaces hide of a pixel row, column by column: so that what lies behind them need not be looked at.
#pragma once

#include <vector>

#include "ig_core/spans/row_span.h"

namespace quadrig {

/// Columns [from, to) of a row, clipped to it.
struct Columns {
    int from = 0, to = 0;
};
/// Those that the image-plane stretch from x_from to x_to touches; either may be infinite.
Columns columns_touched(const PixelRow& row, double x_from, double x_to);

/// Bounds of 1/k from below over whole columns of one row. Good when spans come roughly front to back.
class RowCover {
  public:
    void clear(int columns) { width_ = columns, empty_ = true; }
    /// Columns [from, to) show opaque surfaces alone, none of them farther than 1/`far_u`.
    void add(int from, int to, double far_u);
    /// Whether nothing that lies within these columns and nowhere nearer than 1/`near_u` can be seen.
    [[nodiscard]] bool hides(const Columns& columns, double near_u) const;

  private:
    // Zero where anything may be seen. Of a column both bounds hold, so that wide spans are noted by the block.
    std::vector<float> columns_, blocks_;
    int width_ = 0;
    bool empty_ = true;  // and then the bounds are not yet set
};

}  // namespace quadrig
