/// Triage: what all rays near a given one do with a solid, by arithmetic with error bounds. Most pixels are settled
/// here; only where an answer is in doubt is it asked of quadruple precision.
///
/// A pixel that is settled is no tie: every ray of the bundle gives the same answer.
#pragma once

#include <limits>

#include "ig_core/reference/solid.h"

namespace quadrig::reference {

/// Where the rays of a bundle enter a solid. What is certain holds for each of them, rounding included.
struct EntryBounds {
    enum class Verdict { misses, enters, in_doubt };
    Verdict verdict = Verdict::in_doubt;
    double least_depth = kNearDepth;                                  ///< no ray enters nearer than this
    double greatest_depth = std::numeric_limits<double>::infinity();  ///< nor, if all enter, deeper than this
    int surface = 0;                                                  ///< which one, if all enter
};

/// The bundle: all directions whose distance from `direction` is at most `reach`. A solid that is entered at k_near or
/// less counts as missed.
EntryBounds entry_bounds(const Solid<double>& solid, const Vector<double>& direction, double reach);

/// The same for a level plane `drop` metres above the eye (negative below); there is nothing to enter, only to meet.
EntryBounds level_plane_bounds(double drop, const Vector<double>& direction, double reach);

}  // namespace quadrig::reference
