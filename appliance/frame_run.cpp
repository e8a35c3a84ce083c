#include "appliance/frame_run.h"

#include <chrono>

#include "frame_scheduler/real_time.h"
#include "frame_scheduler/timer_watcher.h"

namespace quadrig::appliance {
namespace {

/// Enough for the timer's thread to be there, too little for anybody to wait for.
constexpr std::chrono::milliseconds kRunUp{20};

}  // namespace

void run_in_real_time(const scheduler::FrameRate& rate, const RunLength& length, bool fifo,
                      const scheduler::FrameHooks& hooks, scheduler::FrameRecord& record,
                      scheduler::FrameReport& report) {
    const scheduler::RealTimeWish wish{.timer_slack = true, .memory_locked = true, .fifo = fifo};
    report.real_time = true;
    report.grants = scheduler::request_real_time(wish);
    scheduler::MonotonicClock clock;
    const scheduler::Time start = clock.now() + kRunUp;
    scheduler::TimerWatcher timer(start, rate, wish);
    scheduler::run_frames({rate, start, length.frames, length.duration}, clock, clock, hooks, record);
    timer.stop();
    report.timer_late = timer.lateness().percentiles();
}

void run_as_fast_as_possible(const scheduler::FrameRate& rate, const RunLength& length,
                             const scheduler::FrameHooks& hooks, scheduler::FrameRecord& record) {
    scheduler::SimulatedClock clock;
    const scheduler::MonotonicClock stopwatch;
    scheduler::run_frames({rate, scheduler::Time{0}, length.frames, length.duration}, clock, stopwatch, hooks, record);
}

}  // namespace quadrig::appliance
