/// CANaerospace 1.7: one CAN frame to one message and back. Pure.
///
/// Data: u8 node, u8 data type, u8 service code, u8 message code, then 0 to 4 bytes, all big-endian. Redundancy channel
/// n adds n * 65536 to the identifier, in 29 bits. Source: CANaerospace interface specification 1.7 (12 January 2006),
/// sections 4 to 7.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "host_link/can_frame.h"
#include "host_link/reject.h"

namespace quadrig::host::canaerospace {

enum class DataType : std::uint8_t {
    no_data = 0,
    single = 2,   ///< FLOAT
    short2 = 12,  ///< two i16: the value in 32767ths of full scale, and full scale
    char4 = 15,
    uchar4 = 16,
    double_high = 30,  ///< the upper 32 bits of a float64
    double_low = 31
};

struct Message {
    std::uint16_t id = 0;      ///< without the channel
    std::uint8_t channel = 0;  ///< of redundancy; 0 the first
    std::uint8_t node = 0;     ///< who sends (normal operation data), or who is addressed (services); 0 all
    DataType type = DataType::no_data;
    std::uint8_t service = 0;
    std::uint8_t code = 0;  ///< normal operation data: counts up by one a message of its identifier, 255 to 0
    std::uint8_t size = 0;  ///< bytes of `data`, 0 to 4
    std::array<std::byte, 4> data{};
};

/// What an identifier means to an image generator.
enum class Role : std::uint8_t {
    none,
    pitch,         ///< deg, nose up
    roll,          ///< deg, right wing down
    heading,       ///< deg, -180..180
    true_heading,  ///< the same, said to be true
    latitude,
    longitude,
    height,  ///< m above the ellipsoid
    velocity_east,
    velocity_north,
    velocity_up,  ///< m/s
    utc,          ///< CHAR4 hour, minute, second, 0
    date,         ///< CHAR4 day, month, century, year
    service_request
};

/// Which of the specification's three sets of position identifiers.
enum class PositionSource : std::uint8_t { gps, ins, auxiliary };

struct Parameter {
    std::uint16_t id = 0;
    Role role = Role::none;
    std::string_view name = "other";
    PositionSource source = PositionSource::gps;  ///< of a position
};

/// The parameters known, `other` last; reports count messages by their place here.
std::size_t parameter_index(std::uint16_t id);
const Parameter& parameter_at(std::size_t index);
/// The identifier of a role, from one of the three sets where it is a part of the position.
std::uint16_t id_of(Role role, PositionSource source = PositionSource::gps);

/// Reads a frame; refused are remote and error frames, data of fewer than 4 bytes, channels above 255 and data shorter
/// than its type.
std::variant<Message, Reject> decode(const CanFrame& frame);
CanFrame encode(const Message& message);

/// FLOAT and SHORT2 as a number; absent for other types.
std::optional<double> number_of(const Message& message);
Message with_float(std::uint16_t id, std::uint8_t code, float value);
/// Upper half (DOUBLEH) with `code` and lower half (DOUBLEL) with the next one.
std::array<Message, 2> with_double(std::uint16_t id, std::uint8_t code, double value);

/// The reply to a request of the identification service that `node` has to answer: UCHAR4 hardware revision, software
/// revision, distribution 0 (standard identifiers), header type 0 (standard), on the identifier after the request's.
std::optional<Message> identification_reply(const Message& request, std::uint8_t node);

}  // namespace quadrig::host::canaerospace
