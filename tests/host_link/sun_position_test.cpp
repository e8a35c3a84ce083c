#include <catch2/catch.hpp>

#include "host_link/sun_position.h"

using namespace quadrig;
using namespace quadrig::host;

TEST_CASE("The sun of NREL's worked example stands where the Solar Position Algorithm puts it") {
    // Reda and Andreas, NREL/TP-560-34302, A.5: 2003-10-17 12:30:30 at UTC - 7; topocentric, without refraction.
    const SunPosition sun = sun_position({2003, 10, 17, 19, 30, 30.0}, {{39.742476}, {-105.1786}, 1830.14});
    CHECK(sun.azimuth.value == Approx(194.340241).margin(0.01));
    CHECK(sun.elevation.value == Approx(39.872046).margin(0.01));
}

TEST_CASE("The sun's declination follows the solstices, the equinoxes and Meeus's example") {
    // At a pole the elevation is the declination.
    const GeodeticPosition north_pole{{90.0}, {0.0}, 0.0};
    CHECK(sun_position({2000, 3, 20, 7, 35, 0.0}, north_pole).elevation.value == Approx(0.0).margin(0.01));
    CHECK(sun_position({2000, 6, 21, 1, 48, 0.0}, north_pole).elevation.value == Approx(23.438).margin(0.01));
    CHECK(sun_position({2000, 9, 22, 17, 28, 0.0}, north_pole).elevation.value == Approx(0.0).margin(0.01));
    CHECK(sun_position({2000, 12, 21, 13, 37, 0.0}, north_pole).elevation.value == Approx(-23.438).margin(0.01));
    // Meeus, Astronomical Algorithms, example 25.a: 1992 October 13, 0h TD.
    CHECK(sun_position({1992, 10, 13, 0, 0, 0.0}, north_pole).elevation.value == Approx(-7.78507).margin(0.01));
}

TEST_CASE("At true noon the sun is due south in the north and due north in the south, as high as geometry says") {
    // Greenwich, 2000 June 21: the equation of time is -1 min 50 s, so noon comes at 12:01:50.
    const SunPosition north = sun_position({2000, 6, 21, 12, 1, 50.0}, {{51.4779}, {0.0}, 0.0});
    CHECK(north.azimuth.value == Approx(180.0).margin(0.05));
    CHECK(north.elevation.value == Approx(90.0 - 51.4779 + 23.438).margin(0.01));
    const SunPosition south = sun_position({2000, 6, 21, 12, 1, 50.0}, {{-33.0}, {0.0}, 0.0});
    CHECK((south.azimuth.value < 0.1 || south.azimuth.value > 359.9));
    CHECK(south.elevation.value == Approx(90.0 - 33.0 - 23.438).margin(0.01));
}

TEST_CASE("In the morning the sun is in the east, in the evening in the west") {
    const GeodeticPosition place{{0.0}, {0.0}, 0.0};
    CHECK(sun_position({2024, 3, 20, 7, 0, 0.0}, place).azimuth.value == Approx(90.0).margin(1.0));
    CHECK(sun_position({2024, 3, 20, 17, 0, 0.0}, place).azimuth.value == Approx(270.0).margin(1.0));
}

TEST_CASE("Days are counted from noon of 2000 January 1 over leap years") {
    CHECK(days_since_j2000({2000, 1, 1, 12, 0, 0.0}) == 0.0);
    CHECK(days_since_j2000({2000, 3, 1, 0, 0, 0.0}) == 59.5);
    CHECK(days_since_j2000({1999, 12, 31, 12, 0, 0.0}) == -1.0);
    CHECK(days_since_j2000({2024, 6, 21, 12, 30, 0.0}) == Approx(2460483.0 - 2451545.0 + 0.5 / 24.0).epsilon(1e-14));
}
