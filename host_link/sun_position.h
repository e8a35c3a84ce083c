/// Where the sun stands, by date, time and place.
#pragma once

#include "host_link/host_state.h"
#include "ig_core/geometry/space.h"

namespace quadrig::host {

struct SunPosition {
    Degrees azimuth;    ///< clockwise from true north, 0..360
    Degrees elevation;  ///< above the horizontal plane of the ellipsoid; no refraction, no parallax (0.0024 degrees at
                        ///< most)
};

/// The Astronomical Almanac's low-precision formulas for the sun's coordinates, 0.01 degrees from 1950 to 2050, and its
/// sidereal time (USNO Circular 163). UTC is taken for UT1 (at most 0.9 s, 0.004 degrees).
SunPosition sun_position(const CivilTime& utc, const GeodeticPosition& place);

/// Days since 2000 January 1, 12:00, of a proleptic Gregorian date and time.
double days_since_j2000(const CivilTime& utc);

}  // namespace quadrig::host
