/// What one row of an outline shows: its boundaries from left to right and the surface to the right of each.
#pragma once

#include <array>

#include "ig_core/outline/outline.h"

namespace quadrig {

/// From left to right; the last one's surface is kNoSurface.
class RowOrder {
  public:
    /// Every pair of planes can meet, every curve cross the row twice, and the row has a left and a right end.
    static constexpr std::size_t kCapacity = 2 + 2 * (kMaxEyePlanes + 1) + kMaxEyePlanes * (kMaxEyePlanes - 1) / 2;

    void clear() { count_ = 0; }
    /// What comes on top of kCapacity is left out.
    void add(const Boundary& boundary, int surface) {
        if (count_ < kCapacity) changes_[count_++] = {boundary, static_cast<std::int8_t>(surface)};
    }
    [[nodiscard]] int last_surface() const { return count_ > 0 ? changes_[count_ - 1].surface : kNoSurface; }
    [[nodiscard]] const Change* begin() const { return changes_.data(); }
    [[nodiscard]] const Change* end() const { return changes_.data() + count_; }

  private:
    std::size_t count_ = 0;
    std::array<Change, kCapacity> changes_;
};

/// Boundaries closer than this (image-plane units; a pixel is 1e-5 at the least) are one: the sliver between them is
/// not asked.
inline constexpr double kSliver = 1e-12;
/// Boundaries that come out of order by more than this contradict the order.
inline constexpr double kDisorder = 1e-11;

/// A place between two that stands for all. Not their very middle: seen from straight before it, a plane that only
/// touches a cylinder or a hill does so there.
inline double typical_between(double from, double to) { return from + 0.4142 * (to - from); }

/// Solves a row by itself, the slow, sure way: finds every boundary candidate on it and asks for the surface at a
/// typical place of every interval between two.
void solve_row(const Outline& outline, double zeta, RowOrder& order);

}  // namespace quadrig
