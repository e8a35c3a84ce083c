#include "frame_scheduler/budget_control.h"

#include <chrono>
#include <utility>

namespace quadrig::scheduler {

BudgetControl::BudgetControl(std::vector<double> costs, std::size_t start, Time period)
    : costs_(std::move(costs)), step_(start), period_(std::chrono::duration<double>(period).count()) {}

void BudgetControl::frame_took(Time work) {
    const double share = std::chrono::duration<double>(work).count() / period_;
    const auto on_step = [&](std::size_t other) { return share * costs_[other] / costs_[step_]; };
    if (share > kBudget) {
        std::size_t down = step_;
        while (down > 0 && on_step(down) > kBudget) --down;
        step_ = down;
        comfortable_ = 0;
    } else if (step_ + 1 < costs_.size() && on_step(step_ + 1) <= kComfort) {
        if (++comfortable_ < kPatience) return;
        ++step_;
        comfortable_ = 0;
    } else {
        comfortable_ = 0;
    }
}

}  // namespace quadrig::scheduler
