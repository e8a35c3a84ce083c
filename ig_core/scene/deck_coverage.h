/// How much of a cloud deck there is: which threshold of its texturing function covers a given share of the sky.
#pragma once

#include <array>
#include <cstddef>

#include "ig_core/scene/scene.h"

namespace quadrig {

class DeckCoverage {
  public:
    /// Looks at the texture at many places; not for the frame loop.
    DeckCoverage(const Texture& texture, const Translucence& translucence);

    /// The threshold tau with which the deck's opacity, clamp((T - tau)/softness + 1/2, 0, 1), averages `coverage`
    /// (0..1) over the plane; to about 0.02 of coverage.
    [[nodiscard]] double threshold(double coverage) const;

  private:
    static constexpr std::size_t kSteps = 64;
    std::array<double, kSteps + 1> thresholds_{};  ///< by coverage, evenly
};

}  // namespace quadrig
