/// The scan-line sweep: spans of a pixel row in, visible runs of columns out (Gardner 1984, 2.1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ig_core/spans/priority.h"
#include "ig_core/spans/span_starts.h"

namespace quadrig {

/// Columns that show the same layers, front to back; the last one is opaque where the run is whole.
struct LayerRun {
    int from = 0, to = 0;
    std::uint32_t first_layer = 0, layer_count = 0;  ///< in RowSweep::layers
    bool partial = false;                            ///< some layer covers its pixels in part
};

/// One pixel row's spans, and what is seen of them.
struct RowSweep {
    std::vector<RowSpan> spans;  ///< the sky among them; the sweep adds pieces of those that cross
    std::vector<LayerRun> runs;
    std::vector<std::uint32_t> layers;  ///< indices into `spans`
    std::uint64_t pairs = 0;            ///< of spans that bounds of their depths did not put in order
};

/// Sweeps one pixel row at a time; keeps its memory from row to row. One for all rows, since little memory stays in the
/// nearest cache.
class RowSweeper {
  public:
    /// From the row's spans, as they were made, to its runs.
    void sweep(const PixelRow& row, RowSweep& out);

  private:
    void insert(std::uint32_t index, const PixelRow& row);
    /// Appends the run from a column on, up to `to` at most; returns where it ends, and drops what ends there or will
    /// not be seen again.
    int emit(int from, int to);

    RowSweep* out_ = nullptr;
    SpanStarts starts_;
    /// What every step asks of a span, close together.
    struct Extent {
        int outer_from;
        std::array<int, 3> changes;  ///< where it begins and ceases to cover columns whole, and where it ends
        bool opaque;
        DepthBounds depth;
        [[nodiscard]] int inner_from() const { return changes[0]; }
        [[nodiscard]] int inner_to() const { return changes[1]; }
        [[nodiscard]] int outer_to() const { return changes[2]; }
        /// How many of its changes do not lie behind a column it touches: it covers that one whole where this is 1.
        /// Nothing could foresee it: no branch.
        [[nodiscard]] std::size_t changes_until(int column) const {
            return static_cast<std::size_t>(inner_from() <= column) + static_cast<std::size_t>(inner_to() <= column);
        }
    };
    static Extent extent_of(const RowSpan& span);
    std::vector<Extent> extents_;        // parallel to the spans
    std::vector<std::uint32_t> active_;  // spans that the sweep is over, front to back

    /// Order of a span relative to another, found while it was put among the active ones.
    struct Order {
        std::uint32_t other;
        Priority priority;
    };
    /// What was known of a span when it was cut, each of its pieces keeps: a part has the order of the whole.
    struct Piece {
        std::uint32_t first_order, last_order;  // in orders_
        Order at_cut;                           // relative to the span it was cut at
    };
    [[nodiscard]] std::optional<Priority> order_of_whole(std::uint32_t index, std::uint32_t other) const;
    void cut(std::uint32_t first_order, std::uint32_t other, const PixelRow& row);
    std::vector<Order> orders_;
    std::vector<Piece> pieces_;  // from spans[first_piece_] on
    std::uint32_t first_piece_ = 0;
    CrossingPieces crossing_pieces_;
    RowDepths depths_;
};

}  // namespace quadrig
