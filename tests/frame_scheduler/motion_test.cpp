#include "frame_scheduler/motion.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <vector>

using namespace quadrig;
using namespace quadrig::scheduler;
using namespace std::chrono_literals;
using quadrig::host::HostState;
using quadrig::host::PoseSample;

namespace {

double seconds(Time t) { return std::chrono::duration<double>(t).count(); }

/// A straight flight at a constant turn rate about the vertical, through north.
constexpr double kSpeed = 200.0;    // m/s, north-east
constexpr double kTurnRate = 20.0;  // degrees a second
ScenePose truth(Time host_time) {
    const double t = seconds(host_time);
    const double heading = std::fmod(350.0 + kTurnRate * t, 360.0);
    return {{{kSpeed * t * std::sqrt(0.5), kSpeed * t * std::sqrt(0.5), 1000.0}},
            eye_from_scene_rotation({{heading}, {3.0}, {25.0}})};
}

double along(const ScenePose& pose) { return (pose.position.metres.x + pose.position.metres.y) * std::sqrt(0.5); }

double angle_between(const glm::dmat3& a, const glm::dmat3& b) {
    const glm::dmat3 r = a * glm::transpose(b);
    const glm::dvec3 skew(r[1][2] - r[2][1], r[2][0] - r[0][2], r[0][1] - r[1][0]);
    return std::atan2(0.5 * glm::length(skew), 0.5 * (r[0][0] + r[1][1] + r[2][2] - 1.0)) * 180.0 / 3.14159265358979;
}

/// Samples at a steady period, each held up by 0 to 3 ms, one in a hundred by up to 70 ms with all that follow it
/// queued.
std::vector<PoseSample> flight(double hertz, Time length, bool time_stamps, std::uint32_t seed) {
    constexpr Time kClocksApart = -std::chrono::hours(7) + 123456789ns, kLeastDelay = 2ms;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<PoseSample> samples;
    Time last_arrival{};
    for (std::uint64_t n = 1;; ++n) {
        const Time sent(static_cast<std::int64_t>(1e9 * static_cast<double>(n) / hertz));
        if (sent > length) return samples;
        double jitter = 0.003 * unit(random);
        if (unit(random) < 0.01) jitter += 0.07 * unit(random);
        PoseSample sample;
        sample.pose = truth(sent);
        if (time_stamps) sample.source_time = sent + kClocksApart;
        sample.arrival = std::max(last_arrival, sent + kLeastDelay + Time(static_cast<std::int64_t>(1e9 * jitter)));
        sample.sequence = n;
        last_arrival = sample.arrival;
        samples.push_back(sample);
    }
}

/// Frames at 60 Hz over recorded samples, each with the newest that had arrived.
template <class Frame>
void play(const std::vector<PoseSample>& samples, MotionSmoother& smoother, Time length, Frame&& frame,
          bool smoothing = true) {
    HostState state;
    state.smoothing = smoothing;
    std::size_t next = 0;
    for (std::uint64_t k = 0; frame_time({60, 1}, k) < length; ++k) {
        const Time now = frame_time({60, 1}, k);
        for (; next < samples.size() && samples[next].arrival <= now; ++next) {
            state.earlier = state.pose;
            state.pose = samples[next];
        }
        const auto pose = smoother.pose_at(state, now);
        if (pose) frame(now, *pose);
    }
}

struct Roughness {
    double position = 0.0;  ///< m, rms along the track against the truth at a constant lag
    double angle = 0.0;     ///< degrees, rms
};

/// How far a drawn flight is from the true one, seen a constant time later. The first 2 s are for getting to know the
/// host.
Roughness roughness(double hertz, bool time_stamps, bool smoothing, std::uint32_t seed) {
    constexpr Time kLength = 30s;
    MotionSmoother smoother;
    std::vector<std::pair<Time, ScenePose>> drawn;
    play(
        flight(hertz, kLength, time_stamps, seed), smoother, kLength,
        [&](Time now, const ScenePose& pose) {
            if (now > 2s) drawn.emplace_back(now, pose);
        },
        smoothing);
    double lag = 0.0;
    for (const auto& [now, pose] : drawn) lag += seconds(now) - along(pose) / kSpeed;
    lag /= static_cast<double>(drawn.size());
    Roughness r;
    for (const auto& [now, pose] : drawn) {
        const ScenePose exact = truth(now - Time(static_cast<std::int64_t>(1e9 * lag)));
        r.position += std::pow(along(pose) - along(exact), 2);
        r.angle += std::pow(angle_between(pose.eye_from_scene, exact.eye_from_scene), 2);
    }
    return {std::sqrt(r.position / static_cast<double>(drawn.size())),
            std::sqrt(r.angle / static_cast<double>(drawn.size()))};
}

PoseSample sample_at(Time t, std::uint64_t sequence, const ScenePose& pose) {
    PoseSample sample;
    sample.pose = pose;
    sample.source_time = sample.arrival = t;
    sample.sequence = sequence;
    return sample;
}

}  // namespace

TEST_CASE("A steady flight over a jittery network is drawn smoothly where the host stamps its samples") {
    const std::uint32_t seed = std::random_device{}();
    for (const double hertz : {10.0, 50.0, 60.0, 125.0}) {
        const Roughness raw = roughness(hertz, true, false, seed), smooth = roughness(hertz, true, true, seed);
        INFO("seed " << seed << ", host at " << hertz << " Hz: raw " << raw.position << " m " << raw.angle
                     << " deg, smooth " << smooth.position << " m " << smooth.angle << " deg");
        CHECK(smooth.position < 0.05);
        CHECK(smooth.angle < 0.01);
        CHECK(smooth.position < raw.position / 20.0);
        CHECK(smooth.angle < raw.angle / 20.0);
    }
}

TEST_CASE("A steady flight is drawn much more smoothly than it came where the host has no time stamps") {
    const std::uint32_t seed = std::random_device{}();
    for (const double hertz : {10.0, 50.0, 60.0}) {
        const Roughness raw = roughness(hertz, false, false, seed), smooth = roughness(hertz, false, true, seed);
        INFO("seed " << seed << ", host at " << hertz << " Hz: raw " << raw.position << " m, smooth " << smooth.position
                     << " m");
        CHECK(smooth.position < 0.2);
        CHECK(smooth.position < raw.position / 5.0);
    }
}

TEST_CASE("Two channels fed alike draw alike, bit for bit") {
    const auto samples = flight(60.0, 10s, true, 7);
    std::vector<glm::dvec3> drawn[2];
    for (auto& channel : drawn) {
        MotionSmoother smoother;
        play(samples, smoother, 10s, [&](Time, const ScenePose& pose) { channel.push_back(pose.position.metres); });
    }
    CHECK(drawn[0].size() > 550);
    CHECK(drawn[0] == drawn[1]);
}

TEST_CASE("A pose between two is GLM's slerp of them and the point on the line, also beyond them") {
    const std::uint32_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> angle(-180.0, 180.0), part(-1.0, 2.0);
    for (int i = 0; i < 2000; ++i) {
        const Attitude a{{angle(random)}, {angle(random) / 2}, {angle(random)}};
        const double spread =
            i % 4 == 0 ? 1e-7 : 0.3;  // small turns: beyond the end points slerp is still the short way
        const Attitude b{
            {a.heading.value + spread * angle(random)}, {a.pitch.value}, {a.roll.value + spread * angle(random)}};
        const ScenePose from{{{1e4, -2e4, 300}}, eye_from_scene_rotation(a)},
            to{{{1e4 + 7, -2e4 - 5, 303}}, eye_from_scene_rotation(b)};
        const double p = part(random);
        const ScenePose pose = pose_between(from, 1s, to, 3s, 1s + Time(static_cast<std::int64_t>(p * 2e9)));
        const glm::dmat3 expected = glm::mat3_cast(
            glm::normalize(glm::slerp(glm::quat_cast(from.eye_from_scene), glm::quat_cast(to.eye_from_scene), p)));
        CHECK(angle_between(pose.eye_from_scene, expected) < 1e-5);
        CHECK(glm::distance(pose.position.metres, from.position.metres + p * glm::dvec3(7, -5, 3)) < 1e-7);
        const glm::dmat3 unit = pose.eye_from_scene * glm::transpose(pose.eye_from_scene);
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) REQUIRE(std::abs(unit[c][r] - (c == r ? 1.0 : 0.0)) < 1e-12);
    }
}

TEST_CASE("Half way between headings 350 and 10 is north, not south") {
    const ScenePose a{{}, eye_from_scene_rotation({{350.0}, {}, {}})}, b{{}, eye_from_scene_rotation({{10.0}, {}, {}})};
    const double heading = attitude_of(pose_between(a, 0s, b, 1s, 500ms).eye_from_scene).heading.value;
    CHECK(std::min(heading, 360.0 - heading) < 1e-9);
}

TEST_CASE("A jump in position and a long gap are shown as they came, not smoothed") {
    const ScenePose here{{{0, 0, 100}}, glm::dmat3(1.0)}, near{{{2, 0, 100}}, glm::dmat3(1.0)},
        far{{{5000, 0, 100}}, glm::dmat3(1.0)};
    HostState state;
    state.earlier = sample_at(1000ms, 1, here);
    state.pose = sample_at(1016ms, 2, near);
    CHECK(MotionSmoother().pose_at(state, 1028ms)->position.metres.x == Approx(1.0));  // 20 ms behind: half way
    state.pose = sample_at(1016ms, 2, far);
    CHECK(MotionSmoother().pose_at(state, 1028ms)->position.metres.x == 5000.0);
    state.pose = sample_at(2001ms, 2, near);
    CHECK(MotionSmoother().pose_at(state, 1500ms)->position.metres.x == 2.0);
    state.pose = sample_at(2000ms, 2, near);
    CHECK(MotionSmoother().pose_at(state, 1520ms)->position.metres.x == Approx(1.0));
}

TEST_CASE("When the host falls silent the picture moves on for 100 ms after the next sample was due, then holds") {
    HostState state;
    state.earlier = sample_at(1000ms, 1, {{{0, 0, 0}}, glm::dmat3(1.0)});
    state.pose = sample_at(1010ms, 2, {{{1, 0, 0}}, glm::dmat3(1.0)});
    MotionSmoother smoother;
    CHECK(smoother.pose_at(state, 1030ms)->position.metres.x == Approx(1.0));
    CHECK(smoother.pose_at(state, 1080ms)->position.metres.x == Approx(6.0));
    CHECK(smoother.pose_at(state, 1140ms)->position.metres.x == Approx(12.0));
    CHECK(smoother.pose_at(state, 5000ms)->position.metres.x == Approx(12.0));
}

TEST_CASE("Without a pose there is none, without smoothing or a second pose the newest is shown") {
    HostState state;
    MotionSmoother smoother;
    CHECK_FALSE(smoother.pose_at(state, 1s));
    state.pose = sample_at(1010ms, 2, {{{1, 0, 0}}, glm::dmat3(1.0)});
    CHECK(smoother.pose_at(state, 2s)->position.metres.x == 1.0);
    state.earlier = sample_at(1000ms, 1, {{{0, 0, 0}}, glm::dmat3(1.0)});
    state.smoothing = false;
    CHECK(MotionSmoother().pose_at(state, 2s)->position.metres.x == 1.0);
    state.smoothing = true;
    CHECK(MotionSmoother().pose_at(state, 2s)->position.metres.x == Approx(12.0));
}

TEST_CASE("A host that starts its clock anew is followed at once") {
    MotionSmoother smoother;
    double worst = 0.0;
    auto samples = flight(60.0, 10s, true, 3);
    for (std::size_t i = 300; i < samples.size(); ++i) samples[i].source_time = *samples[i].source_time + 3h;
    play(samples, smoother, 10s, [&](Time now, const ScenePose& pose) {
        if (now > 2s) worst = std::max(worst, std::abs(along(pose) - along(truth(now - 22ms))));
    });
    CHECK(worst < 0.1 * kSpeed);
}

TEST_CASE("The least delay is that of the last 4 to 5 seconds") {
    LeastDelay delay;
    CHECK_FALSE(delay.least());
    delay.observe(500ms, 7ms);
    delay.observe(700ms, 3ms);
    delay.observe(900ms, 9ms);
    CHECK(delay.least() == Time(3ms));
    for (int s = 1; s <= 4; ++s) delay.observe(std::chrono::milliseconds(1000 * s + 10), 20ms);
    CHECK(delay.least() == Time(3ms));
    delay.observe(5010ms, 15ms);
    CHECK(delay.least() == Time(15ms));
    delay.observe(60s, 40ms);
    CHECK(delay.least() == Time(40ms));
}

TEST_CASE(
    "Arrivals of a steady host are laid on its own grid, and a burst does not move it by more than a millisecond") {
    ArrivalGrid grid;
    for (std::uint64_t n = 1; n <= 600; ++n) {
        const Time sent = 20ms * static_cast<std::int64_t>(n);
        Time arrival = sent;
        if (n >= 500 && n < 504) arrival = 504 * 20ms;  // held up by up to 80 ms, then all at once
        grid.observe(n, arrival);
        if (sent <= 500ms) CHECK_FALSE(grid.time_of(n));
        if (n < 30) continue;
        REQUIRE(grid.time_of(n));
        REQUIRE(std::chrono::abs(*grid.time_of(n) - sent) < 1ms);
        REQUIRE(std::chrono::abs(*grid.time_of(n) - *grid.time_of(n - 1) - 20ms) < 1ms);
    }
    grid.observe(601, 14s);  // a pause of the host: a new grid
    CHECK_FALSE(grid.time_of(601));
}

TEST_CASE("A sample lost on the way, which nobody counts, puts the grid right again without a jump") {
    ArrivalGrid grid;
    Time before{};
    for (std::uint64_t n = 1; n <= 1000; ++n) {
        const Time arrival = 20ms * static_cast<std::int64_t>(n < 400 ? n : n + 1);
        grid.observe(n, arrival);
        if (n < 100) continue;
        const Time time = *grid.time_of(n);
        REQUIRE(time <= arrival + 5ms);
        REQUIRE(time >= arrival - 20ms);
        if (n > 900) REQUIRE(std::chrono::abs(time - arrival) < 200us);
        if (n > 100) REQUIRE(std::chrono::abs(time - before - 20ms) < 1ms);
        before = time;
    }
}

TEST_CASE(
    "An ownship with rates goes on by them after its newest sample, smoothly, until another comes or the host is "
    "gone") {
    HostState state;
    state.earlier = sample_at(1000ms, 1, {{{0, 0, 0}}, glm::dmat3(1.0)});
    state.pose = sample_at(1100ms, 2, {{{10, 0, 0}}, glm::dmat3(1.0)});
    host::Entity& own = state.entities.push_back({});
    own.placed = own.active = true;
    own.pose = state.pose->pose;
    own.since = state.pose->arrival;
    own.rates.velocity = {100.0, 0.0, 0.0};
    own.rates.own_axes = true;
    MotionSmoother smoother;
    const auto x = [&](Time at) { return smoother.pose_at(state, at)->position.metres.x; };
    CHECK(x(1070ms) == Approx(5.0));
    CHECK(x(1120ms) == Approx(10.0));
    CHECK(x(1121ms) == Approx(10.1));
    CHECK(x(9120ms) == Approx(810.0));
    state.newest_arrival = 1100ms;
    CHECK(x(2119ms) == Approx(109.9));
    for (const Time later : {2120ms, 2500ms, 3600'000ms}) CHECK(x(later) == Approx(110.0));
    state.silence = 3s;
    CHECK(x(9120ms) == Approx(310.0));
    state.newest_arrival = 9s;  // it is there again
    CHECK(x(9120ms) == Approx(810.0));
    state.smoothing = false;
    CHECK(x(1200ms) == Approx(20.0));
    CHECK(x(13s) == Approx(1100.0));
    own.rates = {};
    CHECK(x(1200ms) == 10.0);
}
