#include "frame_scheduler/frame_clock.h"

#include <time.h>

#include <cerrno>
#include <cmath>
#include <numeric>

namespace quadrig::scheduler {

namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

}  // namespace

std::optional<FrameRate> frame_rate(double hertz) {
    if (!(hertz >= 1.0 && hertz <= 1000.0)) return std::nullopt;
    const double video = std::round(hertz * 1.001);
    if (hertz != std::round(hertz) && std::abs(hertz * 1.001 - video) < 2e-4)
        return FrameRate{static_cast<std::int64_t>(video) * 1000, 1001};
    const auto thousandths = static_cast<std::int64_t>(std::llround(hertz * 1000.0));
    const std::int64_t common = std::gcd(thousandths, std::int64_t{1000});
    return FrameRate{thousandths / common, 1000 / common};
}

Time frame_time(const FrameRate& rate, std::uint64_t k) {
    // In whole groups of `numerator` frames and a rest, so that no product leaves 64 bits.
    const auto frame = static_cast<std::int64_t>(k);
    const std::int64_t group = rate.denominator * kNanosecondsPerSecond;
    return Time(frame / rate.numerator * group + frame % rate.numerator * group / rate.numerator);
}

std::uint64_t first_frame_from(const FrameRate& rate, Time elapsed) {
    if (elapsed <= Time{0}) return 0;
    auto k = static_cast<std::uint64_t>(std::chrono::duration<double>(elapsed).count() * rate.hertz());
    while (k > 0 && frame_time(rate, k - 1) >= elapsed) --k;
    while (frame_time(rate, k) < elapsed) ++k;
    return k;
}

Time MonotonicClock::now() const {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return Time(t.tv_sec * kNanosecondsPerSecond + t.tv_nsec);
}

void MonotonicClock::sleep_until(Time deadline) {
    const timespec t{deadline.count() / kNanosecondsPerSecond, deadline.count() % kNanosecondsPerSecond};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
    }
}

}  // namespace quadrig::scheduler
