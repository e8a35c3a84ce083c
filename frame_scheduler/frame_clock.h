/// When frames are due: absolute deadlines at a rational rate, and the clocks that wait for them.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace quadrig::scheduler {

/// Time since the epoch of some clock, which the context names; most often CLOCK_MONOTONIC.
using Time = std::chrono::nanoseconds;

/// Frames a second as a fraction, so that 59.94 Hz (60000/1001) does not drift in an hour.
struct FrameRate {
    std::int64_t numerator = 60;
    std::int64_t denominator = 1;
    [[nodiscard]] double hertz() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
    friend bool operator==(const FrameRate&, const FrameRate&) = default;
};

/// The fraction meant by a decimal number: whole rates, the video rates n * 1000/1001 (59.94, 29.97, 23.976), otherwise
/// thousandths of a hertz. Nothing for numbers outside 1..1000 Hz.
std::optional<FrameRate> frame_rate(double hertz);

/// Time from frame 0 to frame k: k * denominator / numerator seconds, rounded down to a nanosecond, never added up.
/// Good for 292 years.
Time frame_time(const FrameRate& rate, std::uint64_t k);

/// The first frame whose frame_time is `elapsed` or later.
std::uint64_t first_frame_from(const FrameRate& rate, Time elapsed);

/// A clock is handed in wherever time matters, so that tests bring their own.
class Clock {
  public:
    virtual ~Clock() = default;
    [[nodiscard]] virtual Time now() const = 0;
    /// Returns at `deadline` or later; at once where it has passed.
    virtual void sleep_until(Time deadline) = 0;
};

/// CLOCK_MONOTONIC and clock_nanosleep with TIMER_ABSTIME (POSIX.1-2008): a signal does not shorten a sleep.
class MonotonicClock : public Clock {
  public:
    [[nodiscard]] Time now() const override;
    void sleep_until(Time deadline) override;
};

/// A clock that jumps to every deadline and otherwise stands still: frames as fast as they can be drawn, none ever
/// late.
class SimulatedClock : public Clock {
  public:
    explicit SimulatedClock(Time start = {}) : now_(start) {}
    [[nodiscard]] Time now() const override { return now_; }
    void sleep_until(Time deadline) override {
        if (deadline > now_) now_ = deadline;
    }

  private:
    Time now_;
};

}  // namespace quadrig::scheduler
