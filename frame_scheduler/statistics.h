/// Percentiles of times, recorded in the frame loop at a constant cost and in constant memory, however long it runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace quadrig::scheduler {

/// Nearest-rank percentiles: p50 is the smallest recorded time that at least 50 % of all do not exceed. All 0 without
/// records. min and max are exact, the others within 1 part in 2000.
struct Percentiles {
    std::chrono::nanoseconds min{0}, p50{0}, p90{0}, p99{0}, p999{0}, max{0};
};

/// A histogram whose buckets grow with the time: exact below 2 us, then 1024 to an octave, up to 73 minutes (longer
/// times count as that long). The idea is that of Gil Tene's HdrHistogram. Allocates when made, never afterwards.
class Distribution {
  public:
    Distribution();
    /// Negative times count as 0.
    void record(std::chrono::nanoseconds time);
    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// The p-th percentile, p in 0..100 to a thousandth; 0 without records.
    [[nodiscard]] std::chrono::nanoseconds percentile(double p) const;
    [[nodiscard]] Percentiles percentiles() const;

  private:
    std::vector<std::uint32_t> buckets_;
    std::uint64_t count_ = 0;
    std::int64_t min_ = 0, max_ = 0;
};

}  // namespace quadrig::scheduler
