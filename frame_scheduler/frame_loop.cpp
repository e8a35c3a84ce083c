#include "frame_scheduler/frame_loop.h"

#include <algorithm>

namespace quadrig::scheduler {

void run_frames(const LoopSettings& settings, Clock& clock, const Clock& stopwatch, const FrameHooks& hooks,
                FrameRecord& record) {
    std::uint64_t number = 0;
    for (std::uint64_t drawn = 0; !settings.frames || drawn < *settings.frames; ++drawn) {
        const Time elapsed = frame_time(settings.rate, number);
        if (settings.duration && elapsed >= *settings.duration) return;
        const Time due = settings.start + elapsed;
        clock.sleep_until(due);
        if (hooks.stop && hooks.stop()) return;

        const FrameTick tick{number, elapsed, due, clock.now()};
        const Time begun = stopwatch.now();
        const DrawnFrame frame = hooks.draw(tick);
        const Time whole = stopwatch.now();
        hooks.hand_over(tick);
        const Time handed_over = stopwatch.now();

        ++record.frames;
        record.wake_late.record(tick.started - due);
        record.frame.record(whole - begun);
        record.hand_over.record(handed_over - whole);
        for (std::size_t s = 0; s < kStageCount; ++s) record.stages[s].record(frame.stages[s]);
        if (frame.input_age) record.latency.record(*frame.input_age + (whole - begun));

        const std::uint64_t next = std::max(number + 1, first_frame_from(settings.rate, clock.now() - settings.start));
        record.deadline_misses += next > number + 1;
        record.repeated_frames += next - (number + 1);
        number = next;
    }
}

}  // namespace quadrig::scheduler
