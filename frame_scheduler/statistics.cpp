#include "frame_scheduler/statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace quadrig::scheduler {

namespace {

constexpr int kOctaveBits = 10;
constexpr std::int64_t kBucketsPerOctave = 1 << kOctaveBits;
constexpr int kLargestBits = 42;
constexpr std::int64_t kLargest = (std::int64_t{1} << kLargestBits) - 1;
constexpr std::size_t kBucketCount = (kLargestBits - kOctaveBits + 1) * kBucketsPerOctave;

/// Times below 2 * kBucketsPerOctave have a bucket each; above, the leading kOctaveBits + 1 bits choose it.
std::size_t bucket_of(std::int64_t time) {
    const int bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(time)));
    const int shift = std::max(0, bits - kOctaveBits - 1);
    return static_cast<std::size_t>(shift * kBucketsPerOctave + (time >> shift));
}

std::int64_t middle_of(std::size_t bucket) {
    const auto index = static_cast<std::int64_t>(bucket);
    const std::int64_t shift = std::max<std::int64_t>(0, index / kBucketsPerOctave - 1);
    return ((index - shift * kBucketsPerOctave) << shift) + (std::int64_t{1} << shift) / 2;
}

}  // namespace

Distribution::Distribution() : buckets_(kBucketCount) {}

void Distribution::record(std::chrono::nanoseconds time) {
    const std::int64_t t = std::clamp<std::int64_t>(time.count(), 0, kLargest);
    min_ = count_ == 0 ? t : std::min(min_, t);
    max_ = std::max(max_, t);
    ++count_;
    ++buckets_[bucket_of(t)];
}

std::chrono::nanoseconds Distribution::percentile(double p) const {
    if (count_ == 0) return {};
    // In whole numbers: 99.9 % of 1000 is 999, not one more for want of a bit.
    const auto thousandths = static_cast<std::uint64_t>(std::llround(p * 1000.0));
    const std::uint64_t rank = (thousandths * count_ + 99'999) / 100'000;
    if (rank <= 1) return std::chrono::nanoseconds(min_);
    if (rank >= count_) return std::chrono::nanoseconds(max_);
    std::uint64_t seen = 0;
    std::size_t bucket = bucket_of(min_);
    while ((seen += buckets_[bucket]) < rank) ++bucket;
    return std::chrono::nanoseconds(std::clamp(middle_of(bucket), min_, max_));
}

Percentiles Distribution::percentiles() const {
    return {percentile(0), percentile(50), percentile(90), percentile(99), percentile(99.9), percentile(100)};
}

}  // namespace quadrig::scheduler
