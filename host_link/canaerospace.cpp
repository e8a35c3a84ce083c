#include "host_link/canaerospace.h"

#include <algorithm>
#include <bit>

#include "host_link/wire.h"

namespace quadrig::host::canaerospace {

namespace {

constexpr std::size_t kHeader = 4;
constexpr std::uint32_t kChannelStep = 65536, kMostChannels = 256;
constexpr std::uint16_t kServiceFirst = 128, kServiceLast = 199;
constexpr std::uint8_t kIdentification = 0;
constexpr std::uint8_t kHardwareRevision = 1, kSoftwareRevision = 1, kStandardDistribution = 0, kStandardHeader = 0;

constexpr std::array kParameters{
    Parameter{303, Role::none, "pitch_rate"},
    Parameter{304, Role::none, "roll_rate"},
    Parameter{305, Role::none, "yaw_rate"},
    Parameter{311, Role::pitch, "body_pitch_angle"},
    Parameter{312, Role::roll, "body_roll_angle"},
    Parameter{314, Role::none, "altitude_rate"},
    Parameter{315, Role::none, "indicated_airspeed"},
    Parameter{320, Role::none, "baro_corrected_altitude"},
    Parameter{321, Role::heading, "heading_angle"},
    Parameter{322, Role::none, "standard_altitude"},
    Parameter{332, Role::none, "true_altitude"},
    Parameter{336, Role::none, "body_normal_velocity"},
    Parameter{337, Role::none, "body_longitudinal_velocity"},
    Parameter{338, Role::none, "body_lateral_velocity"},
    Parameter{1036, Role::latitude, "gps_latitude"},
    Parameter{1037, Role::longitude, "gps_longitude"},
    Parameter{1038, Role::height, "gps_height"},
    Parameter{1049, Role::latitude, "ins_latitude", PositionSource::ins},
    Parameter{1050, Role::longitude, "ins_longitude", PositionSource::ins},
    Parameter{1051, Role::height, "ins_height", PositionSource::ins},
    Parameter{1059, Role::latitude, "auxiliary_latitude", PositionSource::auxiliary},
    Parameter{1060, Role::longitude, "auxiliary_longitude", PositionSource::auxiliary},
    Parameter{1061, Role::height, "auxiliary_height", PositionSource::auxiliary},
    Parameter{1069, Role::none, "magnetic_heading"},
    Parameter{1070, Role::none, "radio_height"},
    Parameter{1130, Role::velocity_east, "true_east_velocity"},
    Parameter{1131, Role::velocity_north, "true_north_velocity"},
    Parameter{1132, Role::velocity_up, "true_up_velocity"},
    Parameter{1133, Role::true_heading, "true_heading"},
    Parameter{1200, Role::utc, "utc"},
    Parameter{1206, Role::date, "date"},
    Parameter{kServiceFirst, Role::service_request, "service_request"},
    Parameter{},
};
constexpr std::size_t kOther = kParameters.size() - 1;
constexpr std::size_t kService = kParameters.size() - 2;

std::size_t size_of(DataType type) {
    switch (type) {
        case DataType::single:
        case DataType::short2:
        case DataType::char4:
        case DataType::uchar4:
        case DataType::double_high:
        case DataType::double_low:
            return 4;
        default:
            return 0;
    }
}

std::uint8_t u8(std::byte b) { return std::to_integer<std::uint8_t>(b); }

Message with_word(std::uint16_t id, DataType type, std::uint8_t code, std::uint32_t word) {
    Message message{.id = id, .node = 1, .type = type, .code = code, .size = 4};
    store(std::span(message.data), 0, ByteOrder::big, word);
    return message;
}

}  // namespace

std::size_t parameter_index(std::uint16_t id) {
    // Requests stand on the even identifiers, replies on the odd ones.
    if (id >= kServiceFirst && id <= kServiceLast) return id % 2 == 0 ? kService : kOther;
    const auto known = std::ranges::find(kParameters.begin(), kParameters.begin() + kService, id, &Parameter::id);
    return known == kParameters.begin() + kService ? kOther : static_cast<std::size_t>(known - kParameters.begin());
}

const Parameter& parameter_at(std::size_t index) { return kParameters[std::min(index, kOther)]; }

std::uint16_t id_of(Role role, PositionSource source) {
    return std::ranges::find_if(kParameters, [&](const Parameter& p) { return p.role == role && p.source == source; })
        ->id;
}

std::variant<Message, Reject> decode(const CanFrame& frame) {
    if (frame.error || frame.remote) return Reject::not_data_frame;
    if (frame.size < kHeader) return Reject::bad_size;
    const std::uint32_t channel = frame.id / kChannelStep;
    if (channel >= kMostChannels) return Reject::unknown_channel;
    Message message;
    message.id = static_cast<std::uint16_t>(frame.id % kChannelStep);
    message.channel = static_cast<std::uint8_t>(channel);
    message.node = u8(frame.data[0]);
    message.type = DataType{u8(frame.data[1])};
    message.service = u8(frame.data[2]);
    message.code = u8(frame.data[3]);
    message.size = static_cast<std::uint8_t>(frame.size - kHeader);
    std::ranges::copy(std::span(frame.data).subspan(kHeader), message.data.begin());
    if (message.size < size_of(message.type)) return Reject::bad_size;
    return message;
}

CanFrame encode(const Message& message) {
    CanFrame frame;
    frame.id = message.id + message.channel * kChannelStep;
    frame.extended = message.channel != 0;
    frame.size = static_cast<std::uint8_t>(kHeader + message.size);
    frame.data = {std::byte{message.node}, static_cast<std::byte>(message.type), std::byte{message.service},
                  std::byte{message.code}};
    std::ranges::copy(message.data, frame.data.begin() + kHeader);
    return frame;
}

std::optional<double> number_of(const Message& message) {
    const std::span data(message.data);
    if (message.type == DataType::single) return load<float>(data, 0, ByteOrder::big);
    if (message.type == DataType::short2)
        return load<std::int16_t>(data, 0, ByteOrder::big) / 32767.0 * load<std::int16_t>(data, 2, ByteOrder::big);
    return std::nullopt;
}

Message with_float(std::uint16_t id, std::uint8_t code, float value) {
    return with_word(id, DataType::single, code, std::bit_cast<std::uint32_t>(value));
}

std::array<Message, 2> with_double(std::uint16_t id, std::uint8_t code, double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    return {with_word(id, DataType::double_high, code, static_cast<std::uint32_t>(bits >> 32)),
            with_word(id, DataType::double_low, static_cast<std::uint8_t>(code + 1), static_cast<std::uint32_t>(bits))};
}

std::optional<Message> identification_reply(const Message& request, std::uint8_t node) {
    const bool asked = parameter_index(request.id) == kService && request.channel == 0 &&
                       request.service == kIdentification && (request.node == 0 || request.node == node);
    if (!asked) return std::nullopt;
    Message reply{.id = static_cast<std::uint16_t>(request.id + 1),
                  .node = node,
                  .type = DataType::uchar4,
                  .service = kIdentification,
                  .code = request.code,
                  .size = 4};
    reply.data = {std::byte{kHardwareRevision}, std::byte{kSoftwareRevision}, std::byte{kStandardDistribution},
                  std::byte{kStandardHeader}};
    return reply;
}

}  // namespace quadrig::host::canaerospace
