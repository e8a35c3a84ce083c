#include "frame_scheduler/sample_clock.h"

#include <algorithm>
#include <cmath>

namespace quadrig::scheduler {

void LeastDelay::observe(Time arrival, Time delay) {
    const std::int64_t bucket = arrival / kBucket;
    const auto slot = [](std::int64_t b) { return static_cast<std::size_t>(b) % kBuckets; };
    constexpr auto kCount = static_cast<std::int64_t>(kBuckets);
    if (newest_bucket_ < 0 || bucket >= newest_bucket_ + kCount) {
        least_.fill(Time::max());
        newest_bucket_ = bucket;
    }
    while (newest_bucket_ < bucket) least_[slot(++newest_bucket_)] = Time::max();
    // An arrival out of order belongs to the newest bucket there is.
    Time& least = least_[slot(newest_bucket_)];
    least = std::min(least, delay);
}

std::optional<Time> LeastDelay::least() const {
    if (newest_bucket_ < 0) return std::nullopt;
    return *std::min_element(least_.begin(), least_.end());
}

void ArrivalGrid::observe(std::uint64_t sequence, Time arrival) {
    const Point next{static_cast<std::int64_t>(sequence), arrival};
    const bool goes_on = count_ > 0 && next.sequence > point(count_ - 1).sequence;
    const Time expected = count_ < 2 ? point(0).arrival : on_line(next.sequence);
    if (!goes_on || std::chrono::abs(arrival - expected) > kLost) count_ = 0;
    if (count_ == kWindow) {
        oldest_ = (oldest_ + 1) % kWindow;
        --count_;
    }
    const bool was_settled = settled();
    points_[(oldest_ + count_++) % kWindow] = next;
    if (count_ < 2) return;
    fit();
    const Time move = expected + held_back_ - on_line(next.sequence);
    const double yield = std::max(kYield, 3.0 / static_cast<double>(count_));
    held_back_ = was_settled ? Time(std::llround((1.0 - yield) * static_cast<double>(move.count()))) : Time{};
}

bool ArrivalGrid::settled() const { return count_ >= 2 && point(count_ - 1).arrival - point(0).arrival >= kSettling; }

void ArrivalGrid::fit() {
    // Andrew's monotone chain, lower half; the points come sorted.
    std::array<Point, kWindow> hull;
    std::size_t corners = 0;
    std::int64_t sum = 0;
    const auto turns_down = [](const Point& a, const Point& b, const Point& c) {
        return (c.arrival - b.arrival).count() * (b.sequence - a.sequence) <=
               (b.arrival - a.arrival).count() * (c.sequence - b.sequence);
    };
    for (std::size_t i = 0; i < count_; ++i) {
        const Point& next = point(i);
        while (corners >= 2 && turns_down(hull[corners - 2], hull[corners - 1], next)) --corners;
        hull[corners++] = next;
        sum += next.sequence;
    }
    const std::int64_t mean = sum / static_cast<std::int64_t>(count_);
    std::size_t end = 1;
    while (end + 1 < corners && hull[end].sequence <= mean) ++end;
    line_begin_ = hull[end - 1];
    line_end_ = hull[end];
}

Time ArrivalGrid::on_line(std::int64_t sequence) const {
    const double slope = static_cast<double>((line_end_.arrival - line_begin_.arrival).count()) /
                         static_cast<double>(line_end_.sequence - line_begin_.sequence);
    return line_end_.arrival + Time(std::llround(slope * static_cast<double>(sequence - line_end_.sequence)));
}

std::optional<Time> ArrivalGrid::time_of(std::uint64_t sequence) const {
    if (!settled()) return std::nullopt;
    return on_line(static_cast<std::int64_t>(sequence)) + held_back_;
}

void SampleClock::observe(const host::PoseSample& sample) {
    if (sample.sequence == sequence_) return;
    sequence_ = sample.sequence;
    grid_.observe(sample.sequence, sample.arrival);
    if (!sample.source_time) return;
    const Time delay = sample.arrival - *sample.source_time;
    const std::optional<Time> least = delay_.least();
    if (least && std::chrono::abs(delay - *least) > kClockSet) delay_.restart();
    delay_.observe(sample.arrival, delay);
}

void SampleClock::observe(const host::HostState& state) {
    if (!state.pose || state.pose->sequence == sequence_) return;
    if (state.earlier && state.earlier->sequence > sequence_) observe(*state.earlier);
    observe(*state.pose);
}

std::optional<SampleClock::PairTimes> SampleClock::times(const host::HostState& state) const {
    if (!state.pose || !state.earlier) return std::nullopt;
    std::optional<Time> earlier, newest;
    if (state.pose->source_time && state.earlier->source_time) {
        const std::optional<Time> offset = delay_.least();
        if (offset) earlier = *state.earlier->source_time + *offset, newest = *state.pose->source_time + *offset;
    } else {
        earlier = grid_.time_of(state.earlier->sequence), newest = grid_.time_of(state.pose->sequence);
    }
    if (!earlier || !newest || *newest <= *earlier) return std::nullopt;
    return PairTimes{*earlier, *newest};
}

}  // namespace quadrig::scheduler
