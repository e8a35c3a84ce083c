#include "frame_scheduler/timer_watcher.h"

#include <algorithm>

namespace quadrig::scheduler {

TimerWatcher::TimerWatcher(Time start, const FrameRate& rate, const RealTimeWish& wish) {
    thread_ = std::thread([this, start, rate, wish] {
        request_real_time(wish);
        MonotonicClock clock;
        const Time first = start - kLead;
        std::uint64_t k = first_frame_from(rate, clock.now() - first);
        while (true) {
            const Time due = first + frame_time(rate, k);
            clock.sleep_until(due);
            if (stop_.load(std::memory_order_relaxed)) return;
            const Time now = clock.now();
            lateness_.record(now - due);
            k = std::max(k + 1, first_frame_from(rate, now - first));
        }
    });
}

void TimerWatcher::stop() {
    stop_.store(true, std::memory_order_relaxed);
    if (thread_.joinable()) thread_.join();
}

}  // namespace quadrig::scheduler
