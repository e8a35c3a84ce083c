/// Spans of one object: its cuts on the sub-scan lines of a pixel row, gathered by surface.
#pragma once

#include <span>
#include <vector>

#include "ig_core/outline/boundary_lanes.h"
#include "ig_core/spans/row_span.h"

namespace quadrig {

/// Appends the spans of one object to `spans`. `opaque` is false for an object with holes; `band` is kept from row to
/// row.
void add_object_spans(const Outline& outline, std::uint32_t index, bool opaque, const PixelRow& row, BandPlace& band,
                      std::vector<RowSpan>& spans);

/// The same on some rows from the top down, all of one image: those in one z-band are solved together.
class ObjectSpans {
  public:
    /// Begins an object; it and `rows` have to live as long as spans are asked for.
    void start(const Outline& outline, std::uint32_t index, bool opaque, std::span<const PixelRow> rows);
    /// Rows [first, last) of these are all that may show it.
    struct Rows {
        std::size_t first, last;
    };
    [[nodiscard]] Rows that_may_show() const;
    /// Appends its spans on one of them.
    void add(std::size_t row, std::vector<RowSpan>& spans);

  private:
    void solve_from(std::size_t row);
    void solve_limb_from(std::size_t row);
    [[nodiscard]] bool is_solved(std::size_t row) const;

    const Outline* outline_ = nullptr;
    std::uint32_t index_ = 0;
    bool opaque_ = true;
    std::span<const PixelRow> rows_;
    BandPlace band_ = kHighestBand;
    BoundaryLanes lines_;  // of solved_
    Rows solved_{0, 0};
    std::span<const Change> changes_;  // on these
};

/// Columns [from, to) that a convex object which lies all in front of the near plane covers whole by its spans on a
/// row, and a bound of 1/k on them: 1/k is concave over such an object's picture, so that the ends of spans bound what
/// lies between.
struct CoveredColumns {
    int from = 0, to = 0;
    double far_u = 0;
};
CoveredColumns columns_covered(std::span<const RowSpan> spans);

}  // namespace quadrig
