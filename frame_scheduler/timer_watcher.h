/// How late the machine's timer itself is: a bare loop of sleeps beside the frame loop, to judge the frame loop by.
#pragma once

#include <atomic>
#include <thread>

#include "frame_scheduler/frame_clock.h"
#include "frame_scheduler/real_time.h"
#include "frame_scheduler/statistics.h"

namespace quadrig::scheduler {

/// A thread that does nothing but sleep to absolute deadlines and note how late it wakes. Its deadlines lie kLead
/// before the frame loop's: close enough to see the same machine, and at a time when a frame loop that keeps its own
/// deadlines is asleep, so that what is measured is the timer and not the loop's work.
class TimerWatcher {
  public:
    static constexpr Time kLead = std::chrono::milliseconds(1);

    /// Starts the thread. `start` is when frame 0 is due, by CLOCK_MONOTONIC. It asks for the same favours as the frame
    /// thread.
    TimerWatcher(Time start, const FrameRate& rate, const RealTimeWish& wish);
    ~TimerWatcher() { stop(); }
    TimerWatcher(const TimerWatcher&) = delete;
    TimerWatcher& operator=(const TimerWatcher&) = delete;

    /// Ends the thread, within a frame's time. May be called twice.
    void stop();
    /// From deadline to waking, one record a period. Only after stop().
    [[nodiscard]] const Distribution& lateness() const { return lateness_; }

  private:
    Distribution lateness_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

}  // namespace quadrig::scheduler
