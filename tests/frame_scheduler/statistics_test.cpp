#include "frame_scheduler/statistics.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

using namespace quadrig::scheduler;
using std::chrono::nanoseconds;

TEST_CASE("Percentiles are the nearest ranks of the sorted times within 1 part in 2000, extremes exact") {
    const std::uint32_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (const std::size_t count : {1U, 2U, 3U, 10U, 999U, 1000U, 1001U, 20000U}) {
        Distribution distribution;
        std::vector<std::int64_t> times;
        for (std::size_t i = 0; i < count; ++i) {
            // Spread evenly over the octaves, from nanoseconds to an hour.
            times.push_back(static_cast<std::int64_t>(random() >> (23 + random() % 41)));
            distribution.record(nanoseconds(times.back()));
        }
        std::sort(times.begin(), times.end());
        REQUIRE(distribution.count() == count);
        for (const double p : {0.0, 1.0, 25.0, 50.0, 90.0, 99.0, 99.9, 100.0}) {
            const auto per_mille = static_cast<std::size_t>(std::lround(p * 10.0));
            const std::size_t rank = std::max<std::size_t>(1, (per_mille * count + 999) / 1000);
            const auto exact = static_cast<double>(times[rank - 1]);
            const auto found = static_cast<double>(distribution.percentile(p).count());
            INFO("p" << p << " of " << count);
            CHECK(std::abs(found - exact) <= exact / 2000.0);
        }
        CHECK(distribution.percentiles().min.count() == times.front());
        CHECK(distribution.percentiles().max.count() == times.back());
    }
}

TEST_CASE("Short times are exact, negative ones count as 0, an empty distribution is all 0") {
    Distribution distribution;
    CHECK(distribution.percentiles().max == nanoseconds(0));
    CHECK(distribution.percentile(50) == nanoseconds(0));
    for (int t = 0; t < 2048; ++t) distribution.record(nanoseconds(t));
    CHECK(distribution.percentile(50) == nanoseconds(1023));
    CHECK(distribution.percentile(75) == nanoseconds(1535));
    distribution.record(nanoseconds(-5));
    CHECK(distribution.percentiles().min == nanoseconds(0));
    distribution.record(nanoseconds::max());
    CHECK(distribution.percentiles().max > std::chrono::hours(1));
}
