#include "ig_core/workers.h"

#include <sched.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

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
