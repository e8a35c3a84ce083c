/// Which of some things show on each strip of pixel rows.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "ig_core/view.h"

namespace quadrig {

/// Rows are handed out in strips, so that objects are looked up once for several rows.
inline constexpr int kStripRows = 8;  // even: both rows of a pixel that is drawn twice as fine

inline int strips_of(const ImagePlane& image) { return (image.height + kStripRows - 1) / kStripRows; }

/// First and last strip of what shows between two heights of the image plane; none if it lies outside.
inline std::pair<int, int> strips_between(const ImagePlane& image, double z_from, double z_to) {
    if (!(z_from <= z_to && z_from <= image.top && z_to >= image.z(image.height))) return {1, 0};
    const auto strip = [&](double z) {
        const double row = (image.top - z) / image.row_step;
        return static_cast<int>(std::clamp(row, 0.0, image.height - 1.0)) / kStripRows;
    };
    return {strip(z_to), strip(z_from)};
}

/// Sorted once a frame; keeps its memory.
class StripIndex {
  public:
    /// `strips_of(i)` is the first and the last strip of thing i; none where last < first.
    template <class StripsOf>
    void sort(int strips, std::size_t count, StripsOf&& strips_of) {
        // No branch could foresee how many strips a thing is on. How many more things begin on a strip than ended on
        // the one before; where last < first both cancel.
        begin_.assign(static_cast<std::size_t>(strips) + 2, 0);
        for (std::size_t i = 0; i < count; ++i) {
            const auto [from, to] = strips_of(i);
            ++begin_[static_cast<std::size_t>(from)], --begin_[static_cast<std::size_t>(to) + 1];
        }
        // From that, how many are on it, and where they end in the list.
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        things_.resize(begin_.back());
        for (std::size_t i = count; i-- > 0;) {
            const auto [from, to] = strips_of(i);
            // Filled from the back, so that begin_ ends up where each strip starts.
            for (int s = from; s <= to; ++s)
                things_[--begin_[static_cast<std::size_t>(s)]] = static_cast<std::uint32_t>(i);
        }
    }
    [[nodiscard]] std::span<const std::uint32_t> on(int strip) const {
        const auto s = static_cast<std::size_t>(strip);
        return {things_.data() + begin_[s], begin_[s + 1] - begin_[s]};
    }

  private:
    std::vector<std::uint32_t> begin_, things_;
};

}  // namespace quadrig
