// Wireshark's dissector as the judge: rates, weather, components, sensors, collisions, messages.
#include <catch2/catch.hpp>

#include "host_link/cigi_query.h"
#include "tshark_judge.h"

using namespace quadrig::host;
using namespace quadrig::host::test;

namespace {

void numbers(Fields& fields, std::initializer_list<std::pair<const char*, float*>> all) {
    for (const auto& [name, value] : all) fields.number(name, *value);
}

Columns random_motion_and_weather(Random& random, Bytes& bytes, ByteOrder order) {
    Columns c;
    cigi::RateControl rate;
    Fields r{random, c, "rate_control"};
    r.number("entity_id", rate.entity);
    r.number("part_id", rate.part);
    r.bits("apply_to_part", rate.apply_to_part, 1);
    r.bits("coordinate_system", rate.local, 1);
    numbers(r, {{"x_rate", &rate.x},
                {"y_rate", &rate.y},
                {"z_rate", &rate.z},
                {"roll_rate", &rate.roll},
                {"pitch_rate", &rate.pitch},
                {"yaw_rate", &rate.yaw}});

    cigi::WeatherControl weather;
    Fields w{random, c, "weather_control"};
    w.number("entity_region_id", weather.region);
    w.number("layer_id", weather.layer);
    w.number("humidity", weather.humidity);
    w.bits("weather_enable", weather.enable, 1);
    w.bits("scud_enable", weather.scud, 1);
    w.bits("random_winds_enable", weather.random_winds, 1);
    w.bits("random_lightning_enable", weather.random_lightning, 1);
    w.bits("cloud_type", weather.cloud_type, 4);
    w.bits("scope", weather.scope, 2);
    w.bits("severity", weather.severity, 3);
    numbers(w, {{"air_temp", &weather.air_temperature},
                {"visibility_range", &weather.visibility},
                {"scud_frequency", &weather.scud_frequency},
                {"coverage", &weather.coverage},
                {"base_elevation", &weather.base},
                {"thickness", &weather.thickness},
                {"transition_band", &weather.transition},
                {"horiz_wind", &weather.horizontal_wind},
                {"vert_wind", &weather.vertical_wind},
                {"wind_direction", &weather.wind_direction},
                {"barometric_pressure", &weather.pressure},
                {"aerosol_concentration", &weather.aerosol}});
    cigi::EnvironmentalRegionControl region;
    Fields g{random, c, "env_region_control"};
    g.number("region_id", region.region);
    g.bits("region_state", region.state, 2);
    g.bits("merge_weather", region.merge_weather, 1);
    g.bits("merge_aerosol", region.merge_aerosol, 1);
    g.bits("merge_maritime", region.merge_maritime, 1);
    g.bits("merge_terrestrial", region.merge_terrestrial, 1);
    g.number("lat", region.latitude);
    g.number("lon", region.longitude);
    numbers(g, {{"size_x", &region.size_x},
                {"size_y", &region.size_y},
                {"corner_radius", &region.corner_radius},
                {"rotation", &region.rotation},
                {"transition_perimeter", &region.transition_perimeter}});
    bytes = message(order, ig_control(1), rate, weather, region);
    return c;
}

Columns random_devices(Random& random, Bytes& bytes, ByteOrder order) {
    Columns c;
    cigi::ShortComponentControl component;
    Fields s{random, c, "short_component_control"};
    s.number("component_id", component.component);
    s.number("instance_id", component.instance);
    s.bits("component_class", component.component_class, 4);
    s.number("component_state", component.state);

    cigi::SensorControl sensor;
    Fields e{random, c, "sensor_control"};
    e.number("view_id", sensor.view);
    e.number("sensor_id", sensor.sensor);
    e.bits("sensor_on_off", sensor.on, 1);
    e.bits("polarity", sensor.black_hot, 1);
    e.bits("line_dropout_enable", sensor.line_dropout, 1);
    e.bits("auto_gain", sensor.automatic_gain, 1);
    e.bits("track_white_black", sensor.track_black, 1);
    e.bits("track_mode", sensor.track_mode, 3);
    e.bits("response_type", sensor.extended_response, 1);
    numbers(e, {{"gain", &sensor.gain},
                {"level", &sensor.level},
                {"ac_coupling", &sensor.ac_coupling},
                {"noise", &sensor.noise}});

    cigi::CollisionSegmentDefinition segment;
    Fields d{random, c, "coll_det_seg_def"};
    d.number("entity_id", segment.entity);
    d.number("segment_id", segment.segment);
    d.bits("segment_enable", segment.enable, 1);
    numbers(d, {{"x1", &segment.from[0]},
                {"y1", &segment.from[1]},
                {"z1", &segment.from[2]},
                {"x2", &segment.to[0]},
                {"y2", &segment.to[1]},
                {"z2", &segment.to[2]}});
    d.number("material_mask", segment.material_mask);
    bytes = message(order, ig_control(1), component, sensor, segment);
    return c;
}

Columns random_told(Random& random, Bytes& bytes, ByteOrder order) {
    Columns c;
    cigi::SensorResponse sensor;
    Fields s{random, c, "sensor_response"};
    s.number("view_id", sensor.view);
    s.number("sensor_id", sensor.sensor);
    s.bits("sensor_status", sensor.status, 2);
    s.number("gate_x_size", sensor.gate_width);
    s.number("gate_y_size", sensor.gate_height);
    numbers(s, {{"gate_x_pos", &sensor.gate_azimuth}, {"gate_y_pos", &sensor.gate_elevation}});
    s.number("frame_ctr", sensor.host_frame);

    cigi::SensorExtendedResponse more;
    Fields x{random, c, "sensor_ext_response"};
    x.number("view_id", more.view);
    x.number("sensor_id", more.sensor);
    x.bits("sensor_status", more.status, 2);
    x.bits("entity_id_valid", more.entity_valid, 1);
    x.number("entity_id", more.entity);
    x.number("gate_x_size", more.gate_width);
    x.number("gate_y_size", more.gate_height);
    numbers(x, {{"gate_x_pos", &more.gate_azimuth}, {"gate_y_pos", &more.gate_elevation}});
    x.number("frame_ctr", more.host_frame);
    x.number("track_lat", more.track_point[0]);
    x.number("track_lon", more.track_point[1]);
    x.number("track_alt", more.track_point[2]);

    cigi::CollisionSegmentNotification hit;
    Fields h{random, c, "coll_det_seg_notification"};
    h.number("entity_id", hit.entity);
    h.number("segment_id", hit.segment);
    h.bits("type", hit.with_entity, 1);
    h.number("contacted_entity_id", hit.other_entity);
    h.number("material_code", hit.material);
    numbers(h, {{"intersection_distance", &hit.distance}});
    cigi::IgMessage text;
    Fields m{random, c, "image_generator_message"};
    m.number("message_id", text.message);
    // The text is a number, so that it can be compared as one.
    const std::string digits = std::to_string(random.below(1000000));
    m.expect("message", std::stod(digits));
    text.text = digits;
    bytes = message(order, cigi::StartOfFrame{}, sensor, more, hit, text);
    return c;
}

}  // namespace

TEST_CASE("tshark reads every field of rates and weather as it was meant, in both byte orders") {
    judge("weather-little", ByteOrder::little, random_motion_and_weather);
    judge("weather-big", ByteOrder::big, random_motion_and_weather);
}
TEST_CASE(
    "tshark reads every field of components, sensors and collision segments as it was meant, in both byte orders") {
    judge("devices-little", ByteOrder::little, random_devices);
    judge("devices-big", ByteOrder::big, random_devices);
}
TEST_CASE(
    "tshark reads every field of sensor responses, collisions and messages as it was meant, in both byte orders") {
    judge("told-little", ByteOrder::little, random_told);
    judge("told-big", ByteOrder::big, random_told);
}
TEST_CASE("A text longer than a message holds is cut, and one of any length is closed by a zero") {
    for (std::size_t length = 0; length < 80; ++length)
        for (const auto version : {cigi::Version::three, cigi::Version::four}) {
            const std::string text(length, 'x');
            const Bytes bytes = message({ByteOrder::big, version}, cigi::IgMessage{7, text});
            CHECK(bytes.size() % 8 == 0);
            CHECK(bytes.size() <= cigi::kLargestResponse);
            CHECK(bytes.back() == std::byte{0});
            CHECK(static_cast<std::size_t>(std::ranges::count(bytes, std::byte{'x'})) ==
                  std::min(length, cigi::IgMessage::kMostCharacters));
            if (version == cigi::Version::four) CHECK(load<std::uint16_t>(bytes, 0, ByteOrder::big) == bytes.size());
        }
}
