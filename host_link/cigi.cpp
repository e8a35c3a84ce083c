#include "host_link/cigi.h"

#include <array>

#include "host_link/cigi_codec.h"

namespace quadrig::host::cigi {

namespace {

constexpr std::size_t kHeaderSize = 2;
constexpr std::size_t kSizeStep = 8;
constexpr std::uint8_t kFirstUserId = 201;

struct Kind {
    std::string_view name = "unknown";
    std::uint8_t size = 0;  ///< 0: no fixed size
};

constexpr std::array<Kind, 256> packet_kinds() {
    std::array<Kind, 256> kinds{};
    kinds[1] = {"ig_control", 24};
    kinds[2] = {"entity_control", 48};
    kinds[3] = {"conformal_clamped_entity_control", 24};
    kinds[4] = {"component_control", 32};
    kinds[5] = {"short_component_control", 16};
    kinds[6] = {"articulated_part_control", 32};
    kinds[7] = {"short_articulated_part_control", 16};
    kinds[8] = {"rate_control", 32};
    kinds[9] = {"celestial_sphere_control", 16};
    kinds[10] = {"atmosphere_control", 32};
    kinds[11] = {"environmental_region_control", 48};
    kinds[12] = {"weather_control", 56};
    kinds[13] = {"maritime_surface_conditions_control", 24};
    kinds[14] = {"wave_control", 32};
    kinds[15] = {"terrestrial_surface_conditions_control", 8};
    kinds[16] = {"view_control", 32};
    kinds[17] = {"sensor_control", 24};
    kinds[18] = {"motion_tracker_control", 8};
    kinds[19] = {"earth_reference_model_definition", 24};
    kinds[20] = {"trajectory_definition", 24};
    kinds[21] = {"view_definition", 32};
    kinds[22] = {"collision_detection_segment_definition", 40};
    kinds[23] = {"collision_detection_volume_definition", 48};
    kinds[24] = {"hat_hot_request", 32};
    kinds[25] = {"line_of_sight_segment_request", 64};
    kinds[26] = {"line_of_sight_vector_request", 56};
    kinds[27] = {"position_request", 8};
    kinds[28] = {"environmental_conditions_request", 32};
    kinds[29] = {"symbol_surface_definition", 0};
    kinds[30] = {"symbol_text_definition", 0};
    kinds[31] = {"symbol_circle_definition", 0};
    kinds[32] = {"symbol_line_definition", 0};
    kinds[33] = {"symbol_clone", 0};
    kinds[34] = {"symbol_control", 0};
    kinds[35] = {"short_symbol_control", 0};
    kinds[101] = {"start_of_frame", 24};
    kinds[102] = {"hat_hot_response", 16};
    kinds[103] = {"hat_hot_extended_response", 40};
    kinds[104] = {"line_of_sight_response", 16};
    kinds[105] = {"line_of_sight_extended_response", 56};
    kinds[106] = {"sensor_response", 24};
    kinds[107] = {"sensor_extended_response", 48};
    kinds[108] = {"position_response", 48};
    kinds[109] = {"weather_conditions_response", 32};
    kinds[110] = {"aerosol_concentration_response", 8};
    kinds[111] = {"maritime_surface_conditions_response", 16};
    kinds[112] = {"terrestrial_surface_conditions_response", 8};
    kinds[113] = {"collision_detection_segment_notification", 16};
    kinds[114] = {"collision_detection_volume_notification", 16};
    kinds[115] = {"animation_stop_notification", 8};
    kinds[116] = {"event_notification", 16};
    kinds[117] = {"image_generator_message", 0};
    for (std::size_t id = kFirstUserId; id < kinds.size(); ++id) kinds[id] = {"user", 0};
    return kinds;
}
constexpr std::array<Kind, 256> kPacketKinds = packet_kinds();

std::uint8_t byte_at(std::span<const std::byte> bytes, std::size_t offset) {
    return std::to_integer<std::uint8_t>(bytes[offset]);
}

bool has_frame_packet_size(std::size_t size) { return size == IgControl::kSize || size == IgControl::kSizeBefore32; }

bool is_size_of(std::uint8_t id, std::size_t size) {
    if (id == IgControl::kId || id == StartOfFrame::kId) return has_frame_packet_size(size);
    return kPacketKinds[id].size == 0 || kPacketKinds[id].size == size;
}

// CIGI 4.0 carries no byte swap field: u16 size (24), u16 id (0 IG Control, 0xFFFF Start Of Frame), u8 major version.
bool is_cigi_4(std::span<const std::byte> datagram, std::uint16_t first_id) {
    if (datagram.size() < 5 || load<std::uint16_t>(datagram, 2, ByteOrder::big) != first_id ||
        byte_at(datagram, 4) != 4)
        return false;
    const auto size = load<std::uint16_t>(datagram, 0, ByteOrder::big);
    return size == 0x0018 || size == 0x1800;
}

std::optional<ByteOrder> sender_order(std::span<const std::byte> frame_packet) {
    const auto swap = load<std::uint16_t>(frame_packet, 6, ByteOrder::big);
    if (swap == kByteSwap) return ByteOrder::big;
    if (swap == 0x0080) return ByteOrder::little;
    return std::nullopt;
}

std::optional<Reject> first_packet_fault(std::span<const std::byte> datagram) {
    if (is_cigi_4(datagram, 0x0000)) return Reject::cigi_4_0;
    if (is_cigi_4(datagram, 0xFFFF)) return Reject::start_of_frame;
    if (datagram.size() < kHeaderSize) return Reject::truncated;
    if (byte_at(datagram, 0) == StartOfFrame::kId) return Reject::start_of_frame;
    if (byte_at(datagram, 0) != IgControl::kId) return Reject::no_ig_control;
    if (datagram.size() < 3) return Reject::truncated;
    if (byte_at(datagram, 2) != kMajorVersion) return Reject::unknown_version;
    return std::nullopt;
}

std::optional<Reject> packets_fault(std::span<const std::byte> rest) {
    while (!rest.empty()) {
        if (rest.size() < kHeaderSize) return Reject::truncated;
        const std::size_t size = byte_at(rest, 1);
        if (size < kHeaderSize || size % kSizeStep != 0 || !is_size_of(byte_at(rest, 0), size)) return Reject::bad_size;
        if (size > rest.size()) return Reject::truncated;
        rest = rest.subspan(size);
    }
    return std::nullopt;
}

// Each layout is told once, for Reader and for Writer: byte offsets from the start of the packet, bits from the lowest.

void layout(auto& wire, Is<IgControl> auto& p) {
    wire.number(2, p.major_version);
    wire.number(3, p.database);
    wire.bits(4, 0, 2, p.mode);
    wire.bits(4, 2, 1, p.timestamp_valid);
    wire.bits(4, 3, 1, p.smoothing);
    wire.bits(4, 4, 4, p.minor_version);
    wire.number(8, p.host_frame);
    wire.number(12, p.timestamp);
    if (p.last_ig_frame) wire.number(16, *p.last_ig_frame);
}

void layout(auto& wire, Is<StartOfFrame> auto& p) {
    wire.number(2, p.major_version);
    wire.number(3, p.database);
    wire.number(4, p.status);
    wire.bits(5, 0, 2, p.mode);
    wire.bits(5, 2, 1, p.timestamp_valid);
    wire.bits(5, 3, 1, p.host_defined_earth);
    wire.bits(5, 4, 4, p.minor_version);
    wire.number(8, p.ig_frame);
    wire.number(12, p.timestamp);
    if (p.last_host_frame) wire.number(16, *p.last_host_frame);
}

void layout(auto& wire, Is<EntityControl> auto& p) {
    wire.number(2, p.entity);
    wire.bits(4, 0, 2, p.state);
    wire.bits(4, 2, 1, p.attached);
    wire.bits(4, 3, 1, p.collision_detection);
    wire.bits(4, 4, 1, p.inherit_alpha);
    wire.bits(4, 5, 2, p.clamp);
    wire.bits(5, 0, 1, p.animation_backward);
    wire.bits(5, 1, 1, p.animation_loop);
    wire.bits(5, 2, 2, p.animation_state);
    wire.bits(5, 4, 1, p.smoothing);
    wire.number(6, p.alpha);
    wire.number(8, p.type);
    wire.number(10, p.parent);
    wire.number(12, p.roll);
    wire.number(16, p.pitch);
    wire.number(20, p.yaw);
    wire.number(24, p.latitude);
    wire.number(32, p.longitude);
    wire.number(40, p.altitude);
}

void layout(auto& wire, Is<ViewControl> auto& p) {
    wire.number(2, p.view);
    wire.number(4, p.group);
    wire.bits(5, 0, 1, p.x_enable);
    wire.bits(5, 1, 1, p.y_enable);
    wire.bits(5, 2, 1, p.z_enable);
    wire.bits(5, 3, 1, p.roll_enable);
    wire.bits(5, 4, 1, p.pitch_enable);
    wire.bits(5, 5, 1, p.yaw_enable);
    wire.number(6, p.entity);
    wire.number(8, p.x);
    wire.number(12, p.y);
    wire.number(16, p.z);
    wire.number(20, p.roll);
    wire.number(24, p.pitch);
    wire.number(28, p.yaw);
}

void layout(auto& wire, Is<ViewDefinition> auto& p) {
    wire.number(2, p.view);
    wire.number(4, p.group);
    wire.bits(5, 0, 1, p.near_enable);
    wire.bits(5, 1, 1, p.far_enable);
    wire.bits(5, 2, 1, p.left_enable);
    wire.bits(5, 3, 1, p.right_enable);
    wire.bits(5, 4, 1, p.top_enable);
    wire.bits(5, 5, 1, p.bottom_enable);
    wire.bits(5, 6, 2, p.mirror);
    wire.bits(6, 0, 3, p.pixel_replication);
    wire.bits(6, 3, 1, p.orthographic);
    wire.bits(6, 4, 1, p.reorder);
    wire.bits(6, 5, 3, p.view_type);
    wire.number(8, p.near_distance);
    wire.number(12, p.far_distance);
    wire.number(16, p.left);
    wire.number(20, p.right);
    wire.number(24, p.top);
    wire.number(28, p.bottom);
}

void layout(auto& wire, Is<CelestialSphereControl> auto& p) {
    wire.number(2, p.hour);
    wire.number(3, p.minute);
    wire.bits(4, 0, 1, p.ephemeris);
    wire.bits(4, 1, 1, p.sun);
    wire.bits(4, 2, 1, p.moon);
    wire.bits(4, 3, 1, p.stars);
    wire.bits(4, 4, 1, p.date_time_valid);
    wire.number(8, p.date);
    wire.number(12, p.star_intensity);
}

void layout(auto& wire, Is<AtmosphereControl> auto& p) {
    wire.bits(2, 0, 1, p.model);
    wire.number(3, p.humidity);
    wire.number(4, p.air_temperature);
    wire.number(8, p.visibility);
    wire.number(12, p.horizontal_wind);
    wire.number(16, p.vertical_wind);
    wire.number(20, p.wind_direction);
    wire.number(24, p.pressure);
}

// The two packets that open a message grew from 16 to 24 bytes with 3.2 and carry the byte swap field.
template <class P>
constexpr bool kIsFramePacket = P::kId == IgControl::kId || P::kId == StartOfFrame::kId;

auto& counter_since_32(Is<IgControl> auto& p) { return p.last_ig_frame; }
auto& counter_since_32(Is<StartOfFrame> auto& p) { return p.last_host_frame; }

}  // namespace

std::variant<Message, Reject> open_message(std::span<const std::byte> datagram) {
    if (const auto fault = first_packet_fault(datagram)) return *fault;
    if (const auto fault = packets_fault(datagram)) return *fault;
    const auto order = sender_order(datagram);
    if (!order) return Reject::bad_byte_order;
    auto rest = datagram;
    return Message{*order, decode<IgControl>(next_packet(rest).bytes, *order), datagram};
}

Packet next_packet(std::span<const std::byte>& rest) {
    const Packet packet{byte_at(rest, 0), rest.first(byte_at(rest, 1))};
    rest = rest.subspan(packet.bytes.size());
    return packet;
}

std::string_view packet_name(std::uint8_t id) { return kPacketKinds[id].name; }

bool looks_like_host_message(std::span<const std::byte> datagram) {
    if (is_cigi_4(datagram, 0x0000)) return true;
    return datagram.size() >= IgControl::kSizeBefore32 && byte_at(datagram, 0) == IgControl::kId &&
           has_frame_packet_size(byte_at(datagram, 1)) && byte_at(datagram, 2) == kMajorVersion &&
           sender_order(datagram).has_value();
}

template <class P>
P decode(std::span<const std::byte> packet, ByteOrder order) {
    P value;
    if constexpr (kIsFramePacket<P>) {
        if (packet.size() < P::kSize) counter_since_32(value) = std::nullopt;
    }
    const Reader wire(packet, order);
    layout(wire, value);
    return value;
}

template <class P>
std::size_t encode(const P& packet, ByteOrder order, std::span<std::byte> out) {
    std::size_t size = P::kSize;
    if constexpr (kIsFramePacket<P>) {
        if (!counter_since_32(packet)) size = P::kSizeBefore32;
    }
    out = out.first(size);
    std::ranges::fill(out, std::byte{0});
    Writer wire(out, order);
    wire.number(0, P::kId);
    wire.number(1, static_cast<std::uint8_t>(size));
    if constexpr (kIsFramePacket<P>) wire.number(6, kByteSwap);
    layout(wire, packet);
    return size;
}

#define QUADRIG_CIGI_PACKET(P)                                   \
    template P decode<P>(std::span<const std::byte>, ByteOrder); \
    template std::size_t encode<P>(const P&, ByteOrder, std::span<std::byte>);
QUADRIG_CIGI_PACKET(IgControl)
QUADRIG_CIGI_PACKET(StartOfFrame)
QUADRIG_CIGI_PACKET(EntityControl)
QUADRIG_CIGI_PACKET(ViewControl)
QUADRIG_CIGI_PACKET(ViewDefinition)
QUADRIG_CIGI_PACKET(CelestialSphereControl)
QUADRIG_CIGI_PACKET(AtmosphereControl)
#undef QUADRIG_CIGI_PACKET

}  // namespace quadrig::host::cigi
