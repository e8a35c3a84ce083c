/// What a figure shows of an outline: its z-bands within a window, and the boundary segments that they make visible.
#pragma once

#include "ig_core/outline/figure.h"
#include "ig_core/outline/outline.h"

namespace quadrig {

/// `intercept`, but exact to rounding also at a curve's extremum, where that may be nought by nought; NaN where nothing
/// can be said.
double drawn_intercept(const Outline& outline, const Boundary& boundary, double zeta);

/// Whether a curve is nothing but level lines in the window: its form does not change along a row.
bool is_level(const RowConic& conic, const ImageWindow& window);

/// A z-band with its boundaries from left to right, `surfaces[i]` to the right of `boundaries[i]`. Never without one.
struct SeenBand {
    double zeta_from = 0, zeta_to = 0;
    std::vector<Boundary> boundaries;
    std::vector<int> surfaces;
};

/// The outline's own bands; for one that is nothing but a limb, the rows that it spans; for one that is solved row by
/// row, those between which the order of its boundaries changes.
std::vector<SeenBand> bands_in_window(const Outline& outline, const ImageWindow& window);

/// The boundaries of every band, and the level ones that lie between two bands.
std::vector<VisibleSegment> visible_segments(const Outline& outline, const std::vector<SeenBand>& bands,
                                             const ImageWindow& window);

}  // namespace quadrig
