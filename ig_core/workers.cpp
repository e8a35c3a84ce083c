#include "ig_core/workers.h"

#include <pthread.h>
#include <sched.h>

#include <chrono>

namespace quadrig {
namespace {

/// Waits until `value` is no longer `old`. Before it sleeps it looks for about as long as being woken would take: less
/// than that passes between the stages of a frame, and between its workers' last blocks.
template <class T>
void wait_for_change(const std::atomic<T>& value, T old) {
    using Clock = std::chrono::steady_clock;
    for (const auto end = Clock::now() + std::chrono::microseconds(100);
         value.load(std::memory_order_relaxed) == old && Clock::now() < end;)
        std::this_thread::yield();
    value.wait(old, std::memory_order_acquire);
}

}  // namespace

Workers::Workers(int count) {
    for (int i = 1; i < count; ++i) threads_.emplace_back([this, i] { work(i); });
}

Workers::~Workers() {
    stop_ = true;
    generation_.fetch_add(1, std::memory_order_release);
    generation_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Workers::match_scheduling() {
    const int policy = sched_getscheduler(0);
    if (policy == policy_) return;
    policy_ = policy;
    sched_param parameter{};
    if (policy < 0 || sched_getparam(0, &parameter) != 0) return;
    for (std::thread& thread : threads_)
        pthread_setschedparam(thread.native_handle(), policy & ~SCHED_RESET_ON_FORK, &parameter);
}

void Workers::run(int blocks, const std::function<void(int, int)>& task) {
    match_scheduling();
    task_ = &task;
    done_.store(0, std::memory_order_relaxed);
    blocks_.store(static_cast<std::uint64_t>(blocks) << 32, std::memory_order_release);
    generation_.fetch_add(1, std::memory_order_release);
    generation_.notify_all();
    claim_blocks(0);
    for (int done = done_.load(std::memory_order_acquire); done != blocks; done = done_.load(std::memory_order_acquire))
        wait_for_change(done_, done);
}

void Workers::work(int worker) {
    std::uint32_t seen = 0;
    for (;;) {
        wait_for_change(generation_, seen);
        seen = generation_.load(std::memory_order_acquire);
        if (stop_) return;
        claim_blocks(worker);
    }
}

void Workers::claim_blocks(int worker) {
    for (;;) {
        const std::uint64_t claim = blocks_.fetch_add(1, std::memory_order_acquire);
        const int count = static_cast<int>(claim >> 32), block = static_cast<int>(claim & 0x7FFFFFFFU);
        if (block >= count) return;
        (*task_)(block, worker);
        if (done_.fetch_add(1, std::memory_order_acq_rel) + 1 == count) done_.notify_one();
    }
}

}  // namespace quadrig
