#include "host_link/cigi_control.h"

#include "host_link/cigi_codec.h"

namespace quadrig::host::cigi {

auto& counter_since_32(Is<IgControl> auto& p) { return p.last_ig_frame; }
auto& counter_since_32(Is<StartOfFrame> auto& p) { return p.last_host_frame; }

void layout(auto& wire, Is<IgControl> auto& p) {
    wire.number(3, 5, p.database);
    wire.bits({4, 0}, {7, 0}, 2, p.mode);
    wire.bits({4, 2}, {7, 2}, 1, p.timestamp_valid);
    wire.bits({4, 3}, {7, 3}, 1, p.smoothing);
    wire.bits({4, 4}, {7, 4}, 4, p.minor_version);
    wire.bits({}, {6, 0}, 1, p.substitute_types);
    wire.number(8, 8, p.host_frame);
    wire.number(12, 16, p.timestamp);
    if (p.last_ig_frame) wire.number(16, 12, *p.last_ig_frame);
}

void layout(auto& wire, Is<StartOfFrame> auto& p) {
    wire.number(3, 5, p.database);
    wire.number(4, kNone, p.status);
    wire.bits({5, 0}, {7, 0}, 2, p.mode);
    wire.bits({5, 2}, {7, 2}, 1, p.timestamp_valid);
    wire.bits({5, 3}, {7, 3}, 1, p.host_defined_earth);
    wire.bits({5, 4}, {7, 4}, 4, p.minor_version);
    wire.number(8, 8, p.ig_frame);
    wire.number(12, 12, p.timestamp);
    if (p.last_host_frame) wire.number(16, 16, *p.last_host_frame);
    wire.number(kNone, 20, p.conditions);
}

void position_layout(auto& wire, auto& p) {
    wire.bits({4, 2}, {4, 0}, 1, p.attached);
    wire.bits({4, 5}, {4, 1}, 2, p.clamp);
    wire.number(10, 8, p.parent);
    wire.number(12, 12, p.roll);
    wire.number(16, 16, p.pitch);
    wire.number(20, 20, p.yaw);
    wire.number(24, 24, p.latitude);
    wire.number(32, 32, p.longitude);
    wire.number(40, 40, p.altitude);
}

void layout(auto& wire, Is<EntityPosition> auto& p) {
    wire.number(kNone, 6, p.entity);
    position_layout(wire, p);
}

void layout(auto& wire, Is<EntityControl> auto& p) {
    wire.number(2, 6, p.entity);
    wire.bits({4, 0}, {4, 0}, 2, p.state);
    wire.bits({4, 3}, {4, 2}, 1, p.collision_detection);
    wire.bits({4, 4}, {4, 3}, 1, p.inherit_alpha);
    wire.bits({5, 4}, {4, 4}, 1, p.smoothing);
    wire.bits({}, {4, 5}, 1, p.extended_type);
    wire.number(6, 5, p.alpha);
    wire.number(8, 10, p.type);
    wire.number(kNone, 8, p.kind);
    wire.number(kNone, 9, p.domain);
    wire.number(kNone, 12, p.category);
    wire.number(kNone, 13, p.subcategory);
    wire.number(kNone, 14, p.specific);
    wire.number(kNone, 15, p.extra);
    wire.bits({5, 0}, {}, 1, p.animation_backward);
    wire.bits({5, 1}, {}, 1, p.animation_loop);
    wire.bits({5, 2}, {}, 2, p.animation_state);
    if (wire.version() == Version::three) position_layout(wire, p);
}

void layout(auto& wire, Is<RateControl> auto& p) {
    wire.number(2, 4, p.entity);
    wire.number(4, 6, p.part);
    wire.bits({5, 0}, {7, 0}, 1, p.apply_to_part);
    wire.bits({5, 1}, {7, 1}, 1, p.local);
    wire.number(8, 8, p.x);
    wire.number(12, 12, p.y);
    wire.number(16, 16, p.z);
    wire.number(20, 20, p.roll);
    wire.number(24, 24, p.pitch);
    wire.number(28, 28, p.yaw);
}

void layout(auto& wire, Is<ViewControl> auto& p) {
    wire.number(2, 6, p.view);
    wire.number(4, 4, p.group);
    wire.bits({5, 0}, {5, 0}, 1, p.x_enable);
    wire.bits({5, 1}, {5, 1}, 1, p.y_enable);
    wire.bits({5, 2}, {5, 2}, 1, p.z_enable);
    wire.bits({5, 3}, {5, 3}, 1, p.roll_enable);
    wire.bits({5, 4}, {5, 4}, 1, p.pitch_enable);
    wire.bits({5, 5}, {5, 5}, 1, p.yaw_enable);
    wire.number(6, 8, p.entity);
    wire.number(8, 12, p.x);
    wire.number(12, 16, p.y);
    wire.number(16, 20, p.z);
    wire.number(20, 24, p.roll);
    wire.number(24, 28, p.pitch);
    wire.number(28, 32, p.yaw);
}

void layout(auto& wire, Is<ViewDefinition> auto& p) {
    wire.number(2, 4, p.view);
    wire.number(4, 6, p.group);
    wire.bits({5, 0}, {7, 0}, 1, p.near_enable);
    wire.bits({5, 1}, {7, 1}, 1, p.far_enable);
    wire.bits({5, 2}, {7, 2}, 1, p.left_enable);
    wire.bits({5, 3}, {7, 3}, 1, p.right_enable);
    wire.bits({5, 4}, {7, 4}, 1, p.top_enable);
    wire.bits({5, 5}, {7, 5}, 1, p.bottom_enable);
    wire.bits({5, 6}, {7, 6}, 2, p.mirror);
    wire.bits({6, 0}, {8, 0}, 3, p.pixel_replication);
    wire.bits({6, 3}, {8, 3}, 1, p.orthographic);
    wire.bits({6, 4}, {8, 4}, 1, p.reorder);
    wire.bits({6, 5}, {8, 5}, 3, p.view_type);
    wire.number(8, 12, p.near_distance);
    wire.number(12, 16, p.far_distance);
    wire.number(16, 20, p.left);
    wire.number(20, 24, p.right);
    wire.number(24, 28, p.top);
    wire.number(28, 32, p.bottom);
}

void layout(auto& wire, Is<CelestialSphereControl> auto& p) {
    wire.number(2, 6, p.hour);
    wire.number(3, 7, p.minute);
    wire.number(kNone, 8, p.seconds);
    wire.bits({4, 0}, {4, 0}, 1, p.ephemeris);
    wire.bits({4, 1}, {4, 1}, 1, p.sun);
    wire.bits({4, 2}, {4, 2}, 1, p.moon);
    wire.bits({4, 3}, {4, 3}, 1, p.stars);
    wire.bits({4, 4}, {4, 4}, 1, p.date_time_valid);
    wire.number(8, 12, p.date);
    wire.number(12, 16, p.star_intensity);
}

void layout(auto& wire, Is<AtmosphereControl> auto& p) {
    wire.bits({2, 0}, {4, 7}, 1, p.model);
    wire.bits({3, 0}, {4, 0}, wire.version() == Version::three ? 8 : 7, p.humidity);
    wire.number(4, 8, p.air_temperature);
    wire.number(8, 12, p.visibility);
    wire.number(12, 16, p.horizontal_wind);
    wire.number(16, 20, p.vertical_wind);
    wire.number(20, 24, p.wind_direction);
    wire.number(24, 28, p.pressure);
}

void layout(auto& wire, Is<WeatherControl> auto& p) {
    wire.number(2, 8, p.region);
    wire.number(4, 4, p.layer);
    wire.number(5, 5, p.humidity);
    wire.bits({6, 0}, {6, 0}, 1, p.enable);
    wire.bits({6, 1}, {6, 1}, 1, p.scud);
    wire.bits({6, 2}, {6, 2}, 1, p.random_winds);
    wire.bits({6, 3}, {6, 3}, 1, p.random_lightning);
    wire.bits({6, 4}, {6, 4}, 4, p.cloud_type);
    wire.bits({7, 0}, {7, 0}, 2, p.scope);
    wire.bits({7, 2}, {7, 2}, 3, p.severity);
    wire.bits({}, {7, 5}, 1, p.top_scud);
    wire.number(8, 12, p.air_temperature);
    wire.number(12, 16, p.visibility);
    wire.number(16, 20, p.scud_frequency);
    wire.number(20, 24, p.coverage);
    wire.number(24, 28, p.base);
    wire.number(28, 32, p.thickness);
    wire.number(32, 36, p.transition);
    wire.number(36, 40, p.horizontal_wind);
    wire.number(40, 44, p.vertical_wind);
    wire.number(44, 48, p.wind_direction);
    wire.number(48, 52, p.pressure);
    wire.number(52, 56, p.aerosol);
    wire.number(kNone, 60, p.top_scud_frequency);
    wire.number(kNone, 64, p.top_transition);
}

void layout(auto& wire, Is<EnvironmentalRegionControl> auto& p) {
    wire.number(2, 6, p.region);
    wire.bits({4, 0}, {4, 0}, 2, p.state);
    wire.bits({4, 2}, {4, 2}, 1, p.merge_weather);
    wire.bits({4, 3}, {4, 3}, 1, p.merge_aerosol);
    wire.bits({4, 4}, {4, 4}, 1, p.merge_maritime);
    wire.bits({4, 5}, {4, 5}, 1, p.merge_terrestrial);
    wire.number(8, 8, p.latitude);
    wire.number(16, 16, p.longitude);
    wire.number(24, 24, p.size_x);
    wire.number(28, 28, p.size_y);
    wire.number(32, 32, p.corner_radius);
    wire.number(36, 36, p.rotation);
    wire.number(40, 40, p.transition_perimeter);
}

void layout(auto& wire, Is<ShortComponentControl> auto& p) {
    wire.number(2, 4, p.component);
    wire.number(4, 8, p.instance);
    wire.number(6, 6, p.component_class);
    wire.number(7, 7, p.state);
    wire.numbers(8, 16, p.data);
}

void layout(auto& wire, Is<SensorControl> auto& p) {
    wire.number(2, 8, p.view);
    wire.number(4, 4, p.sensor);
    wire.bits({5, 0}, {5, 0}, 1, p.on);
    wire.bits({5, 1}, {5, 1}, 1, p.black_hot);
    wire.bits({5, 2}, {5, 2}, 1, p.line_dropout);
    wire.bits({5, 3}, {5, 3}, 1, p.automatic_gain);
    wire.bits({5, 4}, {5, 4}, 1, p.track_black);
    wire.bits({5, 5}, {5, 5}, 3, p.track_mode);
    wire.bits({6, 0}, {6, 0}, 1, p.extended_response);
    wire.number(8, 12, p.gain);
    wire.number(12, 16, p.level);
    wire.number(16, 20, p.ac_coupling);
    wire.number(20, 24, p.noise);
}

void layout(auto& wire, Is<CollisionSegmentDefinition> auto& p) {
    wire.number(2, 6, p.entity);
    wire.number(4, 4, p.segment);
    wire.bits({5, 0}, {5, 0}, 1, p.enable);
    wire.numbers(8, 8, p.from);
    wire.numbers(20, 20, p.to);
    wire.number(32, 32, p.material_mask);
}

QUADRIG_CIGI_PACKET(IgControl)
QUADRIG_CIGI_PACKET(StartOfFrame)
QUADRIG_CIGI_PACKET(EntityControl)
QUADRIG_CIGI_PACKET(EntityPosition)
QUADRIG_CIGI_PACKET(RateControl)
QUADRIG_CIGI_PACKET(ViewControl)
QUADRIG_CIGI_PACKET(ViewDefinition)
QUADRIG_CIGI_PACKET(CelestialSphereControl)
QUADRIG_CIGI_PACKET(AtmosphereControl)
QUADRIG_CIGI_PACKET(WeatherControl)
QUADRIG_CIGI_PACKET(EnvironmentalRegionControl)
QUADRIG_CIGI_PACKET(ShortComponentControl)
QUADRIG_CIGI_PACKET(SensorControl)
QUADRIG_CIGI_PACKET(CollisionSegmentDefinition)

}  // namespace quadrig::host::cigi
