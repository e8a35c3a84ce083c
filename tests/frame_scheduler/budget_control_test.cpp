#include "frame_scheduler/budget_control.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <set>

using namespace quadrig::scheduler;

namespace {

const std::vector<double> kCosts{0.3, 0.5, 0.7, 1.0, 1.5, 2.4};
constexpr std::size_t kDefault = 3;
constexpr Time kPeriod = std::chrono::milliseconds(16);

/// A scene that costs `load` periods at the default.
Time work(double load, std::size_t step) {
    return std::chrono::duration_cast<Time>(kPeriod * (load * kCosts[step] / kCosts[kDefault]));
}

std::size_t after(BudgetControl& control, double load, int frames) {
    for (int i = 0; i < frames; ++i) control.frame_took(work(load, control.step()));
    return control.step();
}

}  // namespace

TEST_CASE("one frame that is too long takes the quality down to where it would have been in time") {
    for (const double load : {0.86, 1.0, 1.2, 1.6, 2.5}) {
        BudgetControl control(kCosts, kDefault, kPeriod);
        const std::size_t step = after(control, load, 1);
        CAPTURE(load, step);
        CHECK(step < kDefault);
        CHECK(load * kCosts[step] <= BudgetControl::kBudget);
        CHECK(load * kCosts[step + 1] > BudgetControl::kBudget);
    }
}

TEST_CASE("what is too much for the lowest step stays on it") {
    BudgetControl control(kCosts, kDefault, kPeriod);
    CHECK(after(control, 10.0, 100) == 0);
}

TEST_CASE("quality goes up one step after a while of comfort, and all the way where nothing weighs") {
    BudgetControl control(kCosts, kDefault, kPeriod);
    CHECK(after(control, 0.2, BudgetControl::kPatience - 1) == kDefault);
    CHECK(after(control, 0.2, 1) == kDefault + 1);
    CHECK(after(control, 0.2, 10 * BudgetControl::kPatience) == kCosts.size() - 1);
}

TEST_CASE("a steady load settles on one step, whatever it is") {
    for (double load = 0.05; load < 4.0; load *= 1.07) {
        BudgetControl control(kCosts, kDefault, kPeriod);
        after(control, load, 500);
        std::set<std::size_t> steps;
        for (int i = 0; i < 500; ++i) steps.insert(after(control, load, 1));
        CAPTURE(load);
        CHECK(steps.size() == 1);
        if (*steps.begin() > 0) CHECK(load * kCosts[*steps.begin()] <= BudgetControl::kBudget);
    }
}

TEST_CASE("a single long frame costs quality for less than a second") {
    BudgetControl control(kCosts, kDefault, kPeriod);
    control.frame_took(3 * kPeriod);
    CHECK(control.step() == 0);
    CHECK(after(control, 0.5, 3 * BudgetControl::kPatience) == kDefault);
}
