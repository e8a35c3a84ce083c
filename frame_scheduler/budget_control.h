/// Holds the frame budget by walking a quality ladder: down at once where a frame would not end in time, up a step
/// where time has been left for a while.
///
/// The work of a frame is taken to be proportional to the cost of its step, as the ladder states it. Down goes to the
/// best step that the last frame would have been done in time with; up needs kPatience frames in a row that would have
/// been in time on the next step, so that the picture does not flicker between two steps.
#pragma once

#include <vector>

#include "frame_scheduler/frame_clock.h"

namespace quadrig::scheduler {

class BudgetControl {
  public:
    /// Share of the period that a frame's work may take; the rest is the machine's jitter.
    static constexpr double kBudget = 0.85;
    /// Share it may be predicted to take on a better step.
    static constexpr double kComfort = 0.7;
    static constexpr int kPatience = 30;

    /// `costs`: of the steps, rising, above 0; at least one. `start` is the step to begin with.
    BudgetControl(std::vector<double> costs, std::size_t start, Time period);

    /// The step to draw the next frame with.
    [[nodiscard]] std::size_t step() const { return step_; }
    /// How long the frame took that was drawn with step(). Allocates nothing.
    void frame_took(Time work);

  private:
    std::vector<double> costs_;
    std::size_t step_;
    double period_;
    int comfortable_ = 0;
};

}  // namespace quadrig::scheduler
