#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <random>
#include <set>
#include <utility>

#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

// Counts what this thread takes from the heap while asked to.
namespace {
thread_local bool counting_allocations = false;
thread_local std::size_t allocations = 0;
}  // namespace
// Not inlined: GCC would otherwise compare the halves of a pair that it sees through.
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (counting_allocations) ++allocations;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
// The sanitizer's own one would not come through here, and its blocks would.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    if (counting_allocations) ++allocations;
    return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace {

SessionOptions at_home(Protocol protocol = Protocol::cigi) {
    SessionOptions options;
    options.protocol = protocol;
    options.scene_origin = {{47.26}, {11.34}, 500.0};
    return options;
}

Bytes frame(std::uint32_t number, double latitude = 47.26, ByteOrder order = ByteOrder::little) {
    return message(order, ig_control(number, number * 1667), ownship(latitude));
}

/// What JSBSim sends as cur_time where its output is not set up to send the time.
constexpr std::uint32_t kNoTime = 1234567890;

Bytes fdm(double latitude_degrees, std::uint32_t cur_time = kNoTime, std::uint32_t version = 24) {
    flightgear::NetFdm packet;
    packet.version = version;
    packet.latitude = Degrees{latitude_degrees}.radians();
    packet.longitude = Degrees{11.34}.radians();
    packet.altitude = 800.0;
    packet.cur_time = cur_time;
    Bytes bytes(flightgear::kSize25);
    bytes.resize(flightgear::encode(packet, bytes));
    return bytes;
}

}  // namespace

TEST_CASE("A pose of the ownship becomes the newest state, the one before it is kept") {
    Session session(at_home());
    CHECK_FALSE(session.state().pose.has_value());
    auto entity = ownship(47.27, 11.34, 1500.0);
    entity.yaw = -90.0F;
    entity.pitch = 3.0F;
    entity.roll = -15.0F;
    CHECK(session.accept(message(ByteOrder::big, ig_control(5, 100), entity), 7ms) == Verdict::pose);
    const PoseSample first = session.state().pose.value();
    CHECK(first.position.latitude.value == 47.27);
    CHECK(first.position.altitude == 1500.0);
    CHECK(first.attitude.heading.value == 270.0);
    CHECK(first.attitude.pitch.value == 3.0);
    CHECK(first.attitude.roll.value == -15.0);
    CHECK(first.source_time == 1ms);
    CHECK(first.arrival == 7ms);
    CHECK(first.sequence == 1);
    CHECK(first.pose.position.metres.y == Approx(1112.0).margin(2.0));
    CHECK_FALSE(session.state().earlier.has_value());
    CHECK(session.accept(frame(6), 23ms) == Verdict::pose);
    CHECK(session.state().earlier->arrival == 7ms);
    CHECK(session.state().pose->sequence == 2);
    CHECK(session.state().host_frame == 6U);
    CHECK(session.state().newest_arrival == Time(23ms));
}

TEST_CASE("A heading is told in 0..360 without 360, and without a sign where it is 0") {
    Session session(at_home());
    std::uint32_t number = 0;
    for (const auto& [sent, told] : {std::pair{-360.0F, 0.0},
                                     {360.0F, 0.0},
                                     {-0.0F, 0.0},
                                     {-1e-20F, 0.0},
                                     {-1e-45F, 0.0},
                                     {-90.0F, 270.0},
                                     {359.5F, 359.5},
                                     {-0.5F, 359.5}}) {
        auto entity = ownship();
        entity.yaw = sent;
        INFO("yaw " << sent);
        CHECK(session.accept(message(ByteOrder::little, ig_control(number, number * 1667), entity), 0ms) ==
              Verdict::pose);
        ++number;
        const double heading = session.state().pose->attitude.heading.value;
        CHECK(heading == told);
        CHECK_FALSE(std::signbit(heading));
    }
}

TEST_CASE("A link's altitude offset moves the datum") {
    auto options = at_home(Protocol::flightgear_fdm);
    options.altitude_offset = 48.0;
    Session session(options);
    session.accept(fdm(47.26), 0ms);
    CHECK(session.state().pose->position.altitude == 848.0);
    CHECK(session.state().pose->pose.position.metres.z == Approx(348.0).margin(1e-6));
}

TEST_CASE("Late and doubled messages do not move the picture") {
    Session session(at_home());
    session.accept(frame(1, 47.1), 1ms);
    session.accept(frame(2, 47.2), 2ms);
    session.accept(frame(5, 47.5), 3ms);
    CHECK(session.accept(frame(4, 47.4), 4ms) == Verdict::reordered);
    CHECK(session.accept(frame(5, 47.5), 5ms) == Verdict::duplicate);
    CHECK(session.state().pose->position.latitude.value == 47.5);
    CHECK(session.statistics().lost == 1);
    CHECK(session.statistics().reordered == 1);
    CHECK(session.statistics().duplicate == 1);
    CHECK(session.statistics().frames == 3);
    CHECK(session.statistics().datagrams == 5);
    CHECK(session.statistics().rejected_in_all() == 0);
}

namespace {

/// Frame numbers as a network delivers them that loses, doubles and overtakes each with that probability.
std::vector<std::uint32_t> through_network(std::uint32_t frames, double probability, std::mt19937_64& random) {
    std::bernoulli_distribution happens(probability);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> arrivals;  // by ten times their place
    for (std::uint32_t f = 0; f < frames; ++f) {
        const std::uint64_t delay = happens(random) ? 10 * (1 + random() % 6) + 5 : 0;
        if (happens(random)) continue;
        arrivals.emplace_back(10 * f + delay, f);
        if (happens(random)) arrivals.emplace_back(10 * (f + random() % 6) + delay + 1, f);
    }
    std::ranges::sort(arrivals);
    std::vector<std::uint32_t> wire;
    for (const auto& [place, f] : arrivals) wire.push_back(f);
    return wire;
}

}  // namespace

TEST_CASE("Over a bad network, and a host that begins anew, the picture's host time never goes back and all is named") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (const double probability : {0.01, 0.1}) {
        INFO("probability " << probability);
        Session session(at_home());
        std::uint64_t taken = 0, lost = 0, duplicate = 0, reordered = 0;
        Time now{};
        for (const double latitude : {47.1, 47.2, 47.3}) {
            // Straight from the definitions: what was seen of this life of the host, and what was newest.
            std::set<std::uint32_t> seen;
            std::optional<std::uint32_t> first, newest;
            for (const std::uint32_t f :
                 through_network(500 + static_cast<std::uint32_t>(random() % 2000), probability, random)) {
                session.accept(frame(f, latitude), now += 16ms);
                if (!seen.insert(f).second) {
                    ++duplicate;
                } else if (newest && f < *newest) {
                    ++reordered;
                } else {
                    ++taken;
                    if (!newest) REQUIRE_FALSE(session.state().earlier.has_value());
                    newest = f;
                }
                if (!first) first = f;
                REQUIRE(session.state().host_frame == newest);
                REQUIRE(session.state().pose->source_time == Time(*newest * 1667LL * 10us));
                REQUIRE(session.state().pose->position.latitude.value == latitude);
                if (session.state().earlier)
                    REQUIRE(session.state().earlier->source_time < session.state().pose->source_time);
            }
            for (std::uint32_t f = *first; f < *newest; ++f) lost += seen.contains(f) ? 0 : 1;
        }
        CHECK(session.statistics().frames == taken);
        CHECK(session.statistics().lost == lost);
        CHECK(session.statistics().duplicate == duplicate);
        CHECK(session.statistics().reordered == reordered);
        CHECK(session.statistics().restarts == 2);
        CHECK((lost > 0 && duplicate > 0 && reordered > 0));
    }
}

TEST_CASE("A host that dies and comes back with frame zero is followed at once, without motion between its two lives") {
    for (const std::uint32_t length : {3000U, 20U}) {
        Session session(at_home());
        for (std::uint32_t f = 0; f < length; ++f) session.accept(frame(f, 47.2), f * 16ms);
        CHECK(session.accept(frame(0, 47.9), 60s) == Verdict::pose);
        CHECK(session.state().pose->position.latitude.value == 47.9);
        CHECK(session.state().pose->source_time == Time(0));
        CHECK_FALSE(session.state().earlier.has_value());
        CHECK(session.accept(frame(1, 47.91), 61s) == Verdict::pose);
        CHECK(session.state().earlier->position.latitude.value == 47.9);
        CHECK(session.statistics().restarts == 1);
        CHECK(session.statistics().lost == 0);
    }
}

TEST_CASE("The picture keeps its last pose while a restarted host has sent none yet") {
    Session session(at_home());
    for (std::uint32_t f = 0; f < 500; ++f) session.accept(frame(f), f * 16ms);
    CHECK(session.accept(message(ByteOrder::little, ig_control(0)), 9s) == Verdict::no_pose);
    CHECK(session.state().pose.has_value());
}

TEST_CASE("Before 3.2 the frame counter is the image generator's own, and repeating it loses nothing") {
    Session session(at_home());
    cigi::IgControl old = ig_control(0);
    old.minor_version = 0;
    old.last_ig_frame.reset();
    old.timestamp_valid = false;
    for (int i = 0; i < 10; ++i)
        CHECK(session.accept(message(ByteOrder::big, old, ownship()), i * 16ms) == Verdict::pose);
    CHECK(session.statistics().frames == 10);
    CHECK(session.statistics().duplicate == 0);
    CHECK(session.state().smoothing);
    CHECK_FALSE(session.state().pose->source_time.has_value());
}

TEST_CASE("Smoothing is on only where a 3.3 host asks for it in both places") {
    for (const auto& [message_bit, entity_bit] :
         {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
        Session session(at_home());
        auto ig = ig_control(0);
        ig.smoothing = message_bit;
        auto entity = ownship();
        entity.smoothing = entity_bit;
        session.accept(message(ByteOrder::little, ig, entity), 0ms);
        CHECK(session.state().smoothing == (message_bit && entity_bit));
    }
    // Before 3.3 the bits were reserved.
    for (const bool could : {false, true}) {
        Session session(at_home());
        auto ig = ig_control(0);
        ig.minor_version = could ? 3 : 2;
        auto other = ownship();
        other.entity = 7;
        ig.smoothing = other.smoothing = true;
        session.accept(message(ByteOrder::little, ig, other), 0ms);
        CHECK(session.state().entities.find(7)->smoothing == could);
    }
}

TEST_CASE("Poses that are not finite or out of range are counted and not taken, in both protocols") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    Session session(at_home());
    session.accept(frame(0), 0ms);
    std::uint32_t number = 1;
    const auto refuse = [&](auto change) {
        auto entity = ownship();
        change(entity);
        INFO("message " << number);
        CHECK(session.accept(message(ByteOrder::little, ig_control(number), entity), 0ms) == Verdict::no_pose);
        CHECK(session.statistics().rejected_for(Reject::out_of_range) == number);
        ++number;
    };
    for (const double bad : {90.1, -90.1, nan, inf, -inf}) refuse([&](auto& e) { e.latitude = bad; });
    for (const double bad : {180.1, -180.1, nan, inf}) refuse([&](auto& e) { e.longitude = bad; });
    for (const double bad : {-12001.0, 1.1e8, nan, inf, -inf}) refuse([&](auto& e) { e.altitude = bad; });
    for (const double bad : {361.0, -361.0, nan, inf}) refuse([&](auto& e) { e.yaw = static_cast<float>(bad); });
    for (const double bad : {90.1, -90.1, nan}) refuse([&](auto& e) { e.pitch = static_cast<float>(bad); });
    for (const double bad : {361.0, nan}) refuse([&](auto& e) { e.roll = static_cast<float>(bad); });
    CHECK(session.state().pose->sequence == 1);
    CHECK(session.statistics().frames == 1);

    Session other(at_home(Protocol::flightgear_fdm));
    CHECK(other.accept(fdm(90.5), 0ms) == Verdict::rejected);
    CHECK(other.accept(fdm(nan), 0ms) == Verdict::rejected);
    CHECK(other.statistics().rejected_for(Reject::out_of_range) == 2);
    CHECK_FALSE(other.state().pose.has_value());
}

TEST_CASE("Rejected datagrams are counted by reason and change nothing") {
    Session session(at_home());
    session.accept(frame(0), 1ms);
    const Bytes cut = frame(1);
    CHECK(session.accept(std::span(cut).first(40), 2ms) == Verdict::rejected);
    CHECK(session.accept(message(ByteOrder::little, cigi::StartOfFrame{}), 2ms) == Verdict::rejected);
    CHECK(session.accept(fdm(47.0), 2ms) == Verdict::rejected);
    CHECK(rejected_by_reason(session.statistics()) ==
          NamedCounts{{"truncated", 1}, {"no_ig_control", 1}, {"start_of_frame", 1}});
    CHECK(session.statistics().packets[cigi::EntityControl::kId] == 1);
    CHECK(session.state().newest_arrival == Time(1ms));
    CHECK(session.accept(frame(1), 3ms) == Verdict::pose);
    CHECK(session.statistics().lost == 0);
}

TEST_CASE("An attached or a destroyed ownship gives no pose of its own") {
    Session session(at_home());
    auto entity = ownship();
    entity.attached = true;
    entity.parent = 5;
    entity.latitude = entity.longitude = entity.altitude = 0.0;
    CHECK(session.accept(message(ByteOrder::little, ig_control(0), entity), 0ms) == Verdict::no_pose);
    CHECK(session.statistics().rejected_in_all() == 0);
    entity.attached = false;
    entity.state = cigi::EntityState::destroyed;
    CHECK(session.accept(message(ByteOrder::little, ig_control(1), entity), 0ms) == Verdict::no_pose);
}

TEST_CASE("FDM time is the host's time only where it runs") {
    Session constant(at_home(Protocol::flightgear_fdm)), running(at_home(Protocol::flightgear_fdm));
    for (std::uint32_t i = 0; i < 60; ++i) {
        constant.accept(fdm(47.0 + i * 1e-4), i * 16667us);
        running.accept(fdm(47.0 + i * 1e-4, 1000000 + i * 16667, 25), i * 16667us);
    }
    CHECK_FALSE(constant.state().pose->source_time.has_value());
    REQUIRE(running.state().pose->source_time.has_value());
    CHECK(*running.state().pose->source_time - *running.state().earlier->source_time == 16667us);
    CHECK(running.accept(fdm(46.0, 1000000 + 58 * 16667, 25), 1s) == Verdict::reordered);
    CHECK(running.state().pose->position.latitude.value > 47.0);
    CHECK(packets_by_name(running.statistics()) == NamedCounts{{"net_fdm_25", 61}});
}

TEST_CASE("Long intervals between poses are counted as gaps") {
    Session session(at_home());
    const Time arrivals[] = {0ms, 16ms, 80ms, 96ms, 400ms, 450ms};
    for (std::uint32_t i = 0; i < 6; ++i) session.accept(frame(i), arrivals[i]);
    CHECK(session.statistics().gaps.count == 2);
    CHECK(session.statistics().gaps.longest == Time(304ms));
    CHECK(session.statistics().first_pose->arrival == Time(0));
    CHECK(session.statistics().last_pose->arrival == Time(450ms));
}

TEST_CASE("In steady state a datagram costs no allocation") {
    Session cigi(at_home()), flightgear(at_home(Protocol::flightgear_fdm));
    std::vector<Bytes> messages;
    for (std::uint32_t i = 0; i < 200; ++i)
        messages.push_back(message(ByteOrder::big, ig_control(i), ownship(), cigi::ViewControl{},
                                   cigi::AtmosphereControl{}, cigi::RateControl{.entity = 4, .x = 1.0F},
                                   cigi::WeatherControl{.layer = 1},
                                   cigi::ShortComponentControl{.component = 1, .component_class = 13},
                                   cigi::SensorControl{.on = true, .track_mode = 1},
                                   cigi::CollisionSegmentDefinition{.enable = true, .to = {1.0F, 0.0F, 0.0F}}) +
                           raw_packet(99, 8));
    const Bytes packet = fdm(47.0);
    allocations = 0;
    counting_allocations = true;
    for (const auto& m : messages) cigi.accept(m, 0ms);
    for (int i = 0; i < 200; ++i) flightgear.accept(packet, i * 1ms);
    counting_allocations = false;
    CHECK(allocations == 0);
    CHECK(cigi.statistics().frames == 200);
}

TEST_CASE("Random messages of every supported packet leave a state of finite numbers in range") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    Session session(at_home());
    for (std::uint32_t i = 0; i < 20000; ++i) {
        Bytes bytes = message(ByteOrder::little, ig_control(i), ownship(), cigi::ViewControl{}, cigi::ViewDefinition{},
                              cigi::CelestialSphereControl{}, cigi::AtmosphereControl{});
        for (std::size_t b = 24; b < bytes.size(); ++b)
            if (bytes[b] == std::byte{0} && random() % 3 == 0) bytes[b] = static_cast<std::byte>(random());
        if (random() % 2 == 0) bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        session.accept(bytes, i * 1ms);
        const HostState& s = session.state();
        if (s.pose) REQUIRE(std::abs(s.pose->position.latitude.value) <= 90.0);
        if (s.pose) REQUIRE(std::isfinite(glm::dot(s.pose->pose.position.metres, glm::dvec3(1.0))));
        if (s.visibility) REQUIRE(*s.visibility >= 1.0);
        if (s.window) REQUIRE(s.window->left.value < s.window->right.value);
        if (s.mount) REQUIRE(std::abs(s.mount->attitude.pitch.value) <= 90.0);
        if (s.utc) REQUIRE((s.utc->month >= 1 && s.utc->month <= 12 && s.utc->hour < 24));
    }
    CHECK(session.statistics().datagrams == 20000);
}
