#include <catch2/catch.hpp>
#include <cmath>

#include "display/png_file.h"
#include "display/test_pattern.h"
#include "host_link/cigi.h"
#include "host_link/geodesy.h"
#include "host_link/sun_position.h"
#include "ig_core/scene/deck_coverage.h"
#include "tests/appliance/files.h"
#include "tests/appliance/flights.h"
#include "tests/appliance/program.h"

using namespace quadrig;
using namespace quadrig::tests;
using namespace std::chrono_literals;
namespace cigi = quadrig::host::cigi;

namespace {

constexpr auto kOrder = host::ByteOrder::big;

template <class Packet>
Bytes bytes_of(const Packet& packet) {
    Bytes bytes;
    host::test::append(bytes, packet, kOrder);
    return bytes;
}

/// The picture of a host that says one thing over and over, after half a second of it.
display::Picture replayed(const Bytes& datagram, bool cigi, const std::string& scene_text, const Arguments& more = {}) {
    std::vector<Bytes> datagrams(30, datagram);
    if (cigi)  // the host frame number is bytes 8 to 11
        for (std::size_t i = 0; i < datagrams.size(); ++i) datagrams[i][11] = static_cast<std::byte>(i);
    const auto out = scratch_directory();
    Arguments arguments{"replay",  recording(datagrams, cigi ? 8004 : 5500),
                        "--scene", scratch_file("s.toml", scene_text),
                        "--size",  "160x120",
                        "--sink",  "png:" + out.string(),
                        "--fast"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = quadrig_program(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return display::read_png(out / "frame-000028.png");
}

display::Picture rendered(const std::string& scene_text, const std::string& eye, const std::string& attitude,
                          const std::string& fov) {
    const auto out = scratch_directory() / "still.png";
    const Outcome outcome =
        quadrig_program({"render", scratch_file("s.toml", scene_text), "--eye", eye, "--attitude", attitude, "--size",
                         "160x120", "--fov", fov, "-o", out, "--time", "0.46666666666666667"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return display::read_png(out);
}

/// The wire rounds angles to single precision: a few edge pixels may differ by a little.
void check_same(const display::Picture& a, const display::Picture& b) {
    CHECK(difference(a, b).mean < 0.01);
    CHECK(difference(a, b).largest < 16);
}
void check_different(const display::Picture& a, const display::Picture& b) { CHECK(difference(a, b).mean > 1.0); }

const Pose kPose{14.0, {{12.5}, {-3.0}, {20.0}}};

}  // namespace

TEST_CASE("A FlightGear pose is seen as the still picture from the same eye") {
    check_same(replayed(fdm_message(kPose), false, small_scene()),
               rendered(small_scene(), "0,0,14", "12.5,-3,20", "60"));
    check_different(replayed(fdm_message({14.0, {}}), false, small_scene()),
                    rendered(small_scene(), "0,0,14", "12.5,-3,20", "60"));
}

TEST_CASE("A CIGI pose is seen as the still picture from the same eye") {
    check_same(replayed(cigi_message(0, kPose), true, small_scene()),
               rendered(small_scene(), "0,0,14", "12.5,-3,20", "60"));
}

TEST_CASE("A CIGI 4.0 stream is seen as the 3.3 stream of the same pose is, to the last bit") {
    host::cigi::ViewControl mount;
    mount.yaw_enable = true, mount.yaw = -30.0F;
    const auto seen = [&](host::cigi::Version version) {
        const host::cigi::Format format{kOrder, version};
        Bytes more;
        host::test::append(more, mount, format);
        return replayed(cigi_message(0, kPose, more, format), true, small_scene());
    };
    CHECK(difference(seen(host::cigi::Version::three), seen(host::cigi::Version::four)).largest == 0);
}

TEST_CASE("The altitude offset of a link moves the eye") {
    check_same(replayed(fdm_message(kPose), false, small_scene(), {"--link", "fdm:?altitude_offset=6.5"}),
               rendered(small_scene(), "0,0,20.5", "12.5,-3,20", "60"));
}

TEST_CASE("The host's view window wins over --fov unless it is to be ignored") {
    host::cigi::ViewDefinition window;
    window.left_enable = window.right_enable = true;
    window.left = -20.0F, window.right = 20.0F;
    // Top and bottom are left out, so they stay the channel's: those of --fov 40 here.
    const Bytes message = cigi_message(0, kPose, bytes_of(window));
    check_same(replayed(message, true, small_scene(), {"--fov", "40"}),
               rendered(small_scene(), "0,0,14", "12.5,-3,20", "40"));
    const double top = std::atan(std::tan(Degrees{20.0}.radians()) * 0.75);
    window.top_enable = window.bottom_enable = true;
    window.top = static_cast<float>(Degrees::from_radians(top).value), window.bottom = -window.top;
    const Bytes whole = cigi_message(0, kPose, bytes_of(window));
    check_same(replayed(whole, true, small_scene(), {"--fov", "90"}),
               rendered(small_scene(), "0,0,14", "12.5,-3,20", "40"));
    check_same(replayed(whole, true, small_scene(), {"--fov", "90", "--ignore-host-window"}),
               rendered(small_scene(), "0,0,14", "12.5,-3,20", "90"));
}

TEST_CASE("The eye sits where View Control mounts it on the ownship") {
    host::cigi::ViewControl mount;
    mount.x_enable = mount.y_enable = mount.z_enable = mount.yaw_enable = true;
    mount.x = 5.0F, mount.y = 2.0F, mount.z = -3.0F, mount.yaw = -30.0F;
    check_same(replayed(cigi_message(0, {14.0, {}}, bytes_of(mount)), true, small_scene()),
               rendered(small_scene(), "2,5,17", "-30,0,0", "60"));
}

TEST_CASE("The sun stands where the host's date and time put it, and haze is the host's visibility") {
    host::cigi::CelestialSphereControl sky;
    sky.hour = 15, sky.minute = 30, sky.date = 6'21'2024, sky.date_time_valid = true;
    host::cigi::AtmosphereControl air;
    air.visibility = 1500.0F;
    const auto sun = host::sun_position({2024, 6, 21, 15, 30, 0.0}, {{47.26}, {11.34}, 581.0});
    CHECK(sun.azimuth.value > 240.0);
    const std::string expected = "[sun]\nazimuth = " + std::to_string(sun.azimuth.value) +
                                 "\nelevation = " + std::to_string(sun.elevation.value) +
                                 "\n[haze]\nvisibility = 1500.0\n";
    const auto picture =
        replayed(cigi_message(0, kPose, host::test::operator+(bytes_of(sky), bytes_of(air))), true, small_scene());
    check_same(picture, rendered(small_scene(expected), "0,0,14", "12.5,-3,20", "60"));
    check_different(picture, rendered(small_scene(), "0,0,14", "12.5,-3,20", "60"));

    sky.date_time_valid = false;
    check_same(replayed(cigi_message(0, kPose, bytes_of(sky)), true, small_scene()),
               rendered(small_scene(), "0,0,14", "12.5,-3,20", "60"));
}

TEST_CASE("A layer of weather moves the scene's cloud deck, takes it away, and is a fog to an eye within it") {
    const auto seen = [](const cigi::WeatherControl& weather, double height = 14.0) {
        return replayed(cigi_message(0, {height, {{12.5}, {10.0}, {0.0}}}, bytes_of(weather)), true, small_scene());
    };
    const auto with_deck = [](const std::string& altitude, const std::string& threshold) {
        std::string text = small_scene();
        text.replace(text.find("altitude = 900.0"), 16, "altitude = " + altitude);
        text.replace(text.find("threshold = 0.1"), 15, "threshold = " + threshold);
        return text;
    };
    cigi::WeatherControl weather{.layer = 1,
                                 .enable = true,
                                 .visibility = 90.0F,
                                 .coverage = 100.0F,
                                 .base = 581.0F + 400.0F,
                                 .thickness = 200.0F};
    std::string whole = with_deck("400.0", "0.1");
    const std::string holes = "translucence = { threshold = 0.1, softness = 0.3 }";
    whole.erase(whole.find(holes), holes.size());
    CHECK(difference(seen(weather), rendered(whole, "0,0,14", "12.5,10,0", "60")).mean < 0.01);
    weather.enable = false;
    CHECK(difference(seen(weather), rendered(with_deck("-1e6", "0.1"), "0,0,14", "12.5,10,0", "60")).mean < 0.01);
    weather.enable = true;
    std::string fog = with_deck("-1e6", "0.1");
    const std::string haze = "[haze]\nvisibility = 90.0\n";
    check_same(seen(weather, 450.0), rendered(haze + fog, "0,0,450", "12.5,10,0", "60"));
    // Less of it lets more of the sky through.
    weather.coverage = 50.0F;
    const auto half = seen(weather);
    weather.coverage = 0.0F;
    const auto none = seen(weather);
    CHECK(difference(half, none).mean > 0.1);
    CHECK(difference(half, rendered(whole, "0,0,14", "12.5,10,0", "60")).mean > 0.1);
}

TEST_CASE("A region's weather is seen within it, half of it halfway across its perimeter, and not beyond") {
    const GeodeticPosition north = host::SceneFrame({{47.26}, {11.34}, 581.0}).geodetic({{0, 10e3, 0}});
    cigi::EnvironmentalRegionControl region{.region = 3,
                                            .state = cigi::RegionState::active,
                                            .latitude = north.latitude.value,
                                            .longitude = north.longitude.value,
                                            .size_x = 8000.0F,
                                            .size_y = 2000.0F};
    const auto seen = [&](const cigi::WeatherControl& weather, float perimeter) {
        region.transition_perimeter = perimeter;
        auto regional = weather;
        regional.scope = cigi::WeatherScope::regional, regional.region = 3;
        return replayed(cigi_message(0, kPose, host::test::operator+(bytes_of(region), bytes_of(regional))), true,
                        small_scene());
    };
    const auto still = [](const std::string& scene) { return rendered(scene, "0,0,14", "12.5,-3,20", "60"); };
    const auto clear = still(small_scene()), hazy = still("[haze]\nvisibility = 300.0\n" + small_scene());
    // The eye is 6 km south of the rectangle. Rain, then sand: what is in the air shortens the view.
    for (const auto layer : {std::uint8_t{4}, std::uint8_t{8}}) {
        const cigi::WeatherControl air{.layer = layer,
                                       .enable = true,
                                       .visibility = 150.0F,
                                       .coverage = 60.0F,
                                       .base = 300.0F,
                                       .thickness = 900.0F};
        check_same(seen(air, 12e3F), hazy);
        check_same(seen(air, 5999.0F), clear);
    }
    check_different(hazy, clear);
    // The deck of the scene, at 900 m with a threshold of 0.1, and the region's.
    const cigi::WeatherControl deck{.layer = 1,
                                    .enable = true,
                                    .visibility = 90.0F,
                                    .coverage = 70.0F,
                                    .base = 581.0F + 400.0F,
                                    .thickness = 100.0F};
    const Texture grass{.name = "grass", .terms = {{1.0, 0.05, 0.3}, {0.7, 0.11, 1.9}}};
    const double threshold = DeckCoverage(grass, {0.1, 0.0, 0.3}).threshold(0.7);
    std::string halfway = small_scene();
    halfway.replace(halfway.find("altitude = 900.0"), 16, "altitude = 650.0");
    halfway.replace(halfway.find("threshold = 0.1"), 15, "threshold = " + std::to_string((0.1 + threshold) / 2));
    CHECK(difference(seen(deck, 12e3F), still(halfway)).mean < 0.05);
    CHECK(difference(still(halfway), clear).mean > 0.2);
    region.size_x = 30e3F;
    CHECK(difference(seen(deck, 0.0F), replayed(cigi_message(0, kPose, bytes_of(deck)), true, small_scene())).largest ==
          0);
}

TEST_CASE("A host switches the test pattern and the overlay on and off") {
    const auto seen = [](std::uint16_t component, std::uint8_t state, const Arguments& more = {}) {
        const cigi::ShortComponentControl control{.component = component, .component_class = 13, .state = state};
        return replayed(cigi_message(0, kPose, bytes_of(control)), true, small_scene(), more);
    };
    const auto pattern = seen(1, 1);
    display::Picture expected(160, 120);
    display::draw_test_pattern(expected.image());
    CHECK(difference(pattern, expected).largest == 0);
    CHECK(difference(seen(2, 1), seen(3, 1, {"--overlay"})).largest == 0);
    CHECK(difference(seen(2, 0, {"--overlay"}), seen(3, 1)).largest == 0);
    CHECK(difference(seen(2, 1), seen(2, 0)).largest > 100);
}

TEST_CASE("What moves by rates stops once its host has been silent for as long as its link says") {
    cigi::EntityControl other;
    other.entity = 5, other.type = 12;
    const GeodeticPosition there = host::SceneFrame({{47.26}, {11.34}, 581.0}).geodetic({{-20, 60, 14}});
    other.latitude = there.latitude.value, other.longitude = there.longitude.value, other.altitude = there.altitude;
    const cigi::RateControl flies{.entity = 5, .y = 10.0F};  // to the east
    // The host dies after its first message; something that is none of its own comes two seconds later.
    const auto flight = recording(
        {cigi_message(1, {14.0, {}}, host::test::operator+(bytes_of(other), bytes_of(flies))), Bytes(8)}, 8004, 2s);
    const auto seen = [&](const std::string& link, int frame) {
        const auto out = scratch_directory();
        const Outcome outcome = quadrig_program({"replay", flight, "--scene", scratch_file("s.toml", still_scene()),
                                                 "--size", "160x120", "--rate", "10", "--entity", "12=x-29", "--sink",
                                                 "png:" + out.string(), "--fast", "--link", link});
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return display::read_png(out / ("frame-0000" + std::to_string(frame) + ".png"));
    };
    const auto with_model_at = [](const std::string& x) {
        return rendered(still_scene() + "[[model]]\nmodel = \"x-29\"\nposition = [" + x + ", 60, 14]\n", "0,0,14",
                        "0,0,0", "60");
    };
    CHECK(difference(seen("cigi:", 18), with_model_at("-10")).mean < 0.02);
    CHECK(difference(seen("cigi:?silence=1500", 18), with_model_at("-5")).mean < 0.02);
    CHECK(difference(with_model_at("-10"), with_model_at("-5")).mean > 0.05);
}

TEST_CASE("An entity of the host is drawn as the model that its type stands for, where the host has it") {
    const Pose pose;
    host::cigi::EntityControl other;
    other.entity = 5, other.type = 12, other.yaw = 70.0F, other.roll = 20.0F;
    // small_scene()'s origin is where the flights are.
    const GeodeticPosition there = host::SceneFrame({{47.26}, {11.34}, 581.0}).geodetic({{0, 60, 16}});
    other.latitude = there.latitude.value, other.longitude = there.longitude.value, other.altitude = there.altitude;
    const Bytes message = cigi_message(0, pose, bytes_of(other));
    const std::string scene = small_scene();
    const auto drawn = replayed(message, true, scene, {"--entity", "12=x-29"});
    const auto expected =
        rendered(scene + "[[model]]\nmodel = \"x-29\"\nposition = [0, 60, 16]\nattitude = [70, 0, 20]\n", "0,0,14",
                 "0,0,0", "60");
    CHECK(difference(drawn, expected).mean < 0.01);
    CHECK(difference(drawn, replayed(message, true, scene)).mean > 0.3);
    CHECK(difference(replayed(message, true, scene, {"--entity", "13=x-29"}), replayed(message, true, scene)).largest ==
          0);
    const Outcome unknown = quadrig_program({"replay", recording({message, message}, 8004), "--scene",
                                             scratch_file("s.toml", scene), "--entity", "12=zeppelin"});
    CHECK(unknown.status == 1);
    CHECK_THAT(unknown.err, Catch::Contains("zeppelin"));
    CHECK(quadrig_program({"replay", "x.pcap", "--entity", "x-29"}).status == 2);
}
