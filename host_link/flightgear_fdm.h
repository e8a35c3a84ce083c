/// FlightGear's native flight dynamics model packet ("net_fdm"), versions 24 (408 bytes) and 25 (552 bytes). Pure.
///
/// One datagram is one packet; every number is big-endian. Both versions agree in all that a pose needs; only where the
/// time stands differs. Values are as sent: not yet checked for range. Source: FlightGear src/Network/net_fdm.hxx (25),
/// JSBSim src/input_output/net_fdm.hxx (24).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "host_link/reject.h"

namespace quadrig::host::flightgear {

struct NetFdm {
    std::uint32_t version = 24;
    double longitude = 0.0, latitude = 0.0;  ///< rad, geodetic
    double altitude = 0.0;                   ///< m above sea level by name, above the sender's ellipsoid in practice
    float height_above_ground = 0.0F;        ///< m
    float phi = 0.0F, theta = 0.0F, psi = 0.0F;  ///< rad: roll right wing down, pitch nose up, true heading 0 to 2 pi
    std::uint32_t cur_time =
        0;  ///< s since 1970 (FlightGear), simulation time in a unit of the sender's (JSBSim), or a constant
    float visibility = 0.0F;  ///< m; JSBSim always sends 25000
};

inline constexpr std::size_t kSize24 = 408;
inline constexpr std::size_t kSize25 = 552;

/// Reads a datagram, or says what is the likely reason that it cannot be read.
std::variant<NetFdm, Reject> decode(std::span<const std::byte> datagram);

/// Writes a packet of version 24 or 25 and returns its size; `out` holds at least that. Fields not in NetFdm are 0.
std::size_t encode(const NetFdm& packet, std::span<std::byte> out);

}  // namespace quadrig::host::flightgear
