#include "ig_core/workers.h"

#include <pthread.h>
#include <sched.h>

namespace quadrig {

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
    blocks_ = blocks;
    next_block_.store(0, std::memory_order_relaxed);
    busy_.store(static_cast<int>(threads_.size()), std::memory_order_relaxed);
    generation_.fetch_add(1, std::memory_order_release);
    generation_.notify_all();
    claim_blocks(0);
    for (int busy = busy_.load(std::memory_order_acquire); busy != 0; busy = busy_.load(std::memory_order_acquire))
        busy_.wait(busy, std::memory_order_acquire);
}

void Workers::work(int worker) {
    std::uint32_t seen = 0;
    for (;;) {
        generation_.wait(seen, std::memory_order_acquire);
        seen = generation_.load(std::memory_order_acquire);
        if (stop_) return;
        claim_blocks(worker);
        if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
    }
}

void Workers::claim_blocks(int worker) {
    for (int block = next_block_.fetch_add(1, std::memory_order_relaxed); block < blocks_;
         block = next_block_.fetch_add(1, std::memory_order_relaxed))
        (*task_)(block, worker);
}

}  // namespace quadrig
