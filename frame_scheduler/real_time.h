/// What a frame thread asks of the operating system, and what it got.
#pragma once

namespace quadrig::scheduler {

/// Which of the kernel's favours to ask for.
struct RealTimeWish {
    bool timer_slack = true;    ///< wake at the nanosecond asked for, not up to 50 us later to save power
    bool memory_locked = true;  ///< no page of the process is taken away while it runs
    bool fifo = false;          ///< SCHED_FIFO: ordinary programs never delay the thread; needs the privilege
};

/// The same, as granted.
struct RealTimeGrants {
    bool timer_slack = false;
    bool memory_locked = false;
    bool fifo = false;
};

/// Asks for the calling thread (memory: for the process as it is now). What is refused is not an error. Threads started
/// later are ordinary ones again. Call it after everything is allocated.
RealTimeGrants request_real_time(const RealTimeWish& wish);

}  // namespace quadrig::scheduler
