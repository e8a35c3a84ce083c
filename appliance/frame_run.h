/// The two ways to run the frame loop.
#pragma once

#include <optional>

#include "frame_scheduler/frame_loop.h"
#include "frame_scheduler/frame_report.h"

namespace quadrig::appliance {

/// Where a run ends by itself.
struct RunLength {
    std::optional<std::uint64_t> frames;
    std::optional<scheduler::Time> duration;
};

/// By deadlines of CLOCK_MONOTONIC, the first a moment from now; beside it a bare timer loop that the report compares
/// it with. What the system grants to the calling thread goes into the report as well. `fifo`: ask for real-time
/// priority.
void run_in_real_time(const scheduler::FrameRate& rate, const RunLength& length, bool fifo,
                      const scheduler::FrameHooks& hooks, scheduler::FrameRecord& record,
                      scheduler::FrameReport& report);

/// One frame after the other; nothing is ever late.
void run_as_fast_as_possible(const scheduler::FrameRate& rate, const RunLength& length,
                             const scheduler::FrameHooks& hooks, scheduler::FrameRecord& record);

}  // namespace quadrig::appliance
