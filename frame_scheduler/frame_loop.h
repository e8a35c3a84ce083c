/// The frame loop: wait for the deadline, draw, hand over, record. Everything it calls is set up before it starts.
///
/// Frame k is due at start + k * period. Its work (draw, then hand over) has one period's time. Work that ends after
/// frame k + 1 was due is a deadline miss: the picture before is shown in k's place once more, and again for every
/// further deadline that has passed (repeated frames). The next frame is the first whose deadline is still to come, so
/// that a late frame never makes the next one late. The loop itself does not allocate, lock, log or touch a file.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "frame_scheduler/frame_clock.h"
#include "frame_scheduler/statistics.h"
#include "ig_core/image_generator.h"

namespace quadrig::scheduler {

/// What a frame is told of its time, by the clock that the loop was given.
struct FrameTick {
    std::uint64_t number = 0;  ///< k: counts deadlines from 0, those of frames that were not drawn included
    Time elapsed{};            ///< from frame 0's deadline to this one's: the time that the picture shows
    Time due{};                ///< start + elapsed
    Time started{};            ///< when the loop woke for it
};

struct DrawnFrame {
    StageTimes stages{};
    /// Where this picture is the first to show the newest host sample: how old that was at FrameTick::started, counted
    /// from the arrival of its datagram.
    std::optional<Time> input_age;
};

/// What the loop calls, in this order. None may be empty but `stop`.
struct FrameHooks {
    std::function<bool()> stop;                        ///< asked before every frame; true ends the loop
    std::function<DrawnFrame(const FrameTick&)> draw;  ///< latch, move, render, overlay: leaves a whole picture
    std::function<void(const FrameTick&)> hand_over;   ///< hash and sinks
};

struct LoopSettings {
    FrameRate rate;
    Time start{};                         ///< when frame 0 is due
    std::optional<std::uint64_t> frames;  ///< draw so many
    std::optional<Time> duration;         ///< no frame that is due at start + duration or later
};

/// What happened. Times of work are by the stopwatch, so that they mean the same with a simulated frame clock.
struct FrameRecord {
    std::uint64_t frames = 0;           ///< pictures drawn
    std::uint64_t deadline_misses = 0;  ///< of them, those finished after the next frame's deadline
    std::uint64_t repeated_frames = 0;  ///< deadlines at which the picture before was shown once more
    Distribution frame;                 ///< from waking to the picture whole in the frame buffer
    std::array<Distribution, kStageCount> stages;
    Distribution hand_over;  ///< hash and copies for the sinks
    Distribution latency;    ///< from the arrival of the newest sample's datagram to the first picture with it, whole
    Distribution wake_late;  ///< from the deadline to the loop's waking: the timer's share, see TimerWatcher
};

/// Runs until a hook or a setting ends it. `clock` says when frames are due (MonotonicClock: in real time;
/// SimulatedClock: as fast as they can be drawn), `stopwatch` how long work takes. `record` is added to.
void run_frames(const LoopSettings& settings, Clock& clock, const Clock& stopwatch, const FrameHooks& hooks,
                FrameRecord& record);

}  // namespace quadrig::scheduler
