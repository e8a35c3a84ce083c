#include "host_link/source_clock.h"

#include <cmath>

namespace quadrig::host {

std::optional<Time> TickClock::read(std::uint32_t ticks) {
    if (!last_ticks_) {
        last_ticks_ = ticks;
        last_ = ticks * tick_;
        return last_;
    }
    const auto elapsed = static_cast<std::int32_t>(ticks - *last_ticks_);
    last_ticks_ = ticks;
    last_ += elapsed * tick_;
    if (elapsed == 0) return std::nullopt;
    return last_;
}

void FdmClock::learn(std::uint32_t counter, Time arrival) {
    const bool advanced = first_ && static_cast<std::int32_t>(counter - last_) > 0;
    last_ = counter;
    if (!advanced) {
        first_ = Mark{counter, arrival};
        advances_ = 0;
        return;
    }
    if (++advances_ < kLearn) return;
    const double ticks = counter - first_->counter;
    const double tick = std::chrono::duration<double, std::nano>(arrival - first_->arrival).count() / ticks;
    first_.reset();
    const double decade = std::round(std::log10(tick));
    if (!(decade >= 0.0 && decade <= 9.0)) return;
    const double unit = std::pow(10.0, decade);
    if (tick > unit * kTolerance || tick < unit / kTolerance) return;
    unit_ = Time(std::llround(unit));
    time_ = counter * *unit_;
}

FdmClock::Reading FdmClock::read(std::uint32_t counter, Time arrival) {
    if (!unit_) {
        learn(counter, arrival);
        return {};
    }
    const Time elapsed = static_cast<std::int32_t>(counter - last_) * *unit_;
    if (elapsed == Time(0)) return {};
    if (elapsed < Time(0) && elapsed >= -kLateLimit) return {std::nullopt, true};
    if (elapsed < Time(0)) {
        *this = FdmClock();
        learn(counter, arrival);
        return {};
    }
    last_ = counter;
    time_ += elapsed;
    return {time_, false};
}

}  // namespace quadrig::host
