#include "host_link/cigi_format.h"

#include <algorithm>
#include <array>

namespace quadrig::host::cigi {

namespace {

constexpr std::uint16_t kFirstExtensionId = 0x1000;
constexpr std::uint16_t kStartOfFrameId = 0xFFFF;

struct Known {
    Kind kind;
    std::string_view name;
    std::uint16_t size, id_in_4, size_in_4;  ///< size 0: no fixed one
};
constexpr std::array kKnown{
    Known{1, "ig_control", 24, 0x0000, 24},
    Known{2, "entity_control", 48, 0x0025, 16},
    Known{3, "conformal_clamped_entity_control", 24, 0x0002, 32},
    Known{4, "component_control", 32, 0x0003, 40},
    Known{5, "short_component_control", 16, 0x0004, 24},
    Known{6, "articulated_part_control", 32, 0x0005, 32},
    Known{7, "short_articulated_part_control", 16, 0x0006, 24},
    Known{8, "rate_control", 32, 0x0007, 32},
    Known{9, "celestial_sphere_control", 16, 0x0008, 24},
    Known{10, "atmosphere_control", 32, 0x0009, 32},
    Known{11, "environmental_region_control", 48, 0x000A, 48},
    Known{12, "weather_control", 56, 0x000B, 72},
    Known{13, "maritime_surface_conditions_control", 24, 0x000C, 24},
    Known{14, "wave_control", 32, 0x000D, 32},
    Known{15, "terrestrial_surface_conditions_control", 8, 0x000E, 16},
    Known{16, "view_control", 32, 0x000F, 40},
    Known{17, "sensor_control", 24, 0x0010, 32},
    Known{18, "motion_tracker_control", 8, 0x0011, 16},
    Known{19, "earth_reference_model_definition", 24, 0x0012, 24},
    Known{20, "trajectory_definition", 24, 0x0013, 32},
    Known{21, "view_definition", 32, 0x0014, 40},
    Known{22, "collision_detection_segment_definition", 40, 0x0015, 40},
    Known{23, "collision_detection_volume_definition", 48, 0x0016, 48},
    Known{24, "hat_hot_request", 32, 0x0017, 40},
    Known{25, "line_of_sight_segment_request", 64, 0x0018, 72},
    Known{26, "line_of_sight_vector_request", 56, 0x0019, 64},
    Known{27, "position_request", 8, 0x001A, 8},
    Known{28, "environmental_conditions_request", 32, 0x001B, 32},
    Known{29, "symbol_surface_definition", 0, 0x001C, 0},
    Known{30, "symbol_text_definition", 0, 0x001D, 0},
    Known{31, "symbol_circle_definition", 0, 0x001E, 0},
    Known{32, "symbol_line_definition", 0, 0x001F, 0},
    Known{33, "symbol_clone", 0, 0x0020, 0},
    Known{34, "symbol_control", 0, 0x0021, 0},
    Known{35, "short_symbol_control", 0, 0x0022, 0},
    Known{101, "start_of_frame", 24, kStartOfFrameId, 24},
    Known{102, "hat_hot_response", 16, 0x0FFF, 16},
    Known{103, "hat_hot_extended_response", 40, 0x0FFE, 40},
    Known{104, "line_of_sight_response", 16, 0x0FFD, 24},
    Known{105, "line_of_sight_extended_response", 56, 0x0FFC, 64},
    Known{106, "sensor_response", 24, 0x0FFB, 24},
    Known{107, "sensor_extended_response", 48, 0x0FFA, 56},
    Known{108, "position_response", 48, 0x0FF9, 48},
    Known{109, "weather_conditions_response", 32, 0x0FF8, 32},
    Known{110, "aerosol_concentration_response", 8, 0x0FF7, 16},
    Known{111, "maritime_surface_conditions_response", 16, 0x0FF6, 24},
    Known{112, "terrestrial_surface_conditions_response", 8, 0x0FF5, 16},
    Known{113, "collision_detection_segment_notification", 16, 0x0FF4, 24},
    Known{114, "collision_detection_volume_notification", 16, 0x0FF3, 16},
    Known{115, "animation_stop_notification", 8, 0x0FF2, 8},
    Known{116, "event_notification", 16, 0x0FF1, 24},
    Known{117, "image_generator_message", 0, 0x0FF0, 0},
    Known{kEntityPosition, "entity_position", 0, 0x0001, 48},
    Known{kAnimationControl, "animation_control", 0, 0x0026, 16},
    Known{kSymbolTexturedCircle, "symbol_textured_circle_definition", 0, 0x0023, 0},
    Known{kSymbolTexturedPolygon, "symbol_textured_polygon_definition", 0, 0x0024, 0},
};
constexpr Kind kFirstUserId = 201, kLastUserId = 255;

constexpr std::uint8_t kNobody = 255;
constexpr auto kPlaceOfKind = [] {
    std::array<std::uint8_t, kKinds> places{};
    places.fill(kNobody);
    for (std::size_t i = 0; i < kKnown.size(); ++i) places[kKnown[i].kind] = static_cast<std::uint8_t>(i);
    return places;
}();

const Known* known(Kind kind) {
    const std::uint8_t place = kind < kKinds ? kPlaceOfKind[kind] : kNobody;
    return place == kNobody ? nullptr : &kKnown[place];
}

}  // namespace

std::string_view packet_name(Kind kind) {
    if ((kind >= kFirstUserId && kind <= kLastUserId) || kind == kExtension4) return "user";
    const Known* packet = known(kind);
    return packet == nullptr ? "unknown" : packet->name;
}

std::optional<std::size_t> fixed_size(Kind kind, Version version) {
    const Known* packet = known(kind);
    const std::uint16_t size = packet == nullptr           ? std::uint16_t{0}
                               : version == Version::three ? packet->size
                                                           : packet->size_in_4;
    return size == 0 ? std::nullopt : std::optional<std::size_t>(size);
}

std::optional<std::uint16_t> id_in_4(Kind kind) {
    const Known* packet = known(kind);
    return packet == nullptr ? std::nullopt : std::optional(packet->id_in_4);
}

Kind kind_in_4(std::uint16_t id) {
    const auto found = std::ranges::find(kKnown, id, &Known::id_in_4);
    if (found != kKnown.end()) return found->kind;
    return id >= kFirstExtensionId ? kExtension4 : kUnknown4;
}

Packet next_packet(std::span<const std::byte>& rest, Format format) {
    Packet packet;
    std::size_t size = 0;
    if (format.version == Version::three) {
        packet.id = std::to_integer<std::uint8_t>(rest[0]);
        size = std::to_integer<std::uint8_t>(rest[1]);
    } else {
        size = load<std::uint16_t>(rest, 0, format.order);
        packet.id = kind_in_4(load<std::uint16_t>(rest, 2, format.order));
    }
    packet.bytes = rest.first(size);
    rest = rest.subspan(size);
    return packet;
}

}  // namespace quadrig::host::cigi
