#include "host_link/sun_position.h"

#include <chrono>
#include <cmath>

namespace quadrig::host {

double days_since_j2000(const CivilTime& utc) {
    using namespace std::chrono;
    const sys_days date = year(utc.year) / utc.month / utc.day;
    const sys_days epoch = year(2000) / 1 / 1;
    const double seconds = utc.hour * 3600.0 + utc.minute * 60.0 + utc.second;
    return static_cast<double>((date - epoch).count()) - 0.5 + seconds / 86400.0;
}

SunPosition sun_position(const CivilTime& utc, const GeodeticPosition& place) {
    const double n = days_since_j2000(utc);
    const double mean_longitude = 280.460 + 0.9856474 * n;
    const double g = Degrees{357.528 + 0.9856003 * n}.radians();
    const double longitude = Degrees{mean_longitude + 1.915 * std::sin(g) + 0.020 * std::sin(2.0 * g)}.radians();
    const double obliquity = Degrees{23.439 - 0.0000004 * n}.radians();
    const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

    const double sidereal_hours = std::fmod(18.697374558 + 24.06570982441908 * n, 24.0);
    const double hour_angle = Degrees{15.0 * sidereal_hours + place.longitude.value}.radians() - right_ascension;
    const double latitude = place.latitude.radians();
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double north =
        std::sin(declination) * std::cos(latitude) - std::cos(declination) * std::sin(latitude) * std::cos(hour_angle);
    const double up =
        std::sin(declination) * std::sin(latitude) + std::cos(declination) * std::cos(latitude) * std::cos(hour_angle);
    const double azimuth = Degrees::from_radians(std::atan2(east, north)).value;
    return {{azimuth < 0.0 ? azimuth + 360.0 : azimuth},
            Degrees::from_radians(std::atan2(up, std::hypot(east, north)))};
}

}  // namespace quadrig::host
