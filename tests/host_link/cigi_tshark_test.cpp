// Wireshark's dissector as the judge: what we encode, it must read with the same values.
#include <catch2/catch.hpp>

#include "host_link/cigi_query.h"
#include "tshark_judge.h"

using namespace quadrig::host;
using namespace quadrig::host::test;

namespace {

Columns random_message(Random& random, Bytes& bytes, ByteOrder order) {
    Columns c;
    const auto expect = [&](const std::string& field, auto value) {
        c.push_back({"cigi." + field, static_cast<double>(value)});
    };
    const auto number = [&](const std::string& field, auto& value) {
        random.number(value);
        expect(field, value);
    };
    const auto bits = [&](const std::string& field, auto& value, int count) {
        random.bits(value, count);
        expect(field, value);
    };

    cigi::IgControl ig;
    expect("version", 3);
    number("ig_control.db_number", ig.database);
    // tshark takes a message with mode 3 for something other than CIGI.
    ig.mode = static_cast<cigi::IgMode>(random.below(3));
    expect("ig_control.ig_mode", ig.mode);
    bits("ig_control.timestamp_valid", ig.timestamp_valid, 1);
    bits("ig_control.extrapolation_enable", ig.smoothing, 1);
    expect("ig_control.minor_version", 3);
    number("ig_control.host_frame_number", ig.host_frame);
    number("ig_control.timestamp", ig.timestamp);
    number("ig_control.last_ig_frame_number", *ig.last_ig_frame);

    cigi::EntityControl entity;
    number("entity_control.entity_id", entity.entity);
    bits("entity_control.entity_state", entity.state, 2);
    bits("entity_control.attach_state", entity.attached, 1);
    bits("entity_control.coll_det_request", entity.collision_detection, 1);
    bits("entity_control.inherit_alpha", entity.inherit_alpha, 1);
    bits("entity_control.ground_ocean_clamp", entity.clamp, 2);
    bits("entity_control.animation_dir", entity.animation_backward, 1);
    bits("entity_control.animation_loop_mode", entity.animation_loop, 1);
    bits("entity_control.animation_state", entity.animation_state, 2);
    bits("entity_control.extrapolation_enable", entity.smoothing, 1);
    number("entity_control.alpha", entity.alpha);
    number("entity_control.entity_type", entity.type);
    number("entity_control.parent_id", entity.parent);
    number("entity_control.roll", entity.roll);
    number("entity_control.pitch", entity.pitch);
    number("entity_control.yaw", entity.yaw);
    number("entity_control.lat_xoff", entity.latitude);
    number("entity_control.lon_yoff", entity.longitude);
    number("entity_control.alt_zoff", entity.altitude);

    cigi::ViewControl control;
    number("view_control.view_id", control.view);
    number("view_control.group_id", control.group);
    bits("view_control.xoff_enable", control.x_enable, 1);
    bits("view_control.yoff_enable", control.y_enable, 1);
    bits("view_control.zoff_enable", control.z_enable, 1);
    bits("view_control.roll_enable", control.roll_enable, 1);
    bits("view_control.pitch_enable", control.pitch_enable, 1);
    bits("view_control.yaw_enable", control.yaw_enable, 1);
    number("view_control.entity_id", control.entity);
    number("view_control.xoff", control.x);
    number("view_control.yoff", control.y);
    number("view_control.zoff", control.z);
    number("view_control.roll", control.roll);
    number("view_control.pitch", control.pitch);
    number("view_control.yaw", control.yaw);

    cigi::ViewDefinition definition;
    number("view_def.view_id", definition.view);
    number("view_def.group_id", definition.group);
    bits("view_def.near_enable", definition.near_enable, 1);
    bits("view_def.far_enable", definition.far_enable, 1);
    bits("view_def.left_enable", definition.left_enable, 1);
    bits("view_def.right_enable", definition.right_enable, 1);
    bits("view_def.top_enable", definition.top_enable, 1);
    bits("view_def.bottom_enable", definition.bottom_enable, 1);
    bits("view_def.mirror_mode", definition.mirror, 2);
    bits("view_def.pixel_replication", definition.pixel_replication, 3);
    bits("view_def.projection_type", definition.orthographic, 1);
    bits("view_def.reorder", definition.reorder, 1);
    bits("view_def.view_type", definition.view_type, 3);
    number("view_def.near", definition.near_distance);
    number("view_def.far", definition.far_distance);
    number("view_def.left", definition.left);
    number("view_def.right", definition.right);
    number("view_def.top", definition.top);
    number("view_def.bottom", definition.bottom);

    cigi::CelestialSphereControl sky;
    number("celestial_sphere_control.hour", sky.hour);
    number("celestial_sphere_control.minute", sky.minute);
    bits("celestial_sphere_control.ephemeris_enable", sky.ephemeris, 1);
    bits("celestial_sphere_control.sun_enable", sky.sun, 1);
    bits("celestial_sphere_control.moon_enable", sky.moon, 1);
    bits("celestial_sphere_control.star_enable", sky.stars, 1);
    bits("celestial_sphere_control.date_time_valid", sky.date_time_valid, 1);
    number("celestial_sphere_control.date", sky.date);
    number("celestial_sphere_control.star_intensity", sky.star_intensity);

    cigi::AtmosphereControl air;
    bits("atmosphere_control.atmospheric_model_enable", air.model, 1);
    number("atmosphere_control.humidity", air.humidity);
    number("atmosphere_control.air_temp", air.air_temperature);
    number("atmosphere_control.visibility_range", air.visibility);
    number("atmosphere_control.horiz_wind", air.horizontal_wind);
    number("atmosphere_control.vert_wind", air.vertical_wind);
    number("atmosphere_control.wind_direction", air.wind_direction);
    number("atmosphere_control.barometric_pressure", air.pressure);

    bytes = message(order, ig, entity, control, definition, sky, air);
    return c;
}

Columns random_reply(Random& random, Bytes& bytes, ByteOrder order) {
    Columns c;
    const auto expect = [&](const std::string& field, auto value) {
        c.push_back({"cigi." + field, static_cast<double>(value)});
    };
    const auto number = [&](const std::string& field, auto& value) {
        random.number(value);
        expect("sof." + field, value);
    };
    const auto bits = [&](const std::string& field, auto& value, int count) {
        random.bits(value, count);
        expect("sof." + field, value);
    };
    cigi::StartOfFrame sof;
    expect("version", 3);
    number("db_number", sof.database);
    number("ig_status", sof.status);
    bits("ig_mode", sof.mode, 2);
    bits("timestamp_valid", sof.timestamp_valid, 1);
    bits("earth_reference_model", sof.host_defined_earth, 1);
    expect("sof.minor_version", 3);
    number("ig_frame_number", sof.ig_frame);
    number("timestamp", sof.timestamp);
    number("last_host_frame_number", *sof.last_host_frame);
    bytes = message(order, sof);
    return c;
}

Columns random_questions(Random& random, Bytes& bytes, ByteOrder order) {
    Columns c;
    cigi::HatHotRequest height;
    Fields hat{random, c, "hat_hot_request"};
    hat.number("hat_hot_id", height.request);
    height.kind = static_cast<cigi::HeightKind>(random.below(3));
    hat.expect("type", height.kind);
    hat.bits("coordinate_system", height.entity_coordinates, 1);
    hat.number("update_period", height.period);
    hat.number("entity_id", height.entity);
    hat.triple("", height.point);

    cigi::LosSegmentRequest segment;
    Fields seg{random, c, "los_segment_request"};
    seg.number("los_id", segment.request);
    seg.bits("type", segment.extended, 1);
    seg.bits("source_coord", segment.source_entity, 1);
    seg.bits("destination_coord", segment.destination_entity, 1);
    seg.bits("response_coord", segment.response_entity, 1);
    seg.bits("destination_entity_id_valid", segment.destination_id_valid, 1);
    seg.number("alpha_threshold", segment.alpha_threshold);
    seg.number("entity_id", segment.entity);
    seg.triple("source_", segment.source);
    seg.triple("destination_", segment.destination);
    seg.number("material_mask", segment.material_mask);
    seg.number("update_period", segment.period);
    seg.number("destination_entity_id", segment.destination_id);

    cigi::LosVectorRequest vector;
    Fields vec{random, c, "los_vector_request"};
    vec.number("los_id", vector.request);
    vec.bits("type", vector.extended, 1);
    vec.bits("source_coord", vector.source_entity, 1);
    vec.bits("response_coord", vector.response_entity, 1);
    vec.number("alpha", vector.alpha_threshold);
    vec.number("entity_id", vector.entity);
    vec.number("azimuth", vector.azimuth);
    vec.number("elevation", vector.elevation);
    vec.number("min_range", vector.least);
    vec.number("max_range", vector.most);
    vec.triple("source_", vector.source);
    vec.number("material_mask", vector.material_mask);
    vec.number("update_period", vector.period);

    bytes = message(order, ig_control(1), height, segment, vector);
    return c;
}

Columns random_answers(Random& random, Bytes& bytes, ByteOrder order) {
    Columns c;
    cigi::HatHotResponse height;
    Fields hat{random, c, "hat_hot_response"};
    hat.number("hat_hot_id", height.request);
    hat.bits("valid", height.valid, 1);
    hat.bits("type", height.of_terrain, 1);
    hat.bits("host_frame_number_lsn", height.host_frame, 4);
    hat.number("height", height.height);

    cigi::HatHotExtendedResponse both;
    Fields ext{random, c, "hat_hot_ext_response"};
    ext.number("hat_hot_id", both.request);
    ext.bits("valid", both.valid, 1);
    ext.bits("host_frame_number_lsn", both.host_frame, 4);
    ext.number("hat", both.above_terrain);
    ext.number("hot", both.of_terrain);
    ext.number("material_code", both.material);
    ext.number("normal_vector_azimuth", both.normal_azimuth);
    ext.number("normal_vector_elevation", both.normal_elevation);

    cigi::LosResponse sight;
    Fields los{random, c, "los_response"};
    los.number("los_id", sight.request);
    los.bits("valid", sight.valid, 1);
    los.bits("entity_id_valid", sight.entity_valid, 1);
    los.bits("visible", sight.visible, 1);
    los.bits("host_frame_number_lsn", sight.host_frame, 4);
    los.number("count", sight.count);
    los.number("entity_id", sight.entity);
    los.number("range", sight.range);

    cigi::LosExtendedResponse all;
    Fields far{random, c, "3_2_los_ext_response"};
    far.number("los_id", all.request);
    far.bits("valid", all.valid, 1);
    far.bits("entity_id_valid", all.entity_valid, 1);
    far.bits("range_valid", all.range_valid, 1);
    far.bits("visible", all.visible, 1);
    far.bits("host_frame_number_lsn", all.host_frame, 4);
    far.number("response_count", all.count);
    far.number("entity_id", all.entity);
    far.number("range", all.range);
    far.triple("", all.point);
    far.number("red", all.rgba[0]);
    far.number("green", all.rgba[1]);
    far.number("blue", all.rgba[2]);
    far.number("alpha", all.rgba[3]);
    far.number("material_code", all.material);
    far.number("normal_vector_azimuth", all.normal_azimuth);
    far.number("normal_vector_elevation", all.normal_elevation);

    cigi::StartOfFrame sof;
    bytes = message(order, sof, height, both, sight, all);
    return c;
}

}  // namespace

TEST_CASE("tshark reads every field of every supported host packet as it was meant, little-endian") {
    judge("host-little", ByteOrder::little, random_message);
}
TEST_CASE("tshark reads every field of every supported host packet as it was meant, big-endian") {
    judge("host-big", ByteOrder::big, random_message);
}
TEST_CASE("tshark reads every field of Start Of Frame as it was meant, in both byte orders") {
    judge("sof-little", ByteOrder::little, random_reply);
    judge("sof-big", ByteOrder::big, random_reply);
}
TEST_CASE("tshark reads every field of questions about the scene and of their answers, in both byte orders") {
    judge("questions-little", ByteOrder::little, random_questions);
    judge("questions-big", ByteOrder::big, random_questions);
    judge("answers-little", ByteOrder::little, random_answers);
    judge("answers-big", ByteOrder::big, random_answers);
}
