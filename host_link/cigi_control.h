/// CIGI's packets that control what is seen, and the two that open a message: bytes to plain structs and back. Pure.
///
/// One struct a packet for 3.x and 4.0 alike; it holds what is on the wire, in the wire's units: degrees, metres,
/// seconds; body axes X forward, Y right, Z down. What only one of the versions has says so and is left alone by the
/// other. Sources: those of cigi_format.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "host_link/cigi_format.h"

namespace quadrig::host::cigi {

enum class IgMode : std::uint8_t { standby, operate, debug, offline_maintenance };

struct IgControl {
    static constexpr Kind kId = 1;
    static constexpr std::size_t kSize = 24;
    static constexpr std::size_t kSize4 = 24;
    static constexpr std::size_t kSizeBefore32 = 16;
    std::uint8_t minor_version = 3;
    std::int8_t database = 0;
    IgMode mode = IgMode::standby;
    bool timestamp_valid = false;
    bool smoothing = false;         ///< 3.3
    bool substitute_types = false;  ///< 4.0: entities of unknown types may be shown as something else
    /// Before 3.2: the one frame counter, the image generator's own in synchronous operation.
    std::uint32_t host_frame = 0;
    std::uint32_t timestamp = 0;                     ///< 10 us since any moment
    std::optional<std::uint32_t> last_ig_frame = 0;  ///< absent before 3.2: the packet is then 16 bytes
};

struct StartOfFrame {
    static constexpr Kind kId = 101;
    static constexpr std::size_t kSize = 24;
    static constexpr std::size_t kSize4 = 24;
    static constexpr std::size_t kSizeBefore32 = 16;
    std::uint8_t minor_version = 3;
    std::int8_t database = 0;  ///< n loaded, -n loading, -128 not available, 0 left to the image generator
    std::uint8_t status = 0;   ///< 3.x: 0 normal
    IgMode mode = IgMode::standby;
    bool timestamp_valid = false;
    bool host_defined_earth = false;  ///< false: WGS-84
    std::uint32_t ig_frame = 0;
    std::uint32_t timestamp = 0;                       ///< 10 us
    std::optional<std::uint32_t> last_host_frame = 0;  ///< absent before 3.2
    std::uint16_t conditions = 0;                      ///< 4.0: kOverframing and its like, added up
    static constexpr std::uint16_t kOverframing = 0x0100, kPaging = 0x0200, kExcessVariableLengthData = 0x0400;
};

enum class EntityState : std::uint8_t { standby, active, destroyed };

/// A packet of its own in 4.0; in 3.x a part of Entity Control.
struct EntityPosition {
    static constexpr Kind kId = kEntityPosition;
    static constexpr std::size_t kSize4 = 48;
    std::uint16_t entity = 0;
    bool attached = false;
    std::uint8_t clamp = 0;  ///< 0 none, 1 altitude, 2 altitude and attitude
    std::uint16_t parent = 0;
    float roll = 0.0F, pitch = 0.0F, yaw = 0.0F;  ///< deg
    double latitude = 0.0, longitude = 0.0;       ///< deg; offsets forward and right in m if attached
    double altitude = 0.0;                        ///< m above the Earth reference model; offset down if attached
};

/// What 4.0 has in packets of their own is left alone there: the position, and animation.
struct EntityControl : EntityPosition {
    static constexpr Kind kId = 2;
    static constexpr std::size_t kSize = 48;
    static constexpr std::size_t kSize4 = 16;
    EntityState state = EntityState::active;
    bool collision_detection = false;
    bool inherit_alpha = false;
    bool smoothing = false;  ///< 3.3
    std::uint8_t alpha = 255;
    std::uint16_t type = 0;
    bool animation_backward = false;
    bool animation_loop = false;
    std::uint8_t animation_state = 0;  ///< 0 stop, 1 pause, 2 play, 3 continue
    /// 4.0: the type is one of SISO-REF-010, `type` the country in it.
    bool extended_type = false;
    std::uint8_t kind = 0, domain = 0, category = 0, subcategory = 0, specific = 0, extra = 0;
};

/// 4.0's Velocity Control.
struct RateControl {
    static constexpr Kind kId = 8;
    static constexpr std::size_t kSize = 32;
    static constexpr std::size_t kSize4 = 32;
    std::uint16_t entity = 0;
    std::uint8_t part = 0;
    bool apply_to_part = false;
    bool local = false;                           ///< 3.2: in the entity's own axes, not its parent's or the level ones
    float x = 0.0F, y = 0.0F, z = 0.0F;           ///< m/s
    float roll = 0.0F, pitch = 0.0F, yaw = 0.0F;  ///< deg/s
};

struct ViewControl {
    static constexpr Kind kId = 16;
    static constexpr std::size_t kSize = 32;
    static constexpr std::size_t kSize4 = 40;
    std::uint16_t view = 0;
    std::uint8_t group = 0;  ///< 0: the view id counts
    bool x_enable = false, y_enable = false, z_enable = false, roll_enable = false, pitch_enable = false,
         yaw_enable = false;
    std::uint16_t entity = 0;
    float x = 0.0F, y = 0.0F, z = 0.0F;           ///< m in the entity's body axes
    float roll = 0.0F, pitch = 0.0F, yaw = 0.0F;  ///< deg
};

struct ViewDefinition {
    static constexpr Kind kId = 21;
    static constexpr std::size_t kSize = 32;
    static constexpr std::size_t kSize4 = 40;
    std::uint16_t view = 0;
    std::uint8_t group = 0;
    bool near_enable = false, far_enable = false, left_enable = false, right_enable = false, top_enable = false,
         bottom_enable = false;
    std::uint8_t mirror = 0;             ///< 0 none, 1 horizontal, 2 vertical, 3 both
    std::uint8_t pixel_replication = 0;  ///< 0 none
    bool orthographic = false;
    bool reorder = false;
    std::uint8_t view_type = 0;
    float near_distance = 0.0F, far_distance = 0.0F;             ///< m
    float left = 0.0F, right = 0.0F, top = 0.0F, bottom = 0.0F;  ///< deg, left and bottom negative
};

struct CelestialSphereControl {
    static constexpr Kind kId = 9;
    static constexpr std::size_t kSize = 16;
    static constexpr std::size_t kSize4 = 24;
    std::uint8_t hour = 0, minute = 0;  ///< UTC
    float seconds = 0.0F;               ///< 4.0
    bool ephemeris = false;             ///< the time of day runs on by itself
    bool sun = false, moon = false, stars = false;
    bool date_time_valid = false;
    std::uint32_t date = 0;       ///< decimal MMDDYYYY
    float star_intensity = 0.0F;  ///< %
};

struct AtmosphereControl {
    static constexpr Kind kId = 10;
    static constexpr std::size_t kSize = 32;
    static constexpr std::size_t kSize4 = 32;
    bool model = false;
    std::uint8_t humidity = 0;                           ///< %
    float air_temperature = 0.0F;                        ///< C
    float visibility = 0.0F;                             ///< m
    float horizontal_wind = 0.0F, vertical_wind = 0.0F;  ///< m/s, up positive
    float wind_direction = 0.0F;                         ///< deg, where it comes from
    float pressure = 0.0F;                               ///< hPa
};

enum class WeatherScope : std::uint8_t { global, regional, entity, reserved };

/// A layer of weather.
struct WeatherControl {
    static constexpr Kind kId = 12;
    static constexpr std::size_t kSize = 56;
    static constexpr std::size_t kSize4 = 72;
    std::uint16_t region = 0;  ///< or entity
    std::uint8_t layer = 0;    ///< 0 ground fog, 1 to 3 clouds, 4 to 9 rain, snow, sleet, hail, sand, dust
    std::uint8_t humidity = 0;
    bool enable = false, scud = false, random_winds = false, random_lightning = false;
    std::uint8_t cloud_type = 0;
    WeatherScope scope = WeatherScope::global;
    std::uint8_t severity = 0;
    bool top_scud = false;                               ///< 4.0
    float air_temperature = 0.0F;                        ///< C
    float visibility = 0.0F;                             ///< m, inside
    float scud_frequency = 0.0F, coverage = 0.0F;        ///< %
    float base = 0.0F, thickness = 0.0F;                 ///< m; the base above the Earth reference model
    float transition = 0.0F;                             ///< m
    float horizontal_wind = 0.0F, vertical_wind = 0.0F;  ///< m/s
    float wind_direction = 0.0F;                         ///< deg, where it comes from
    float pressure = 0.0F;                               ///< hPa
    float aerosol = 0.0F;                                ///< g/m3
    float top_scud_frequency = 0.0F;                     ///< 4.0, %
    float top_transition = 0.0F;                         ///< 4.0, m
};

enum class RegionState : std::uint8_t { inactive, active, destroyed, reserved };

/// A rounded rectangle on the ground that Weather Control may give weather of its own.
struct EnvironmentalRegionControl {
    static constexpr Kind kId = 11;
    static constexpr std::size_t kSize = 48;
    static constexpr std::size_t kSize4 = 48;
    std::uint16_t region = 0;
    RegionState state = RegionState::inactive;
    bool merge_weather = false, merge_aerosol = false, merge_maritime = false, merge_terrestrial = false;
    double latitude = 0.0, longitude = 0.0;  ///< deg, of its middle
    float size_x = 0.0F, size_y = 0.0F;      ///< m
    float corner_radius = 0.0F;              ///< m
    float rotation = 0.0F;                   ///< deg clockwise; without, X is north and Y east
    float transition_perimeter = 0.0F;       ///< m
};

/// Of 3.3; 3.0 to 3.2 have narrower numbers.
struct ShortComponentControl {
    static constexpr Kind kId = 5;
    static constexpr std::size_t kSize = 16;
    static constexpr std::size_t kSize4 = 24;
    static constexpr std::uint8_t kSystem = 13;  ///< the class that is left to image generators
    std::uint16_t component = 0, instance = 0;
    std::uint8_t component_class = 0, state = 0;
    std::array<std::uint32_t, 2> data{};
};

struct SensorControl {
    static constexpr Kind kId = 17;
    static constexpr std::size_t kSize = 24;
    static constexpr std::size_t kSize4 = 32;
    std::uint16_t view = 0;
    std::uint8_t sensor = 0;
    bool on = false, black_hot = false, line_dropout = false, automatic_gain = false, track_black = false;
    std::uint8_t track_mode = 0;  ///< 0 off
    bool extended_response = false;
    float gain = 0.0F, level = 0.0F, ac_coupling = 0.0F, noise = 0.0F;
};

/// A line on an entity that tells when it meets something.
struct CollisionSegmentDefinition {
    static constexpr Kind kId = 22;
    static constexpr std::size_t kSize = 40;
    static constexpr std::size_t kSize4 = 40;
    std::uint16_t entity = 0;
    std::uint8_t segment = 0;
    bool enable = false;
    std::array<float, 3> from{}, to{};  ///< m, in the entity's axes
    std::uint32_t material_mask = 0;
};

/// Reads a packet of sound size: P::kId, and P::kSize bytes, or P::kSize4 in 4.0 (for the two frame packets also the
/// size before 3.2). Values are as sent: not yet checked for range.
template <class P>
P decode(std::span<const std::byte> packet, Format format);

/// Writes a packet; returns its size. `out` holds at least that many bytes. Reserved fields are 0.
template <class P>
std::size_t encode(const P& packet, Format format, std::span<std::byte> out);

}  // namespace quadrig::host::cigi
