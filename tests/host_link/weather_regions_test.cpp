// Regions that have weather of their own: where they reach, and what a host may say of them.
#include <GeographicLib/LocalCartesian.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "host_link/geodesy.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

const GeodeticPosition kOrigin{{47.26}, {11.34}, 500.0};

struct RegionHost {
    Session session{[] {
        SessionOptions options;
        options.scene_origin = kOrigin;
        return options;
    }()};
    std::uint32_t frame = 0;
    template <class... P>
    const WeatherRegions& send(const P&... packets) {
        const cigi::Format format{ByteOrder::big, frame % 2 == 0 ? cigi::Version::three : cigi::Version::four};
        ++frame;
        session.accept(message(format, ig_control(frame), packets...), 20s * frame);
        return session.state().regions;
    }
    [[nodiscard]] std::uint64_t refused() const { return session.statistics().rejected_for(Reject::out_of_range); }
};

constexpr cigi::EnvironmentalRegionControl kRegion{.region = 7,
                                                   .state = cigi::RegionState::active,
                                                   .latitude = 47.3,
                                                   .longitude = 11.2,
                                                   .size_x = 9000.0F,
                                                   .size_y = 4000.0F,
                                                   .corner_radius = 1500.0F,
                                                   .rotation = 30.0F,
                                                   .transition_perimeter = 2000.0F};

}  // namespace

TEST_CASE("A region's weather is whole within its rounded rectangle and thins out evenly across its perimeter") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    for (int i = 0; i < 200; ++i) {
        cigi::EnvironmentalRegionControl packet = kRegion;
        packet.latitude = between(47.0, 47.5), packet.longitude = between(11.0, 11.6);
        packet.size_x = static_cast<float>(between(0.0, 2e4)), packet.size_y = static_cast<float>(between(0.0, 2e4));
        const float most = std::min(packet.size_x, packet.size_y) / 2.0F;
        packet.corner_radius = i % 3 == 0 ? 0.0F : i % 3 == 1 ? most : static_cast<float>(between(0.0, most));
        packet.rotation = static_cast<float>(between(-180.0, 180.0));
        packet.transition_perimeter = i % 4 == 0 ? 0.0F : static_cast<float>(between(1.0, 5000.0));
        RegionHost host;
        const WeatherRegion region = *host.send(packet).begin();
        // About the region's own middle, X to the north at first: GeographicLib's arithmetic, not the session's.
        const GeographicLib::LocalCartesian there(packet.latitude, packet.longitude, 0.0);
        const GeographicLib::LocalCartesian scene(kOrigin.latitude.value, kOrigin.longitude.value, kOrigin.altitude);
        const double turn = packet.rotation * 3.14159265358979323846 / 180.0;
        for (int p = 0; p < 50; ++p) {
            const double x = between(-15e3, 15e3), y = between(-15e3, 15e3);
            double latitude = 0, longitude = 0, height = 0;
            there.Reverse(x * std::sin(turn) + y * std::cos(turn), x * std::cos(turn) - y * std::sin(turn),
                          between(0.0, 3000.0), latitude, longitude, height);
            glm::dvec3 eye;
            scene.Forward(latitude, longitude, height, eye.x, eye.y, eye.z);
            // To the nearest side, or beyond both sides to the corner's circle.
            const double radius = packet.corner_radius;
            const double over_x = std::abs(x) - packet.size_x / 2.0, over_y = std::abs(y) - packet.size_y / 2.0;
            const bool at_corner = over_x > -radius && over_y > -radius;
            const double outside =
                at_corner ? std::hypot(over_x + radius, over_y + radius) - radius : std::max(over_x, over_y);
            const double perimeter = packet.transition_perimeter;
            const double share = outside <= 0.0 ? 1.0 : outside >= perimeter ? 0.0 : 1.0 - outside / perimeter;
            if (std::abs(outside) < 1e-6) continue;
            CAPTURE(i, x, y, outside);
            REQUIRE(region.share_at({eye}) == Approx(share).margin(1e-6));
        }
    }
}

TEST_CASE("Weather of a region is kept with it, whichever of the two comes first, until the region is destroyed") {
    RegionHost host;
    const cigi::WeatherControl rain{.region = 7,
                                    .layer = 4,
                                    .enable = true,
                                    .scope = cigi::WeatherScope::regional,
                                    .visibility = 900.0F,
                                    .coverage = 80.0F,
                                    .base = 500.0F,
                                    .thickness = 1200.0F};
    REQUIRE(host.send(rain).size() == 1);
    CHECK_FALSE(host.session.state().regions.begin()->active);
    const WeatherRegion region = *host.send(kRegion).begin();
    CHECK(region.active);
    CHECK(region.id == 7);
    CHECK(region.layers[4]->top == Approx(1200.0));
    CHECK(region.layers[4]->visibility == 900.0);
    CHECK_FALSE(host.session.state().weather[4].has_value());
    auto more = kRegion;
    more.state = cigi::RegionState::inactive;
    CHECK_FALSE(host.send(more).begin()->active);
    more.region = 8;
    CHECK(host.send(more).size() == 2);
    more.region = 7, more.state = cigi::RegionState::destroyed;
    CHECK(host.send(more).size() == 1);
    CHECK(host.session.state().regions.begin()->id == 8);
    CHECK(host.send(more).size() == 1);
    CHECK(host.refused() == 0);
}

TEST_CASE("A region that makes no sense is refused, and of more than are kept the host is told") {
    using Region = cigi::EnvironmentalRegionControl;
    RegionHost host;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::uint64_t refused = 0;
    const auto check_refused = [&](const Region& region) {
        CHECK(host.send(region).size() == 0);
        CHECK(host.refused() == ++refused);
    };
    for (float Region::*field :
         {&Region::size_x, &Region::size_y, &Region::corner_radius, &Region::rotation, &Region::transition_perimeter})
        for (const float bad : {nan, 2e7F, -400.0F}) {
            Region wrong = kRegion;
            wrong.*field = bad;
            check_refused(wrong);
        }
    Region wrong = kRegion;
    wrong.corner_radius = 2001.0F;
    check_refused(wrong);
    wrong = kRegion, wrong.latitude = 90.1;
    check_refused(wrong);
    wrong = kRegion, wrong.state = cigi::RegionState::reserved;
    check_refused(wrong);
    for (std::uint16_t id = 0; id < 20; ++id) {
        Region region = kRegion;
        region.region = id;
        host.send(region);
        CHECK(host.session.responses().size() == (id < WeatherRegions::kMost ? 0 : 1));
    }
    CHECK(host.session.state().regions.size() == WeatherRegions::kMost);
    CHECK(host.session.statistics().regions_dropped == 20 - WeatherRegions::kMost);
}
