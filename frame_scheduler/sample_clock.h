/// When a host sample was meant for: its time on the receiver's clock, freed from the jitter of its journey.
///
/// A datagram's arrival is the host's time plus a constant (the clocks' difference and the least delay) plus a jitter
/// that is never negative. So the least of arrival - source time over the last seconds is the constant. Hosts without
/// time stamps send at a steady period: arrivals are then laid on a regular grid that follows the earliest of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "frame_scheduler/frame_clock.h"
#include "host_link/host_state.h"

namespace quadrig::scheduler {

/// The least value of the last kWindow, by the values' own times: for clock offsets, robust to bursts of late packets
/// and following the slow drift of one clock against the other (100 ppm move it by 0.5 ms).
class LeastDelay {
  public:
    static constexpr Time kBucket = std::chrono::seconds(1);
    static constexpr std::size_t kBuckets = 5;  // the window is between kBuckets - 1 and kBuckets seconds long
    void observe(Time arrival, Time delay);
    [[nodiscard]] std::optional<Time> least() const;
    void restart() { newest_bucket_ = -1; }

  private:
    std::array<Time, kBuckets> least_{};
    std::int64_t newest_bucket_ = -1;  ///< since the clock's epoch; negative: nothing observed
};

/// The times at which a host of a steady period would have been heard without jitter: the straight line of arrival over
/// sequence number that lies below all of the last kWindow arrivals and as close to them as it can. It is the edge of
/// their lower convex hull over their mean sequence number. Late packets lie above and do not move it; a sample
/// lost on the way moves it by a period. Of what it moves by, kYield is let in a sample, or more while the line rests
/// on few, so that nothing jumps. Source: Moon, Skelly, Towsley, "Estimation and Removal of Clock Skew from Network
/// Delay Measurements", INFOCOM 1999.
class ArrivalGrid {
  public:
    void observe(std::uint64_t sequence, Time arrival);
    /// A sample's time on the line. Absent until the arrivals in hand cover kSettling.
    [[nodiscard]] std::optional<Time> time_of(std::uint64_t sequence) const;

    static constexpr std::size_t kWindow = 256;
    static constexpr double kYield = 0.02;
    static constexpr Time kSettling = std::chrono::milliseconds(500);
    /// Arrivals further than this off the line start a new one: the host has paused, or changed its period.
    static constexpr Time kLost = std::chrono::milliseconds(250);

  private:
    struct Point {
        std::int64_t sequence = 0;
        Time arrival{};
    };
    [[nodiscard]] const Point& point(std::size_t i) const { return points_[(oldest_ + i) % kWindow]; }
    [[nodiscard]] bool settled() const;
    [[nodiscard]] Time on_line(std::int64_t sequence) const;
    void fit();

    std::array<Point, kWindow> points_{};  ///< a ring
    std::size_t oldest_ = 0, count_ = 0;
    Point line_begin_, line_end_;  ///< two points of the line, once count_ is 2 or more
    Time held_back_{};             ///< of the line's moves, not let in yet
};

/// Both of these, fed with the samples of a state as it is latched frame by frame. A function of the samples alone:
/// channels that latch the same states agree.
class SampleClock {
  public:
    void observe(const host::HostState& state);

    struct PairTimes {
        Time earlier{}, newest{};
    };
    /// Times of state.earlier and state.newest, which must have been observed, on the clock of their arrivals. By
    /// source times where both have one, else by the arrivals' grid. Absent where neither is known well enough, and
    /// where the newest is not the later one.
    [[nodiscard]] std::optional<PairTimes> times(const host::HostState& state) const;

    /// A delay this much off the least one means that the host's clock was set anew.
    static constexpr Time kClockSet = std::chrono::seconds(1);

  private:
    void observe(const host::PoseSample& sample);
    std::uint64_t sequence_ = 0;
    LeastDelay delay_;
    ArrivalGrid grid_;
};

}  // namespace quadrig::scheduler
