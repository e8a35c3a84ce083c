/// A team of threads for the stages of a frame: blocks of work claimed from an atomic counter, no locks, no task graph.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace quadrig {

class Workers {
  public:
    /// `count` >= 1 workers, the calling thread among them.
    explicit Workers(int count);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] int count() const { return static_cast<int>(threads_.size()) + 1; }

    /// Calls task(block, worker) for every block in 0..blocks-1, in any order, on all workers; returns when all are
    /// done. `task` must not throw. Workers run with the caller's scheduling policy and priority, as far as the system
    /// lets them: a frame is on time only if all of its threads are.
    void run(int blocks, const std::function<void(int block, int worker)>& task);

  private:
    void match_scheduling();
    void work(int worker);
    void claim_blocks(int worker);

    std::vector<std::thread> threads_;
    const std::function<void(int, int)>* task_ = nullptr;
    std::atomic<std::uint64_t> blocks_{0};  ///< how many in the upper half, the next one to be claimed in the lower
    std::atomic<int> done_{0};              ///< of the blocks; who wakes too late for any is not waited for
    std::atomic<std::uint32_t> generation_{0};
    std::atomic<bool> stop_{false};
    int policy_ = 0;  ///< the caller's at the last run; SCHED_OTHER
};

}  // namespace quadrig
