/// Spans of one object: its cuts on the sub-scan lines of a pixel row, gathered by surface.
#pragma once

#include <array>
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
    /// Begins with these rows; they have to live as long as spans are asked for.
    void set_rows(std::span<const PixelRow> rows);
    /// Begins an object, which has to live as long.
    void start(const Outline& outline, std::uint32_t index, bool opaque);
    /// Rows [first, last) of these are all that may show it.
    struct Rows {
        std::size_t first, last;
    };
    [[nodiscard]] Rows that_may_show() const;
    /// Appends its spans on one of them.
    void add(std::size_t row, std::vector<RowSpan>& spans);

  private:
    /// Scan lines [first, last) of the strip, all in one z-band, or in none.
    struct Run {
        std::size_t first = 0, last = 0;
        std::span<const Change> changes;
        BoundaryLanes lines;
    };
    void solve_from(std::size_t line);
    void solve_limb(Run& run) const;
    void add_from(const Run& run, std::size_t row, std::vector<RowSpan>& spans) const;
    /// Of a row that the last run begins within; false where that takes more than the last two.
    bool add_from_both(std::size_t row, std::vector<RowSpan>& spans) const;

    const Outline* outline_ = nullptr;
    std::uint32_t index_ = 0;
    bool opaque_ = true, shallow_ = false;
    std::span<const PixelRow> rows_;
    std::size_t lines_ = 1;  // of a row
    std::vector<double> z_;  // of all their lines
    BandPlace band_ = kHighestBand;
    std::array<Run, 2> runs_;
    std::size_t newest_ = 0;
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
