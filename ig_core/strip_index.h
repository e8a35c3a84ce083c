/// Which of some things show on each strip of pixel rows.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace quadrig {

/// Sorted once a frame; keeps its memory.
class StripIndex {
  public:
    /// `strips_of(i)` is the first and the last strip of thing i; none where last < first.
    template <class StripsOf>
    void sort(int strips, std::size_t count, StripsOf&& strips_of) {
        begin_.assign(static_cast<std::size_t>(strips) + 1, 0);
        for (std::size_t i = 0; i < count; ++i) {
            const auto [from, to] = strips_of(i);
            for (int s = from; s <= to; ++s) ++begin_[static_cast<std::size_t>(s) + 1];
        }
        for (std::size_t s = 1; s < begin_.size(); ++s) begin_[s] += begin_[s - 1];
        things_.resize(begin_.back());
        for (std::size_t i = count; i-- > 0;) {
            const auto [from, to] = strips_of(i);
            // Filled from the back, so that begin_ ends up where each strip starts.
            for (int s = from; s <= to; ++s)
                things_[--begin_[static_cast<std::size_t>(s) + 1]] = static_cast<std::uint32_t>(i);
        }
        std::rotate(begin_.begin(), begin_.begin() + 1, begin_.end());
        begin_.back() = static_cast<std::uint32_t>(things_.size());
    }
    [[nodiscard]] std::span<const std::uint32_t> on(int strip) const {
        const auto s = static_cast<std::size_t>(strip);
        return {things_.data() + begin_[s], begin_[s + 1] - begin_[s]};
    }

  private:
    std::vector<std::uint32_t> begin_, things_;
};

}  // namespace quadrig
