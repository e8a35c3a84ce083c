#include "frame_scheduler/real_time.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

namespace quadrig::scheduler {

RealTimeGrants request_real_time(const RealTimeWish& wish) {
    RealTimeGrants grants;
    if (wish.timer_slack) grants.timer_slack = prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL) == 0;
    // Not MCL_FUTURE: under a limit on locked memory it would make later allocations fail.
    if (wish.memory_locked) grants.memory_locked = mlockall(MCL_CURRENT) == 0;
    if (wish.fifo) {
        sched_param parameter{};
        parameter.sched_priority = sched_get_priority_min(SCHED_FIFO);
        grants.fifo = sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameter) == 0;
    }
    return grants;
}

}  // namespace quadrig::scheduler
