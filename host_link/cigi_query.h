/// CIGI's questions about the scene, their answers, and what else an image generator tells: heights above and of
/// terrain, lines of sight, collisions, sensors, messages. Pure.
///
/// Structs hold what is on the wire, in the wire's units, as in cigi_control.h. Sources: the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "host_link/cigi_format.h"

namespace quadrig::host::cigi {

enum class HeightKind : std::uint8_t { above_terrain, of_terrain, extended };

struct HatHotRequest {
    static constexpr Kind kId = 24;
    static constexpr std::size_t kSize = 32;
    static constexpr std::size_t kSize4 = 40;
    std::uint16_t request = 0;
    HeightKind kind = HeightKind::above_terrain;
    bool entity_coordinates = false;
    std::uint8_t period = 0;  ///< 0 once, n every n-th frame (3.2)
    std::uint16_t entity = 0;
    std::array<double, 3> point{};  ///< latitude, longitude (deg), altitude (m), or X, Y, Z in the entity's axes (m)
};

struct LosSegmentRequest {
    static constexpr Kind kId = 25;
    static constexpr std::size_t kSize = 64;
    static constexpr std::size_t kSize4 = 72;
    std::uint16_t request = 0;
    bool extended = false;
    bool source_entity = false, destination_entity = false, response_entity = false;  ///< coordinates
    bool destination_id_valid = false;
    std::uint8_t alpha_threshold = 0;
    std::uint16_t entity = 0;
    std::array<double, 3> source{}, destination{};
    std::uint32_t material_mask = 0;
    std::uint8_t period = 0;
    std::uint16_t destination_id = 0;
};

struct LosVectorRequest {
    static constexpr Kind kId = 26;
    static constexpr std::size_t kSize = 56;
    static constexpr std::size_t kSize4 = 64;
    std::uint16_t request = 0;
    bool extended = false;
    bool source_entity = false, response_entity = false;
    std::uint8_t alpha_threshold = 0;
    std::uint16_t entity = 0;
    float azimuth = 0.0F, elevation = 0.0F;  ///< deg, from true north and the horizon, or from the entity's axes
    float least = 0.0F, most = 0.0F;         ///< m
    std::array<double, 3> source{};
    std::uint32_t material_mask = 0;
    std::uint8_t period = 0;
};

struct HatHotResponse {
    static constexpr Kind kId = 102;
    static constexpr std::size_t kSize = 16;
    static constexpr std::size_t kSize4 = 16;
    std::uint16_t request = 0;
    bool valid = false;
    bool of_terrain = false;
    std::uint8_t host_frame = 0;  ///< its lowest four bits (3.2)
    double height = 0.0;          ///< m
};

struct HatHotExtendedResponse {
    static constexpr Kind kId = 103;
    static constexpr std::size_t kSize = 40;
    static constexpr std::size_t kSize4 = 40;
    std::uint16_t request = 0;
    bool valid = false;
    std::uint8_t host_frame = 0;
    double above_terrain = 0.0, of_terrain = 0.0;  ///< m
    std::uint32_t material = 0;
    float normal_azimuth = 0.0F, normal_elevation = 0.0F;  ///< deg
};

struct LosResponse {
    static constexpr Kind kId = 104;
    static constexpr std::size_t kSize = 16;
    static constexpr std::size_t kSize4 = 24;
    std::uint16_t request = 0;
    bool valid = false, entity_valid = false, visible = false;
    std::uint8_t host_frame = 0;
    std::uint8_t count = 1;  ///< of responses to the one request
    std::uint16_t entity = 0;
    double range = 0.0;  ///< m
};

struct LosExtendedResponse {
    static constexpr Kind kId = 105;
    static constexpr std::size_t kSize = 56;
    static constexpr std::size_t kSize4 = 64;
    std::uint16_t request = 0;
    bool valid = false, entity_valid = false, range_valid = false, visible = false;
    std::uint8_t host_frame = 0;
    std::uint8_t count = 1;
    std::uint16_t entity = 0;
    double range = 0.0;
    std::array<double, 3> point{};
    std::array<std::uint8_t, 4> rgba{};
    std::uint32_t material = 0;
    float normal_azimuth = 0.0F, normal_elevation = 0.0F;
};

/// The gate is where the sensor tracks; without a track, in its middle.
struct SensorResponse {
    static constexpr Kind kId = 106;
    static constexpr std::size_t kSize = 24;
    static constexpr std::size_t kSize4 = 24;
    std::uint16_t view = 0;
    std::uint8_t sensor = 0;
    std::uint8_t status = 0;                           ///< 0 searching, 1 tracking, 2 impending break, 3 break
    std::uint16_t gate_width = 0, gate_height = 0;     ///< pixels
    float gate_azimuth = 0.0F, gate_elevation = 0.0F;  ///< deg
    std::uint32_t host_frame = 0;
};

/// Says beside it what is tracked; without a track, nothing.
struct SensorExtendedResponse : SensorResponse {
    static constexpr Kind kId = 107;
    static constexpr std::size_t kSize = 48;
    static constexpr std::size_t kSize4 = 56;
    bool entity_valid = false;
    std::uint16_t entity = 0;
    std::array<double, 3> track_point{};  ///< latitude, longitude (deg), altitude (m)
};

struct CollisionSegmentNotification {
    static constexpr Kind kId = 113;
    static constexpr std::size_t kSize = 16;
    static constexpr std::size_t kSize4 = 24;
    std::uint16_t entity = 0;
    std::uint8_t segment = 0;
    bool with_entity = false;
    std::uint16_t other_entity = 0;
    std::uint32_t material = 0;
    float distance = 0.0F;  ///< m from the segment's first point
};

/// Text for people at the host; of any size on the wire.
struct IgMessage {
    static constexpr Kind kId = 117;
    static constexpr std::size_t kMostCharacters = 55;
    std::uint16_t message = 0;
    std::string_view text;  ///< of more characters, the first kMostCharacters are sent
};
/// Writes a message; returns its size, a multiple of 8.
std::size_t encode(const IgMessage& packet, Format format, std::span<std::byte> out);

inline constexpr std::size_t kLargestResponse = LosExtendedResponse::kSize4;

// As in cigi_control.h.
template <class P>
P decode(std::span<const std::byte> packet, Format format);
template <class P>
std::size_t encode(const P& packet, Format format, std::span<std::byte> out);

}  // namespace quadrig::host::cigi
