/// The host's own time of a sample, out of the counters that protocols carry.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "host_link/host_state.h"

namespace quadrig::host {

/// CIGI's time stamps wrap after 11.9 hours.
inline constexpr Time kCigiTick = std::chrono::microseconds(10);
/// The host time of our Modbus registers wraps after 49.7 days.
inline constexpr Time kModbusTick = std::chrono::milliseconds(1);

/// A host's own clock: 32 bits of ticks of a known length, which wrap.
class TickClock {
  public:
    explicit TickClock(Time tick) : tick_(tick) {}
    /// The time stamp unwrapped; absent where it stands still. Messages must come in order.
    std::optional<Time> read(std::uint32_t ticks);
    void restart() { last_ticks_.reset(); }

  private:
    Time tick_;
    std::optional<std::uint32_t> last_ticks_;
    Time last_{};
};

/// FlightGear FDM: cur_time counts in a unit that the packet does not name (JSBSim: any power of ten of a second;
/// FlightGear: whole seconds), or stands still. It is used once it has advanced with every one of kLearn samples, at a
/// pace that some power of ten explains within a factor of kTolerance of the arrivals'.
class FdmClock {
  public:
    static constexpr int kLearn = 16;
    static constexpr double kTolerance = 2.0;

    struct Reading {
        std::optional<Time> time;  ///< absent until the unit is known, and where the counter stands still
        bool backwards = false;    ///< older than the sample before it, by up to kLateLimit: out of order
    };
    static constexpr Time kLateLimit = std::chrono::seconds(2);

    Reading read(std::uint32_t counter, Time arrival);

  private:
    void learn(std::uint32_t counter, Time arrival);

    struct Mark {
        std::uint32_t counter = 0;
        Time arrival{};
    };
    std::optional<Mark> first_;  ///< where learning began
    std::uint32_t last_ = 0;
    int advances_ = 0;
    std::optional<Time> unit_;
    Time time_{};
};

}  // namespace quadrig::host
