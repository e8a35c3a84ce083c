#include "frame_scheduler/frame_clock.h"

#include <signal.h>
#include <sys/time.h>

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace quadrig::scheduler;
using namespace std::chrono_literals;

TEST_CASE("Deadlines of a rational rate do not drift: after every whole number of seconds they are exact") {
    for (const auto& rate : {FrameRate{60, 1}, FrameRate{60000, 1001}, FrameRate{24000, 1001}, FrameRate{59333, 1000}})
        for (const std::uint64_t hours : {1U, 24U, 1000U}) {
            const std::uint64_t frames = hours * 3600 * static_cast<std::uint64_t>(rate.numerator);
            CHECK(frame_time(rate, frames) ==
                  std::chrono::seconds(hours * 3600 * static_cast<unsigned>(rate.denominator)));
        }
}

TEST_CASE("A frame's time is the fraction in long double rounded down") {
    const std::uint32_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 10000; ++i) {
        const FrameRate rate{static_cast<std::int64_t>(random() % 240000 + 1),
                             static_cast<std::int64_t>(random() % 1001 + 1)};
        const std::uint64_t k = random() % 10'000'000;
        const long double exact = static_cast<long double>(k) * 1e9L * static_cast<long double>(rate.denominator) /
                                  static_cast<long double>(rate.numerator);
        const auto time = static_cast<long double>(frame_time(rate, k).count());
        INFO(k << " at " << rate.numerator << "/" << rate.denominator);
        REQUIRE(time <= exact + 1e-2L);
        REQUIRE(time > exact - 1.0L - 1e-2L);
    }
}

TEST_CASE("The first frame from a time on is due then or later, and the one before it is not") {
    const std::uint32_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (const auto& rate : {FrameRate{60, 1}, FrameRate{60000, 1001}, FrameRate{1, 1}, FrameRate{1000, 1}})
        for (int i = 0; i < 2000; ++i) {
            // Half of them exactly on a deadline.
            const Time elapsed = i % 2 ? Time(static_cast<std::int64_t>(random() % 1'000'000'000'000))
                                       : frame_time(rate, random() % 1'000'000);
            const std::uint64_t k = first_frame_from(rate, elapsed);
            REQUIRE(frame_time(rate, k) >= elapsed);
            if (k > 0) REQUIRE(frame_time(rate, k - 1) < elapsed);
        }
    CHECK(first_frame_from({60, 1}, -5ms) == 0);
}

TEST_CASE("Decimal rates become the fractions that are meant") {
    CHECK(frame_rate(60) == FrameRate{60, 1});
    CHECK(frame_rate(59.94) == FrameRate{60000, 1001});
    CHECK(frame_rate(29.97) == FrameRate{30000, 1001});
    CHECK(frame_rate(23.976) == FrameRate{24000, 1001});
    CHECK(frame_rate(119.88) == FrameRate{120000, 1001});
    CHECK(frame_rate(12.5) == FrameRate{25, 2});
    CHECK(frame_rate(1) == FrameRate{1, 1});
    for (const double wrong :
         {0.0, -60.0, 0.5, 1001.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        CHECK_FALSE(frame_rate(wrong));
}

TEST_CASE("A sleep on the monotonic clock never ends before its deadline, signals or not") {
    struct sigaction ignore {
    }, before{};
    ignore.sa_handler = [](int) {};  // without SA_RESTART
    sigaction(SIGALRM, &ignore, &before);
    const itimerval every_ms{{0, 1000}, {0, 1000}}, off{};
    setitimer(ITIMER_REAL, &every_ms, nullptr);
    MonotonicClock clock;
    const Time deadline = clock.now() + 30ms;
    clock.sleep_until(deadline);
    const Time woke = clock.now();
    setitimer(ITIMER_REAL, &off, nullptr);
    sigaction(SIGALRM, &before, nullptr);
    CHECK(woke >= deadline);
    CHECK(woke < deadline + 1s);
    const Time now = clock.now();
    clock.sleep_until(now - 1s);
    CHECK(clock.now() - now < 1s);
}
