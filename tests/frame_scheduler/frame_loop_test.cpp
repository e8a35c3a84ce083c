#include "frame_scheduler/frame_loop.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "display/channel.h"
#include "display/frame_hash.h"
#include "display/overlay.h"
#include "display/sink.h"
#include "frame_scheduler/motion.h"
#include "frame_scheduler/timer_watcher.h"
#include "tests/frame_scheduler/fake_clock.h"

using namespace quadrig;
using namespace quadrig::scheduler;
using namespace std::chrono_literals;
using quadrig::scheduler::test::FakeClock;

namespace {

// Allocations of the thread that asks.
thread_local std::uint64_t allocations = 0;

constexpr FrameRate kRate{100, 1};  // a period of 10 ms

LoopSettings settings(std::uint64_t frames) { return {kRate, Time{}, frames, std::nullopt}; }

}  // namespace

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(size);
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return operator new(size, tag); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

TEST_CASE("Frames in time start at their own deadlines, however long each one takes") {
    FakeClock clock;
    std::vector<FrameTick> ticks;
    FrameRecord record;
    run_frames(settings(50), clock, clock,
               {{},
                [&](const FrameTick& tick) {
                    ticks.push_back(tick);
                    clock.pass(std::chrono::milliseconds(1 + tick.number % 9));
                    return DrawnFrame{};
                },
                [&](const FrameTick&) { clock.pass(1ms); }},
               record);
    REQUIRE(ticks.size() == 50);
    for (std::size_t k = 0; k < 50; ++k) {
        CHECK(ticks[k].number == k);
        CHECK(ticks[k].elapsed == k * 10ms);
        CHECK(ticks[k].due == k * 10ms);
        CHECK(ticks[k].started == k * 10ms);
    }
    CHECK(record.frames == 50);
    CHECK(record.deadline_misses == 0);  // nine milliseconds and one: just in time
    CHECK(record.repeated_frames == 0);
    CHECK(record.frame.percentiles().max == 9ms);
    CHECK(record.hand_over.percentiles().max == 1ms);
}

TEST_CASE(
    "A late frame is counted, holds the picture for the deadlines it ran over and never makes the next one late") {
    FakeClock clock;
    std::vector<FrameTick> ticks;
    FrameRecord record;
    run_frames(settings(8), clock, clock,
               {{},
                [&](const FrameTick& tick) {
                    ticks.push_back(tick);
                    // Frame 2 ends within the period after its own, frame 5 within the third after.
                    clock.pass(tick.number == 2 ? 10ms + 1ns : tick.number == 5 ? 35ms : 4ms);
                    return DrawnFrame{};
                },
                [](const FrameTick&) {}},
               record);
    std::vector<std::uint64_t> numbers;
    for (const FrameTick& tick : ticks) {
        numbers.push_back(tick.number);
        CHECK(tick.started == tick.due);
    }
    CHECK(numbers == std::vector<std::uint64_t>{0, 1, 2, 4, 5, 9, 10, 11});
    CHECK(record.frames == 8);
    CHECK(record.deadline_misses == 2);
    CHECK(record.repeated_frames == 4);
}

TEST_CASE("A timer that wakes late is reported as such and costs a miss only where the work then ends too late") {
    FakeClock clock;
    clock.wakes_late = 3ms;
    FrameRecord record;
    const auto work = [&](Time time) {
        record = {};
        run_frames(settings(10), clock, clock,
                   {{},
                    [&](const FrameTick&) {
                        clock.pass(time);
                        return DrawnFrame{};
                    },
                    [](const FrameTick&) {}},
                   record);
    };
    work(6ms);
    CHECK(record.deadline_misses == 0);
    CHECK(record.wake_late.percentiles().min == 3ms);
    CHECK(record.frame.percentiles().max == 6ms);
    FakeClock again;
    clock = again;
    clock.wakes_late = 3ms;
    work(8ms);
    CHECK(record.deadline_misses == 10);
}

TEST_CASE("The loop ends at its number of frames, at its duration, or when it is told to") {
    const auto frames_of = [](LoopSettings s, std::uint64_t stop_after) {
        FakeClock clock;
        FrameRecord record;
        std::uint64_t drawn = 0;
        run_frames(s, clock, clock,
                   {[&] { return drawn >= stop_after; },
                    [&](const FrameTick&) {
                        ++drawn;
                        return DrawnFrame{};
                    },
                    [](const FrameTick&) {}},
                   record);
        return record.frames;
    };
    constexpr std::uint64_t kNever = 1'000'000;
    CHECK(frames_of({kRate, 5s, 7, std::nullopt}, kNever) == 7);
    CHECK(frames_of({kRate, 5s, std::nullopt, 1s}, kNever) == 100);
    CHECK(frames_of({kRate, 5s, std::nullopt, 1s + 1ns}, kNever) == 101);
    CHECK(frames_of({kRate, 5s, 7, 1s}, 3) == 3);
    CHECK(frames_of({kRate, 5s, 0, std::nullopt}, kNever) == 0);
}

TEST_CASE("With a simulated clock frames come as fast as they can, none late, times of work real") {
    SimulatedClock clock(100s);
    FakeClock stopwatch;
    FrameRecord record;
    std::vector<Time> due;
    run_frames({{60, 1}, 100s, 600, std::nullopt}, clock, stopwatch,
               {{},
                [&](const FrameTick& tick) {
                    due.push_back(tick.due);
                    stopwatch.pass(40ms);
                    return DrawnFrame{};
                },
                [](const FrameTick&) {}},
               record);
    CHECK(due.back() == 100s + frame_time({60, 1}, 599));
    CHECK(record.frames == 600);
    CHECK(record.deadline_misses == 0);
    CHECK(record.frame.percentiles().min == 40ms);
}

TEST_CASE("Latency is the sample's age when the frame began and the time to the whole picture") {
    FakeClock clock;
    FrameRecord record;
    run_frames(settings(10), clock, clock,
               {{},
                [&](const FrameTick& tick) {
                    clock.pass(4ms);
                    DrawnFrame frame;
                    frame.stages[static_cast<std::size_t>(Stage::shade)] = 3ms;
                    if (tick.number % 2 == 0) frame.input_age = 7ms;
                    return frame;
                },
                [&](const FrameTick&) { clock.pass(2ms); }},
               record);
    CHECK(record.latency.count() == 5);
    CHECK(record.latency.percentiles().min == 11ms);
    CHECK(record.latency.percentiles().max == 11ms);
    CHECK(record.stages[static_cast<std::size_t>(Stage::shade)].percentiles().p50 == 3ms);
}

TEST_CASE("After the first frame the loop allocates nothing, with smoothing, overlay, hash and sinks that overflow") {
    class Snail : public display::FrameWriter {
      public:
        void write(const FrameImage&, std::uint64_t, const std::stop_token&) override {
            std::this_thread::sleep_for(30ms);
        }
        [[nodiscard]] bool usable_after_error() const override { return true; }
    };
    display::Channel channel(320, 200);
    const display::Overlay overlay(320, 200);
    display::Sink slow("test:", std::make_unique<Snail>(), {320, 200}, display::WhenFull::drop, 2);
    MotionSmoother smoother;
    host::HostState state;
    state.pose.emplace();
    std::vector<std::uint64_t> hashes;
    hashes.reserve(200);
    FrameRecord record;
    std::uint64_t after_first = 0, at_last = 0;
    MonotonicClock clock;
    std::atomic<bool> stop{false};
    FrameHooks hooks;
    hooks.stop = [&] { return stop.load(std::memory_order_relaxed); };
    hooks.draw = [&](const FrameTick& tick) {
        at_last = allocations;
        if (record.frames == 1) after_first = allocations;
        state.earlier = state.pose;
        state.pose->sequence = tick.number + 1;
        state.pose->arrival = tick.due;
        const auto pose = smoother.pose_at(state, tick.due);
        const FrameImage image = channel.image();
        for (int r = 0; r < image.height; ++r)
            image.row(r)[0] = static_cast<std::uint8_t>(tick.number + (pose ? 1U : 0U));
        overlay.lay_over(image, tick.number);
        return DrawnFrame{{}, 1ms};
    };
    hooks.hand_over = [&](const FrameTick& tick) {
        hashes.push_back(display::frame_hash(channel.image()));
        slow.hand_over(channel.image(), tick.number);
    };
    run_frames({{200, 1}, clock.now(), 100, std::nullopt}, clock, clock, hooks, record);
    CHECK(allocations > 0);
    CHECK(at_last == after_first);
    CHECK(record.frames == 100);
    CHECK(slow.close().dropped > 20);
    CHECK(hashes.size() == 100);
}

TEST_CASE("Two seconds at 60 Hz in real time keep their deadlines beside a slow sink and a bare timer") {
    class Snail : public display::FrameWriter {
      public:
        void write(const FrameImage&, std::uint64_t, const std::stop_token&) override {
            std::this_thread::sleep_for(100ms);
        }
        [[nodiscard]] bool usable_after_error() const override { return true; }
    };
    display::Picture picture(640, 360);
    display::Sink sink("test:", std::make_unique<Snail>(), {640, 360}, display::WhenFull::drop, 3);
    MonotonicClock clock;
    const Time start = clock.now() + 20ms;
    const RealTimeWish wish{};
    TimerWatcher watcher(start, {60, 1}, wish);
    FrameRecord record;
    std::vector<Time> started;
    started.reserve(120);
    run_frames({{60, 1}, start, std::nullopt, 2s}, clock, clock,
               {{},
                [&](const FrameTick& tick) {
                    started.push_back(tick.started);
                    std::this_thread::sleep_for(3ms);
                    return DrawnFrame{};
                },
                [&](const FrameTick& tick) { sink.hand_over(picture.image(), tick.number); }},
               record);
    watcher.stop();
    const display::SinkStatus status = sink.close();
    INFO("woke late by up to " << record.wake_late.percentiles().max.count() << " ns, the bare timer by "
                               << watcher.lateness().percentiles().max.count());
    // On a machine that is busy with other things a deadline may be missed; the count must then be right all the same.
    CHECK(record.frames + record.repeated_frames >= 120);
    CHECK(record.frames + record.repeated_frames <= 121);
    CHECK(record.frames > 60);
    CHECK(status.dropped > 60);
    CHECK(status.frames + status.dropped == record.frames);
    CHECK(record.hand_over.percentiles().p50 < 10ms);
    CHECK(watcher.lateness().count() > 60);
    CHECK(watcher.lateness().count() <= 122);
    for (const Time t : started) REQUIRE(t >= start);
    CHECK(started.back() - started.front() < 2s + 100ms);
}
