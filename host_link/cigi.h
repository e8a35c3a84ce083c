/// Common Image Generator Interface 3.3, and 3.0 to 3.2 where they agree: bytes to plain structs and back. Pure.
///
/// A datagram is one message: packets back to back, each u8 id, u8 size (of the whole packet), body; sizes are
/// multiples of 8. The sender uses its own byte order and tells it in IG Control's byte swap field. Structs hold what
/// is on the wire, in the wire's units: degrees, metres, seconds; body axes X forward, Y right, Z down. Source:
/// CIGI 3.3 interface control document as read by the CIGI class library 3.3.3 and by Wireshark's dissector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "host_link/reject.h"
#include "host_link/wire.h"

namespace quadrig::host::cigi {

inline constexpr std::uint8_t kMajorVersion = 3;

enum class IgMode : std::uint8_t { standby, operate, debug, offline_maintenance };

struct IgControl {
    static constexpr std::uint8_t kId = 1;
    static constexpr std::size_t kSize = 24;
    static constexpr std::size_t kSizeBefore32 = 16;
    std::uint8_t major_version = kMajorVersion;
    std::uint8_t minor_version = 3;
    std::int8_t database = 0;
    IgMode mode = IgMode::standby;
    bool timestamp_valid = false;
    bool smoothing = false;  ///< 3.3
    std::uint32_t host_frame =
        0;  ///< before 3.2: the one frame counter, the image generator's own in synchronous operation
    std::uint32_t timestamp = 0;                     ///< 10 us since any moment
    std::optional<std::uint32_t> last_ig_frame = 0;  ///< absent before 3.2: the packet is then 16 bytes
};

struct StartOfFrame {
    static constexpr std::uint8_t kId = 101;
    static constexpr std::size_t kSize = 24;
    static constexpr std::size_t kSizeBefore32 = 16;
    std::uint8_t major_version = kMajorVersion;
    std::uint8_t minor_version = 3;
    std::int8_t database = 0;  ///< n loaded, -n loading, -128 not available, 0 left to the image generator
    std::uint8_t status = 0;   ///< 0 normal
    IgMode mode = IgMode::standby;
    bool timestamp_valid = false;
    bool host_defined_earth = false;  ///< false: WGS-84
    std::uint32_t ig_frame = 0;
    std::uint32_t timestamp = 0;                       ///< 10 us
    std::optional<std::uint32_t> last_host_frame = 0;  ///< absent before 3.2
};

enum class EntityState : std::uint8_t { standby, active, destroyed };

struct EntityControl {
    static constexpr std::uint8_t kId = 2;
    static constexpr std::size_t kSize = 48;
    std::uint16_t entity = 0;
    EntityState state = EntityState::active;
    bool attached = false;
    bool collision_detection = false;
    bool inherit_alpha = false;
    std::uint8_t clamp = 0;  ///< 0 none, 1 altitude, 2 altitude and attitude
    bool animation_backward = false;
    bool animation_loop = false;
    std::uint8_t animation_state = 0;  ///< 0 stop, 1 pause, 2 play, 3 continue
    bool smoothing = false;            ///< 3.3
    std::uint8_t alpha = 255;
    std::uint16_t type = 0;
    std::uint16_t parent = 0;
    float roll = 0.0F, pitch = 0.0F, yaw = 0.0F;  ///< deg
    double latitude = 0.0, longitude = 0.0;       ///< deg; offsets forward and right in m if attached
    double altitude = 0.0;                        ///< m above the Earth reference model; offset down if attached
};

struct ViewControl {
    static constexpr std::uint8_t kId = 16;
    static constexpr std::size_t kSize = 32;
    std::uint16_t view = 0;
    std::uint8_t group = 0;  ///< 0: the view id counts
    bool x_enable = false, y_enable = false, z_enable = false, roll_enable = false, pitch_enable = false,
         yaw_enable = false;
    std::uint16_t entity = 0;
    float x = 0.0F, y = 0.0F, z = 0.0F;           ///< m in the entity's body axes
    float roll = 0.0F, pitch = 0.0F, yaw = 0.0F;  ///< deg
};

struct ViewDefinition {
    static constexpr std::uint8_t kId = 21;
    static constexpr std::size_t kSize = 32;
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
    static constexpr std::uint8_t kId = 9;
    static constexpr std::size_t kSize = 16;
    std::uint8_t hour = 0, minute = 0;  ///< UTC
    bool ephemeris = false;             ///< the time of day runs on by itself
    bool sun = false, moon = false, stars = false;
    bool date_time_valid = false;
    std::uint32_t date = 0;       ///< decimal MMDDYYYY
    float star_intensity = 0.0F;  ///< %
};

struct AtmosphereControl {
    static constexpr std::uint8_t kId = 10;
    static constexpr std::size_t kSize = 32;
    bool model = false;
    std::uint8_t humidity = 0;                           ///< %
    float air_temperature = 0.0F;                        ///< C
    float visibility = 0.0F;                             ///< m
    float horizontal_wind = 0.0F, vertical_wind = 0.0F;  ///< m/s, up positive
    float wind_direction = 0.0F;                         ///< deg, where it comes from
    float pressure = 0.0F;                               ///< hPa
};

/// One packet inside a message, header included.
struct Packet {
    std::uint8_t id = 0;
    std::span<const std::byte> bytes;
};

/// A message whose framing is sound: it starts with IG Control, every packet fits, and has the size that its id asks
/// for.
struct Message {
    ByteOrder order = ByteOrder::little;
    IgControl ig_control;
    std::span<const std::byte> packets;  ///< the whole datagram, to be taken apart with next_packet
};

/// Checks a datagram from its first byte to its last. It is sound as a whole or refused as a whole: what follows a
/// wrong size cannot be trusted, and what came before it belongs to a message that nobody sent.
std::variant<Message, Reject> open_message(std::span<const std::byte> datagram);

/// Takes the first packet off `rest`, a tail of Message::packets that is not empty.
Packet next_packet(std::span<const std::byte>& rest);

/// "entity_control", "rate_control"…; "user" for ids 201 to 255, "unknown" for ids without a meaning in 3.3.
std::string_view packet_name(std::uint8_t id);

/// Reads a packet of sound size: P::kId, and P::kSize bytes (for the two frame packets also the size before 3.2).
/// Values are as sent: not yet checked for range.
template <class P>
P decode(std::span<const std::byte> packet, ByteOrder order);

/// Writes a packet; returns its size. `out` holds at least P::kSize bytes. Reserved fields are 0.
template <class P>
std::size_t encode(const P& packet, ByteOrder order, std::span<std::byte> out);

/// Whether a datagram claims to be a host's CIGI 3 or CIGI 4.0 message, whatever is wrong with it further on.
bool looks_like_host_message(std::span<const std::byte> datagram);

}  // namespace quadrig::host::cigi
