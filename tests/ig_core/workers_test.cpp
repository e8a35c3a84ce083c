#include "ig_core/workers.h"

#include <sched.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <random>
#include <thread>
#include <vector>

using namespace quadrig;

TEST_CASE("workers take over the scheduling policy of the thread that renders") {
    Workers workers(3);
    std::thread renderer([&] {
        for (const int policy : {SCHED_OTHER, SCHED_BATCH, SCHED_OTHER}) {
            const sched_param parameter{};
            REQUIRE(sched_setscheduler(0, policy, &parameter) == 0);
            std::atomic<int> alike{0};
            workers.run(64, [&](int, int) {
                if (sched_getscheduler(0) == policy) ++alike;
                std::this_thread::yield();
            });
            CHECK(alike == 64);
        }
    });
    renderer.join();
}

TEST_CASE("every block of a run is done once when the run ends, whether its workers wake in time for it or not") {
    const unsigned seed = std::random_device{}();
    CAPTURE(seed);
    std::minstd_rand random(seed);
    Workers workers(4);
    for (int run = 0; run < 4000; ++run) {
        std::vector<int> times(random() % 9, 0);
        workers.run(static_cast<int>(times.size()), [&](int block, int worker) {
            // Not atomic: what a worker has written is there for the caller to read.
            times[static_cast<std::size_t>(block)] += worker < workers.count() ? 1 : 100;
        });
        REQUIRE(times == std::vector<int>(times.size(), 1));
        if (run % 50 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));  // they fall asleep
    }
}
