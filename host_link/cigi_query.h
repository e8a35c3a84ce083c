/// CIGI 3.3's questions about the scene and their answers: height above terrain, height of terrain, lines of sight.
/// Pure.
///
/// Structs hold what is on the wire, in the wire's units, as in cigi.h. Source: the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "host_link/wire.h"

namespace quadrig::host::cigi {

enum class HeightKind : std::uint8_t { above_terrain, of_terrain, extended };

struct HatHotRequest {
    static constexpr std::uint8_t kId = 24;
    static constexpr std::size_t kSize = 32;
    std::uint16_t request = 0;
    HeightKind kind = HeightKind::above_terrain;
    bool entity_coordinates = false;
    std::uint8_t period = 0;  ///< 0 once, n every n-th frame (3.2)
    std::uint16_t entity = 0;
    std::array<double, 3> point{};  ///< latitude, longitude (deg), altitude (m), or X, Y, Z in the entity's axes (m)
};

struct LosSegmentRequest {
    static constexpr std::uint8_t kId = 25;
    static constexpr std::size_t kSize = 64;
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
    static constexpr std::uint8_t kId = 26;
    static constexpr std::size_t kSize = 56;
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
    static constexpr std::uint8_t kId = 102;
    static constexpr std::size_t kSize = 16;
    std::uint16_t request = 0;
    bool valid = false;
    bool of_terrain = false;
    std::uint8_t host_frame = 0;  ///< its lowest four bits (3.2)
    double height = 0.0;          ///< m
};

struct HatHotExtendedResponse {
    static constexpr std::uint8_t kId = 103;
    static constexpr std::size_t kSize = 40;
    std::uint16_t request = 0;
    bool valid = false;
    std::uint8_t host_frame = 0;
    double above_terrain = 0.0, of_terrain = 0.0;  ///< m
    std::uint32_t material = 0;
    float normal_azimuth = 0.0F, normal_elevation = 0.0F;  ///< deg
};

struct LosResponse {
    static constexpr std::uint8_t kId = 104;
    static constexpr std::size_t kSize = 16;
    std::uint16_t request = 0;
    bool valid = false, entity_valid = false, visible = false;
    std::uint8_t host_frame = 0;
    std::uint8_t count = 1;  ///< of responses to the one request
    std::uint16_t entity = 0;
    double range = 0.0;  ///< m
};

struct LosExtendedResponse {
    static constexpr std::uint8_t kId = 105;
    static constexpr std::size_t kSize = 56;
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

inline constexpr std::size_t kLargestResponse = LosExtendedResponse::kSize;

// As in cigi.h.
template <class P>
P decode(std::span<const std::byte> packet, ByteOrder order);
template <class P>
std::size_t encode(const P& packet, ByteOrder order, std::span<std::byte> out);

}  // namespace quadrig::host::cigi
