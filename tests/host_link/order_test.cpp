// Frame numbers and time stamps: what is new, what came late, what began anew.
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "host_link/frame_order.h"
#include "host_link/source_clock.h"

using namespace quadrig::host;
using namespace std::chrono_literals;

namespace {

constexpr Time kNow{};

/// A message's fingerprint, the same for the same frame of the same run of the host.
std::uint64_t print(std::uint32_t frame, std::uint64_t run = 0) { return (run << 32) + frame + 1; }

}  // namespace

TEST_CASE("Frames in sequence are new, gaps are lost, repeats are duplicates") {
    FrameOrder order;
    CHECK(order.arrive(10, print(10), kNow) == Arrival::next);
    CHECK(order.arrive(11, print(11), kNow) == Arrival::next);
    CHECK(order.arrive(11, print(11), kNow) == Arrival::duplicate);
    CHECK(order.arrive(14, print(14), kNow) == Arrival::next);
    CHECK(order.lost() == 2);
    CHECK(order.arrive(13, print(13), kNow) == Arrival::late);
    CHECK(order.lost() == 1);
    CHECK(order.arrive(13, print(13), kNow) == Arrival::duplicate);
    CHECK(order.arrive(10, print(10), kNow) == Arrival::duplicate);
    CHECK(order.lost() == 1);
}

TEST_CASE("A frame before the first one seen is late but was never lost") {
    FrameOrder order;
    order.arrive(1, print(1), kNow);
    CHECK(order.arrive(0, print(0), kNow) == Arrival::late);
    CHECK(order.lost() == 0);
}

TEST_CASE("Frame numbers wrap") {
    FrameOrder order;
    order.arrive(0xFFFFFFFE, print(1), kNow);
    CHECK(order.arrive(0xFFFFFFFF, print(2), kNow) == Arrival::next);
    CHECK(order.arrive(0, print(3), kNow) == Arrival::next);
    CHECK(order.arrive(2, print(4), kNow) == Arrival::next);
    CHECK(order.lost() == 1);
    CHECK(order.arrive(1, print(5), kNow) == Arrival::late);
}

TEST_CASE("A host that counts from zero again is heard at once, after a long run and after a short one") {
    for (const std::uint32_t length : {5000U, 30U, 1U}) {
        INFO("after " << length << " frames");
        FrameOrder order;
        for (std::uint32_t f = 0; f < length; ++f) order.arrive(f, print(f), kNow);
        CHECK(order.arrive(0, print(0, 1), kNow) == Arrival::restart);
        CHECK(order.arrive(1, print(1, 1), kNow) == Arrival::next);
        CHECK(order.lost() == 0);
    }
}

TEST_CASE("After a second without a newer message, one that does not go on is a host that counts anew") {
    for (const std::uint32_t again : {30U, 40U, 59U, 10U}) {
        INFO("from " << again);
        FrameOrder order;
        for (std::uint32_t f = 30; f < 60; ++f) order.arrive(f, print(f), kNow);
        // Until then the network may have held it back, or sent it twice.
        CHECK(order.arrive(again, print(again), kNow + 999ms) == (again < 30 ? Arrival::late : Arrival::duplicate));
        CHECK(order.arrive(again, print(again), kNow + 1000ms) == Arrival::restart);
        CHECK(order.arrive(again + 1, print(again + 1), kNow + 1016ms) == Arrival::next);
    }
    FrameOrder order;
    order.arrive(5, print(5), kNow);
    CHECK(order.arrive(6, print(6), kNow + 60s) == Arrival::next);
}

TEST_CASE("A jump far ahead is a new count, not a thousand losses") {
    FrameOrder order;
    order.arrive(0, print(0), kNow);
    CHECK(order.arrive(1U << 20, print(1), kNow) == Arrival::restart);
    CHECK(order.lost() == 0);
    CHECK(order.arrive((1U << 20) + 1000, print(2), kNow) == Arrival::next);
    CHECK(order.lost() == 999);
}

TEST_CASE("Over a network that loses, doubles and reorders, every count is what the network did") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (int run = 0; run < 200; ++run) {
        FrameOrder order;
        std::vector<std::uint32_t> wire{0};
        std::uint64_t duplicates = 0;
        for (std::uint32_t f = 1; f < 600; ++f) {
            if (random() % 10 == 0) continue;
            wire.push_back(f);
            if (random() % 20 == 0) {
                wire.push_back(f);
                ++duplicates;
            }
        }
        for (std::size_t i = 1; i + 6 < wire.size(); i += 7)
            if (random() % 2 == 0)
                std::shuffle(wire.begin() + static_cast<int>(i), wire.begin() + static_cast<int>(i) + 6, random);
        std::uint64_t taken = 0, late = 0, doubled = 0;
        std::uint32_t newest = 0;
        std::set<std::uint32_t> different;
        for (const auto f : wire) {
            different.insert(f);
            switch (order.arrive(f, print(f), kNow)) {
                case Arrival::next:
                    REQUIRE((f > newest || taken == 0));
                    newest = f;
                    ++taken;
                    break;
                case Arrival::late:
                    ++late;
                    break;
                case Arrival::duplicate:
                    ++doubled;
                    break;
                case Arrival::restart:
                    FAIL("no host restarted");
            }
        }
        CHECK(doubled == duplicates);
        CHECK(taken + late == different.size());
        CHECK(order.lost() == newest + 1 - different.size());
    }
}

TEST_CASE("CIGI time stamps go on over their wrap after 11.9 hours") {
    TickClock clock(kCigiTick);
    CHECK(clock.read(0xFFFFFF00) == Time(0xFFFFFF00LL * 10000));
    CHECK(clock.read(0x00000100) == Time(0x100000100LL * 10000));
    CHECK_FALSE(clock.read(0x00000100).has_value());
    CHECK(clock.read(0x00000101) == Time(0x100000101LL * 10000));
}

TEST_CASE("An FDM counter is a clock only once it has advanced with every sample, in the power of ten it runs at") {
    for (const auto& [unit, per_frame] : {std::pair<Time, std::uint32_t>{1us, 16667}, {1ms, 17}, {10us, 1667}}) {
        FdmClock clock;
        std::optional<Time> last;
        for (std::uint32_t i = 0; i < 100; ++i) {
            const auto reading = clock.read(1000 + i * per_frame, i * 16667us);
            CHECK(reading.time.has_value() == (i > FdmClock::kLearn));
            if (last) CHECK(*reading.time - *last == per_frame * unit);
            last = reading.time;
        }
    }
}

TEST_CASE("A constant, and seconds that advance only now and then, are no clock") {
    FdmClock constant, seconds;
    for (std::uint32_t i = 0; i < 600; ++i) {
        CHECK_FALSE(constant.read(1234567890, i * 16667us).time.has_value());
        CHECK_FALSE(seconds.read(1700000000 + i / 60, i * 16667us).time.has_value());
    }
}

TEST_CASE("A counter that runs at no power of ten of a second is no clock") {
    FdmClock clock;
    for (std::uint32_t i = 0; i < 100; ++i) CHECK_FALSE(clock.read(i * 5100, i * 16667us).time.has_value());
}

TEST_CASE("An FDM clock that steps back a little is out of order, far back a new flight") {
    FdmClock clock;
    std::uint32_t now = 10'000'000;
    Time arrival = 0us;
    for (int i = 0; i < 50; ++i) clock.read(now += 16667, arrival += 16667us);
    CHECK(clock.read(now - 20000, arrival += 1us).backwards);
    CHECK(clock.read(now += 16667, arrival += 16667us).time.has_value());
    const auto anew = clock.read(5, arrival += 16667us);
    CHECK_FALSE(anew.backwards);
    CHECK_FALSE(anew.time.has_value());
}
