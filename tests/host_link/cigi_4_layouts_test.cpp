// CIGI 4.0, which Wireshark 4.0 shows as plain UDP: the judge is the offset table below, written down from the
// standard's tables as the CIGI class library for 4.0 packs them, and by nothing of ours.
#include <array>
#include <catch2/catch.hpp>
#include <random>

#include "host_link/cigi_control.h"
#include "host_link/cigi_query.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;

namespace {

/// A packet's bytes in both orders, field by field at its offset, each with a random value that the struct gets too.
struct Table {
    std::mt19937_64& random;
    Bytes little, big;

    Table(std::mt19937_64& engine, std::uint16_t size, std::uint16_t id) : random(engine), little(size), big(size) {
        put(0, size);
        put(2, id);
    }
    template <class T>
    void put(std::size_t offset, T value) {
        std::array<std::byte, sizeof(T)> raw;
        std::memcpy(raw.data(), &value, sizeof(T));  // the machines this runs on are little-endian
        std::ranges::copy(raw, little.begin() + static_cast<std::ptrdiff_t>(offset));
        std::ranges::reverse_copy(raw, big.begin() + static_cast<std::ptrdiff_t>(offset));
    }
    template <class T>
    void whole(std::size_t offset, T& value) {
        value = static_cast<T>(random());
        put(offset, value);
    }
    void real(std::size_t offset, auto& value) {
        using T = std::remove_reference_t<decltype(value)>;
        value = static_cast<T>(std::uniform_real_distribution<double>(-1e4, 1e4)(random));
        put(offset, value);
    }
    void reals(std::size_t offset, auto& values) {
        for (auto& value : values) real(offset, value), offset += sizeof value;
    }
    void bits(std::size_t offset, unsigned first, unsigned count, auto& value) {
        const auto field = static_cast<unsigned>(random() % (1U << count));
        value = static_cast<std::remove_reference_t<decltype(value)>>(field);
        little[offset] |= static_cast<std::byte>(field << first);
        big[offset] |= static_cast<std::byte>(field << first);
    }
};

template <class P>
void judge(std::uint16_t size, std::uint16_t id, auto fill) {
    const std::uint64_t seed = std::random_device{}();
    INFO("packet id " << id << ", seed " << seed);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 50; ++i) {
        P packet;
        Table table(random, size, id);
        fill(table, packet);
        CHECK(to_hex(message(kLittle4, packet)) == to_hex(table.little));
        CHECK(to_hex(message(kBig4, packet)) == to_hex(table.big));
        CHECK(to_hex(message(kLittle4, cigi::decode<P>(table.big, kBig4))) == to_hex(table.little));
        CHECK(to_hex(message(kBig4, cigi::decode<P>(table.little, kLittle4))) == to_hex(table.big));
    }
}

}  // namespace

TEST_CASE("Every 4.0 packet that opens a message or moves something has each field where the table says") {
    judge<cigi::IgControl>(24, 0x0000, [](Table& t, cigi::IgControl& p) {
        t.put<std::uint8_t>(4, 4);
        t.whole(5, p.database);
        t.bits(6, 0, 1, p.substitute_types);
        t.bits(7, 0, 2, p.mode);
        t.bits(7, 2, 1, p.timestamp_valid);
        t.bits(7, 3, 1, p.smoothing);
        t.bits(7, 4, 4, p.minor_version);
        t.whole(8, p.host_frame);
        t.whole(12, *p.last_ig_frame);
        t.whole(16, p.timestamp);
    });
    judge<cigi::StartOfFrame>(24, 0xFFFF, [](Table& t, cigi::StartOfFrame& p) {
        t.put<std::uint8_t>(4, 4);
        t.whole(5, p.database);
        t.bits(7, 0, 2, p.mode);
        t.bits(7, 2, 1, p.timestamp_valid);
        t.bits(7, 3, 1, p.host_defined_earth);
        t.bits(7, 4, 4, p.minor_version);
        t.whole(8, p.ig_frame);
        t.whole(12, p.timestamp);
        t.whole(16, *p.last_host_frame);
        t.whole(20, p.conditions);
    });
    judge<cigi::EntityControl>(16, 0x0025, [](Table& t, cigi::EntityControl& p) {
        t.bits(4, 0, 2, p.state);
        t.bits(4, 2, 1, p.collision_detection);
        t.bits(4, 3, 1, p.inherit_alpha);
        t.bits(4, 4, 1, p.smoothing);
        t.bits(4, 5, 1, p.extended_type);
        t.whole(5, p.alpha);
        t.whole(6, p.entity);
        t.whole(8, p.kind);
        t.whole(9, p.domain);
        t.whole(10, p.type);
        t.whole(12, p.category);
        t.whole(13, p.subcategory);
        t.whole(14, p.specific);
        t.whole(15, p.extra);
    });
    judge<cigi::EntityPosition>(48, 0x0001, [](Table& t, cigi::EntityPosition& p) {
        t.bits(4, 0, 1, p.attached);
        t.bits(4, 1, 2, p.clamp);
        t.whole(6, p.entity);
        t.whole(8, p.parent);
        t.real(12, p.roll);
        t.real(16, p.pitch);
        t.real(20, p.yaw);
        t.real(24, p.latitude);
        t.real(32, p.longitude);
        t.real(40, p.altitude);
    });
    judge<cigi::RateControl>(32, 0x0007, [](Table& t, cigi::RateControl& p) {
        t.whole(4, p.entity);
        t.whole(6, p.part);
        t.bits(7, 0, 1, p.apply_to_part);
        t.bits(7, 1, 1, p.local);
        std::size_t at = 8;
        for (float* value : {&p.x, &p.y, &p.z, &p.roll, &p.pitch, &p.yaw}) t.real(at, *value), at += 4;
    });
    judge<cigi::ViewControl>(40, 0x000F, [](Table& t, cigi::ViewControl& p) {
        t.whole(4, p.group);
        unsigned bit = 0;
        for (bool* flag : {&p.x_enable, &p.y_enable, &p.z_enable, &p.roll_enable, &p.pitch_enable, &p.yaw_enable})
            t.bits(5, bit++, 1, *flag);
        t.whole(6, p.view);
        t.whole(8, p.entity);
        std::size_t at = 12;
        for (float* value : {&p.x, &p.y, &p.z, &p.roll, &p.pitch, &p.yaw}) t.real(at, *value), at += 4;
    });
    judge<cigi::ViewDefinition>(40, 0x0014, [](Table& t, cigi::ViewDefinition& p) {
        t.whole(4, p.view);
        t.whole(6, p.group);
        unsigned bit = 0;
        for (bool* flag :
             {&p.near_enable, &p.far_enable, &p.left_enable, &p.right_enable, &p.top_enable, &p.bottom_enable})
            t.bits(7, bit++, 1, *flag);
        t.bits(7, 6, 2, p.mirror);
        t.bits(8, 0, 3, p.pixel_replication);
        t.bits(8, 3, 1, p.orthographic);
        t.bits(8, 4, 1, p.reorder);
        t.bits(8, 5, 3, p.view_type);
        std::size_t at = 12;
        for (float* value : {&p.near_distance, &p.far_distance, &p.left, &p.right, &p.top, &p.bottom})
            t.real(at, *value), at += 4;
    });
}

TEST_CASE("Every 4.0 packet about the air, components and sensors has each field where the table says") {
    judge<cigi::CelestialSphereControl>(24, 0x0008, [](Table& t, cigi::CelestialSphereControl& p) {
        unsigned bit = 0;
        for (bool* flag : {&p.ephemeris, &p.sun, &p.moon, &p.stars, &p.date_time_valid}) t.bits(4, bit++, 1, *flag);
        t.whole(6, p.hour);
        t.whole(7, p.minute);
        t.real(8, p.seconds);
        t.whole(12, p.date);
        t.real(16, p.star_intensity);
    });
    judge<cigi::AtmosphereControl>(32, 0x0009, [](Table& t, cigi::AtmosphereControl& p) {
        t.bits(4, 7, 1, p.model);
        t.bits(4, 0, 7, p.humidity);
        std::size_t at = 8;
        for (float* value :
             {&p.air_temperature, &p.visibility, &p.horizontal_wind, &p.vertical_wind, &p.wind_direction, &p.pressure})
            t.real(at, *value), at += 4;
    });
    judge<cigi::WeatherControl>(72, 0x000B, [](Table& t, cigi::WeatherControl& p) {
        t.whole(4, p.layer);
        t.whole(5, p.humidity);
        unsigned bit = 0;
        for (bool* flag : {&p.enable, &p.scud, &p.random_winds, &p.random_lightning}) t.bits(6, bit++, 1, *flag);
        t.bits(6, 4, 4, p.cloud_type);
        t.bits(7, 0, 2, p.scope);
        t.bits(7, 2, 3, p.severity);
        t.bits(7, 5, 1, p.top_scud);
        t.whole(8, p.region);
        std::size_t at = 12;
        for (float* value : {&p.air_temperature, &p.visibility, &p.scud_frequency, &p.coverage, &p.base, &p.thickness,
                             &p.transition, &p.horizontal_wind, &p.vertical_wind, &p.wind_direction, &p.pressure,
                             &p.aerosol, &p.top_scud_frequency, &p.top_transition})
            t.real(at, *value), at += 4;
    });
    judge<cigi::EnvironmentalRegionControl>(48, 0x000A, [](Table& t, cigi::EnvironmentalRegionControl& p) {
        t.bits(4, 0, 2, p.state);
        unsigned bit = 2;
        for (bool* flag : {&p.merge_weather, &p.merge_aerosol, &p.merge_maritime, &p.merge_terrestrial})
            t.bits(4, bit++, 1, *flag);
        t.whole(6, p.region);
        t.real(8, p.latitude);
        t.real(16, p.longitude);
        std::size_t at = 24;
        for (float* value : {&p.size_x, &p.size_y, &p.corner_radius, &p.rotation, &p.transition_perimeter})
            t.real(at, *value), at += 4;
    });
    judge<cigi::ShortComponentControl>(24, 0x0004, [](Table& t, cigi::ShortComponentControl& p) {
        t.whole(4, p.component);
        t.whole(6, p.component_class);
        t.whole(7, p.state);
        t.whole(8, p.instance);
        t.whole(16, p.data[0]);
        t.whole(20, p.data[1]);
    });
    judge<cigi::SensorControl>(32, 0x0010, [](Table& t, cigi::SensorControl& p) {
        t.whole(4, p.sensor);
        unsigned bit = 0;
        for (bool* flag : {&p.on, &p.black_hot, &p.line_dropout, &p.automatic_gain, &p.track_black})
            t.bits(5, bit++, 1, *flag);
        t.bits(5, 5, 3, p.track_mode);
        t.bits(6, 0, 1, p.extended_response);
        t.whole(8, p.view);
        std::size_t at = 12;
        for (float* value : {&p.gain, &p.level, &p.ac_coupling, &p.noise}) t.real(at, *value), at += 4;
    });
    judge<cigi::SensorResponse>(24, 0x0FFB, [](Table& t, cigi::SensorResponse& p) {
        t.whole(4, p.sensor);
        t.bits(5, 0, 2, p.status);
        t.whole(6, p.view);
        t.whole(8, p.gate_width);
        t.whole(10, p.gate_height);
        t.real(12, p.gate_azimuth);
        t.real(16, p.gate_elevation);
        t.whole(20, p.host_frame);
    });
    judge<cigi::SensorExtendedResponse>(56, 0x0FFA, [](Table& t, cigi::SensorExtendedResponse& p) {
        t.whole(4, p.view);
        t.whole(6, p.entity);
        t.whole(8, p.sensor);
        t.bits(9, 0, 2, p.status);
        t.bits(9, 2, 1, p.entity_valid);
        t.whole(12, p.gate_width);
        t.whole(14, p.gate_height);
        t.real(16, p.gate_azimuth);
        t.real(20, p.gate_elevation);
        t.whole(24, p.host_frame);
        t.reals(32, p.track_point);
    });
}

TEST_CASE("Every 4.0 question about the scene, and every answer, has each field where the table says") {
    judge<cigi::HatHotRequest>(40, 0x0017, [](Table& t, cigi::HatHotRequest& p) {
        t.whole(4, p.request);
        t.whole(6, p.entity);
        t.bits(8, 0, 2, p.kind);
        t.bits(8, 2, 1, p.entity_coordinates);
        t.whole(9, p.period);
        t.reals(16, p.point);
    });
    judge<cigi::LosSegmentRequest>(72, 0x0018, [](Table& t, cigi::LosSegmentRequest& p) {
        t.whole(4, p.request);
        t.whole(6, p.entity);
        unsigned bit = 0;
        for (bool* flag :
             {&p.extended, &p.source_entity, &p.destination_entity, &p.response_entity, &p.destination_id_valid})
            t.bits(8, bit++, 1, *flag);
        t.whole(9, p.alpha_threshold);
        t.whole(10, p.destination_id);
        t.whole(12, p.period);
        t.reals(16, p.source);
        t.reals(40, p.destination);
        t.whole(64, p.material_mask);
    });
    judge<cigi::LosVectorRequest>(64, 0x0019, [](Table& t, cigi::LosVectorRequest& p) {
        t.whole(4, p.request);
        t.whole(6, p.entity);
        unsigned bit = 0;
        for (bool* flag : {&p.extended, &p.source_entity, &p.response_entity}) t.bits(8, bit++, 1, *flag);
        t.whole(9, p.alpha_threshold);
        t.whole(10, p.period);
        t.real(16, p.azimuth);
        t.real(20, p.elevation);
        t.real(24, p.least);
        t.real(28, p.most);
        t.reals(32, p.source);
        t.whole(56, p.material_mask);
    });
    judge<cigi::HatHotResponse>(16, 0x0FFF, [](Table& t, cigi::HatHotResponse& p) {
        t.bits(4, 0, 1, p.valid);
        t.bits(4, 1, 1, p.of_terrain);
        t.bits(4, 4, 4, p.host_frame);
        t.whole(6, p.request);
        t.real(8, p.height);
    });
    judge<cigi::HatHotExtendedResponse>(40, 0x0FFE, [](Table& t, cigi::HatHotExtendedResponse& p) {
        t.bits(4, 0, 1, p.valid);
        t.bits(4, 4, 4, p.host_frame);
        t.whole(6, p.request);
        t.real(8, p.above_terrain);
        t.real(16, p.of_terrain);
        t.whole(24, p.material);
        t.real(28, p.normal_azimuth);
        t.real(32, p.normal_elevation);
    });
    judge<cigi::LosResponse>(24, 0x0FFD, [](Table& t, cigi::LosResponse& p) {
        t.whole(4, p.request);
        t.whole(6, p.entity);
        t.bits(8, 0, 1, p.valid);
        t.bits(8, 1, 1, p.entity_valid);
        t.bits(8, 2, 1, p.visible);
        t.bits(8, 4, 4, p.host_frame);
        t.whole(9, p.count);
        t.real(16, p.range);
    });
    judge<cigi::LosExtendedResponse>(64, 0x0FFC, [](Table& t, cigi::LosExtendedResponse& p) {
        t.whole(4, p.request);
        t.whole(6, p.entity);
        unsigned bit = 0;
        for (bool* flag : {&p.valid, &p.entity_valid, &p.range_valid, &p.visible}) t.bits(8, bit++, 1, *flag);
        t.bits(8, 4, 4, p.host_frame);
        t.whole(9, p.count);
        t.real(16, p.range);
        t.reals(24, p.point);
        for (std::size_t i = 0; i < 4; ++i) t.whole(48 + i, p.rgba[i]);
        t.whole(52, p.material);
        t.real(56, p.normal_azimuth);
        t.real(60, p.normal_elevation);
    });
    judge<cigi::CollisionSegmentDefinition>(40, 0x0015, [](Table& t, cigi::CollisionSegmentDefinition& p) {
        t.whole(4, p.segment);
        t.bits(5, 0, 1, p.enable);
        t.whole(6, p.entity);
        t.reals(8, p.from);
        t.reals(20, p.to);
        t.whole(32, p.material_mask);
    });
    judge<cigi::CollisionSegmentNotification>(24, 0x0FF4, [](Table& t, cigi::CollisionSegmentNotification& p) {
        t.whole(4, p.entity);
        t.whole(6, p.other_entity);
        t.whole(8, p.segment);
        t.bits(9, 0, 1, p.with_entity);
        t.whole(12, p.material);
        t.real(16, p.distance);
    });
}
