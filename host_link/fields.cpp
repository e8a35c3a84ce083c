#include "host_link/fields.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <variant>

#include "host_link/can_frame.h"
#include "host_link/canaerospace.h"
#include "host_link/cigi.h"
#include "host_link/cigi_query.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/modbus.h"

namespace quadrig::host {

namespace {

using Fields = std::vector<Field>;

Field whole(std::string_view name, auto value) { return {name, static_cast<double>(value), ""}; }
Field degrees(std::string_view name, double value, double limit) { return {name, value, "deg", -limit, limit}; }
Field radians(std::string_view name, double value, double limit) { return {name, value, "rad", -limit, limit}; }
Field metres(std::string_view name, double value) { return {name, value, "m"}; }

Fields fields_of(const cigi::IgControl& p, cigi::Version version) {
    Fields fields{whole("major_version", static_cast<int>(version)),
                  whole("minor_version", p.minor_version),
                  whole("database", p.database),
                  {"mode", static_cast<double>(p.mode), "", 0, 2},
                  whole("host_frame", p.host_frame),
                  whole("timestamp_valid", p.timestamp_valid),
                  whole("timestamp", p.timestamp),
                  whole("smoothing", p.smoothing)};
    if (p.last_ig_frame) fields.push_back(whole("last_ig_frame", *p.last_ig_frame));
    return fields;
}

Fields fields_of(const cigi::EntityPosition& p) {
    Fields fields{whole("attached", p.attached), degrees("yaw", p.yaw, 360), degrees("pitch", p.pitch, 90),
                  degrees("roll", p.roll, 360)};
    if (p.attached) {
        fields.push_back(whole("parent", p.parent));
        for (const auto& [name, value] :
             {std::pair{"forward", p.latitude}, {"right", p.longitude}, {"down", p.altitude}})
            fields.push_back(metres(name, value));
        return fields;
    }
    fields.push_back(degrees("latitude", p.latitude, 90));
    fields.push_back(degrees("longitude", p.longitude, 180));
    fields.push_back({"altitude", p.altitude, "m", -12e3, 1e8});
    return fields;
}

Fields fields_of(const cigi::EntityControl& p, cigi::Version version) {
    Fields fields{whole("state", p.state), whole("type", p.type)};
    if (version == cigi::Version::four) return fields;
    for (const Field& field : fields_of(static_cast<const cigi::EntityPosition&>(p))) fields.push_back(field);
    return fields;
}

Fields fields_of(const cigi::RateControl& p) {
    return {{"x", p.x, "m/s"},           {"y", p.y, "m/s"},       {"z", p.z, "m/s"},      {"roll", p.roll, "deg/s"},
            {"pitch", p.pitch, "deg/s"}, {"yaw", p.yaw, "deg/s"}, whole("local", p.local)};
}

Fields fields_of(const cigi::ViewControl& p) {
    Fields fields{whole("group", p.group), whole("entity", p.entity)};
    if (p.x_enable) fields.push_back(metres("x", p.x));
    if (p.y_enable) fields.push_back(metres("y", p.y));
    if (p.z_enable) fields.push_back(metres("z", p.z));
    if (p.yaw_enable) fields.push_back(degrees("yaw", p.yaw, 360));
    if (p.pitch_enable) fields.push_back(degrees("pitch", p.pitch, 90));
    if (p.roll_enable) fields.push_back(degrees("roll", p.roll, 360));
    return fields;
}

Fields fields_of(const cigi::ViewDefinition& p) {
    Fields fields{whole("group", p.group)};
    if (p.left_enable) fields.push_back(degrees("left", p.left, 89));
    if (p.right_enable) fields.push_back(degrees("right", p.right, 89));
    if (p.top_enable) fields.push_back(degrees("top", p.top, 89));
    if (p.bottom_enable) fields.push_back(degrees("bottom", p.bottom, 89));
    return fields;
}

Fields fields_of(const cigi::CelestialSphereControl& p, cigi::Version version) {
    Fields fields{{"hour", double(p.hour), "", 0, 23}, {"minute", double(p.minute), "", 0, 59}};
    if (version == cigi::Version::four) fields.push_back({"seconds", p.seconds, "s", 0, 60});
    fields.push_back(whole("date", p.date));
    fields.push_back(whole("date_time_valid", p.date_time_valid));
    fields.push_back(whole("ephemeris", p.ephemeris));
    return fields;
}

Fields fields_of(const cigi::AtmosphereControl& p) {
    return {{"visibility", p.visibility, "m", 0},
            {"air_temperature", p.air_temperature, "C"},
            {"horizontal_wind", p.horizontal_wind, "m/s"},
            {"wind_direction", p.wind_direction, "deg"},
            {"pressure", p.pressure, "hPa"}};
}

Fields fields_of(const cigi::WeatherControl& p) {
    return {whole("enable", p.enable),
            whole("scope", p.scope),
            {"base", p.base, "m", -12e3, 1e5},
            {"thickness", p.thickness, "m", 0, 1e5},
            {"coverage", p.coverage, "%", 0, 100},
            {"visibility", p.visibility, "m", 0}};
}

Fields fields_of(const cigi::EnvironmentalRegionControl& p) {
    return {{"state", static_cast<double>(p.state), "", 0, 2},
            degrees("latitude", p.latitude, 90),
            degrees("longitude", p.longitude, 180),
            {"size_x", p.size_x, "m", 0, 1e7},
            {"size_y", p.size_y, "m", 0, 1e7},
            {"corner_radius", p.corner_radius, "m", 0, std::min(p.size_x, p.size_y) / 2.0},
            degrees("rotation", p.rotation, 360),
            {"transition_perimeter", p.transition_perimeter, "m", 0, 1e7}};
}

Fields fields_of(const cigi::ShortComponentControl& p) {
    return {whole("class", p.component_class), whole("instance", p.instance), whole("state", p.state),
            whole("data_1", p.data[0]), whole("data_2", p.data[1])};
}

Fields fields_of(const cigi::SensorControl& p) {
    return {whole("sensor", p.sensor), whole("on", p.on), whole("track_mode", p.track_mode)};
}

Fields fields_of(const cigi::CollisionSegmentDefinition& p) {
    return {whole("segment", p.segment), whole("enable", p.enable), metres("x1", p.from[0]), metres("y1", p.from[1]),
            metres("z1", p.from[2]),     metres("x2", p.to[0]),     metres("y2", p.to[1]),   metres("z2", p.to[2])};
}

Fields point_fields(const std::array<double, 3>& point, bool entity_axes) {
    if (entity_axes) return {metres("x", point[0]), metres("y", point[1]), metres("z", point[2])};
    return {degrees("latitude", point[0], 90), degrees("longitude", point[1], 180), metres("altitude", point[2])};
}

Fields fields_of(const cigi::HatHotRequest& p) {
    Fields fields = point_fields(p.point, p.entity_coordinates);
    fields.push_back(whole("period", p.period));
    return fields;
}

Fields fields_of(const cigi::LosSegmentRequest& p) {
    Fields fields = point_fields(p.source, p.source_entity);
    for (const Field& field : point_fields(p.destination, p.destination_entity)) fields.push_back(field);
    fields.push_back(whole("period", p.period));
    return fields;
}

Fields fields_of(const cigi::LosVectorRequest& p) {
    Fields fields = point_fields(p.source, p.source_entity);
    fields.push_back(degrees("azimuth", p.azimuth, 180));
    fields.push_back(degrees("elevation", p.elevation, 90));
    fields.push_back(metres("least", p.least));
    fields.push_back(metres("most", p.most));
    fields.push_back(whole("period", p.period));
    return fields;
}

ToldPacket told(const cigi::Packet& packet, cigi::Format format) {
    ToldPacket told{std::string(cigi::packet_name(packet.id)), {}};
    const auto as = [&]<class P>(P) {
        const P read = cigi::decode<P>(packet.bytes, format);
        if constexpr (requires { fields_of(read, format.version); })
            told.fields = fields_of(read, format.version);
        else
            told.fields = fields_of(read);
        if constexpr (requires { read.request; })
            told.name += ' ' + std::to_string(read.request);
        else if constexpr (requires { read.view; })
            told.name += ' ' + std::to_string(read.view);
        else if constexpr (requires { read.component; })
            told.name += ' ' + std::to_string(read.component);
        else if constexpr (requires { read.layer; })
            told.name += ' ' + std::to_string(read.layer);
        else if constexpr (requires { read.region; })
            told.name += ' ' + std::to_string(read.region);
        else if constexpr (requires { read.entity; })
            told.name += ' ' + std::to_string(read.entity);
    };
    const auto read_as = [&]<class... P>(P... kinds) { ((packet.id == P::kId ? as(kinds) : void()), ...); };
    read_as(cigi::IgControl{}, cigi::EntityControl{}, cigi::EntityPosition{}, cigi::RateControl{}, cigi::ViewControl{},
            cigi::ViewDefinition{}, cigi::CelestialSphereControl{}, cigi::AtmosphereControl{}, cigi::WeatherControl{},
            cigi::EnvironmentalRegionControl{}, cigi::ShortComponentControl{}, cigi::SensorControl{},
            cigi::CollisionSegmentDefinition{}, cigi::HatHotRequest{}, cigi::LosSegmentRequest{},
            cigi::LosVectorRequest{});
    if (told.fields.empty()) told.name += " (packet id " + std::to_string(packet.id) + ", skipped)";
    return told;
}

std::vector<ToldPacket> told_cigi(std::span<const std::byte> message) {
    std::vector<ToldPacket> packets;
    const auto opened = cigi::open_message(message);
    const auto* read = std::get_if<cigi::Message>(&opened);
    if (read == nullptr) return packets;
    for (auto rest = read->packets; !rest.empty();)
        packets.push_back(told(next_packet(rest, read->format), read->format));
    return packets;
}

std::vector<ToldPacket> told_fdm(std::span<const std::byte> message) {
    const auto decoded = flightgear::decode(message);
    const auto* p = std::get_if<flightgear::NetFdm>(&decoded);
    if (p == nullptr) return {};
    constexpr double kTurn = 2.0 * std::numbers::pi;
    // Rounding to float may pass the end of a range.
    constexpr double kRounding = 1e-6;
    return {{"net_fdm_" + std::to_string(p->version),
             {radians("latitude", p->latitude, kTurn / 4),
              radians("longitude", p->longitude, kTurn / 2 + kRounding),
              {"altitude", p->altitude, "m", -12e3, 1e8},
              metres("height_above_ground", p->height_above_ground),
              radians("phi", p->phi, kTurn + kRounding),
              radians("theta", p->theta, kTurn / 4 + kRounding),
              radians("psi", p->psi, kTurn + kRounding),
              whole("cur_time", p->cur_time),
              metres("visibility", p->visibility)}}};
}

std::vector<ToldPacket> told_can(std::span<const std::byte> record) {
    const auto frame = can_frame(record);
    if (!frame) return {};
    const auto decoded = canaerospace::decode(*frame);
    const auto* message = std::get_if<canaerospace::Message>(&decoded);
    if (message == nullptr) return {};
    const auto& parameter = canaerospace::parameter_at(canaerospace::parameter_index(message->id));
    ToldPacket told{std::string(parameter.name) + ' ' + std::to_string(message->id), {}};
    if (message->channel != 0) told.name += " channel " + std::to_string(message->channel);
    told.fields = {whole("node", message->node), whole("type", message->type), whole("code", message->code)};
    if (const auto number = canaerospace::number_of(*message)) told.fields.push_back({"value", *number, ""});
    return {told};
}

std::vector<ToldPacket> told_modbus(std::span<const std::byte> frame) {
    const auto read = modbus::read_request(frame);
    const auto* request = std::get_if<modbus::Request>(&read);
    if (request == nullptr) return {};
    const modbus::Registers registers = request->write ? *request->write : *request->read;
    return {{std::string(modbus::name_of(request->function)),
             {whole("address", registers.address), whole("count", registers.count)}}};
}

}  // namespace

bool Field::sound() const {
    // Binary floats in degrees may pass the end of a range by their rounding, as poses may.
    const double rounding = unit == "deg" ? 1e-4 : 0.0;
    return std::isfinite(value) && value >= least - rounding && value <= most + rounding;
}

std::string text_of(const Field& field) {
    std::array<char, 32> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), field.value, std::chars_format::general, 10);
    std::string text = std::string(field.name) + ' ' + std::string(digits.data(), end.ptr);
    if (!field.unit.empty()) text += ' ' + std::string(field.unit);
    return field.sound() ? text : text + " (!)";
}

std::vector<ToldPacket> told_packets(Protocol protocol, std::span<const std::byte> message) {
    switch (protocol) {
        case Protocol::cigi:
            return told_cigi(message);
        case Protocol::flightgear_fdm:
            return told_fdm(message);
        case Protocol::canaerospace:
            return told_can(message);
        case Protocol::modbus:
            return told_modbus(message);
    }
    return {};
}

}  // namespace quadrig::host
