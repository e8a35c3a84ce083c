/// Clocks for the tests of this folder.
#pragma once

#include "frame_scheduler/frame_clock.h"

namespace quadrig::scheduler::test {

/// Time passes only where a test says so; every sleep may end late.
class FakeClock : public Clock {
  public:
    [[nodiscard]] Time now() const override { return now_; }
    void sleep_until(Time deadline) override {
        if (deadline > now_) now_ = deadline;
        now_ += wakes_late;
    }
    void pass(Time time) { now_ += time; }
    Time wakes_late{};

  private:
    Time now_{};
};

}  // namespace quadrig::scheduler::test
