#include "host_link/cigi_query.h"

#include "host_link/cigi_codec.h"

namespace quadrig::host::cigi {

void layout(auto& wire, Is<HatHotRequest> auto& p) {
    wire.number(2, 4, p.request);
    wire.bits({4, 0}, {8, 0}, 2, p.kind);
    wire.bits({4, 2}, {8, 2}, 1, p.entity_coordinates);
    wire.number(5, 9, p.period);
    wire.number(6, 6, p.entity);
    wire.numbers(8, 16, p.point);
}

void layout(auto& wire, Is<LosSegmentRequest> auto& p) {
    wire.number(2, 4, p.request);
    wire.bits({4, 0}, {8, 0}, 1, p.extended);
    wire.bits({4, 1}, {8, 1}, 1, p.source_entity);
    wire.bits({4, 2}, {8, 2}, 1, p.destination_entity);
    wire.bits({4, 3}, {8, 3}, 1, p.response_entity);
    wire.bits({4, 4}, {8, 4}, 1, p.destination_id_valid);
    wire.number(5, 9, p.alpha_threshold);
    wire.number(6, 6, p.entity);
    wire.numbers(8, 16, p.source);
    wire.numbers(32, 40, p.destination);
    wire.number(56, 64, p.material_mask);
    wire.number(60, 12, p.period);
    wire.number(62, 10, p.destination_id);
}

void layout(auto& wire, Is<LosVectorRequest> auto& p) {
    wire.number(2, 4, p.request);
    wire.bits({4, 0}, {8, 0}, 1, p.extended);
    wire.bits({4, 1}, {8, 1}, 1, p.source_entity);
    wire.bits({4, 2}, {8, 2}, 1, p.response_entity);
    wire.number(5, 9, p.alpha_threshold);
    wire.number(6, 6, p.entity);
    wire.number(8, 16, p.azimuth);
    wire.number(12, 20, p.elevation);
    wire.number(16, 24, p.least);
    wire.number(20, 28, p.most);
    wire.numbers(24, 32, p.source);
    wire.number(48, 56, p.material_mask);
    wire.number(52, 10, p.period);
}

void layout(auto& wire, Is<HatHotResponse> auto& p) {
    wire.number(2, 6, p.request);
    wire.bits({4, 0}, {4, 0}, 1, p.valid);
    wire.bits({4, 1}, {4, 1}, 1, p.of_terrain);
    wire.bits({4, 4}, {4, 4}, 4, p.host_frame);
    wire.number(8, 8, p.height);
}

void layout(auto& wire, Is<HatHotExtendedResponse> auto& p) {
    wire.number(2, 6, p.request);
    wire.bits({4, 0}, {4, 0}, 1, p.valid);
    wire.bits({4, 4}, {4, 4}, 4, p.host_frame);
    wire.number(8, 8, p.above_terrain);
    wire.number(16, 16, p.of_terrain);
    wire.number(24, 24, p.material);
    wire.number(28, 28, p.normal_azimuth);
    wire.number(32, 32, p.normal_elevation);
}

void layout(auto& wire, Is<LosResponse> auto& p) {
    wire.number(2, 4, p.request);
    wire.bits({4, 0}, {8, 0}, 1, p.valid);
    wire.bits({4, 1}, {8, 1}, 1, p.entity_valid);
    wire.bits({4, 2}, {8, 2}, 1, p.visible);
    wire.bits({4, 4}, {8, 4}, 4, p.host_frame);
    wire.number(5, 9, p.count);
    wire.number(6, 6, p.entity);
    wire.number(8, 16, p.range);
}

void layout(auto& wire, Is<LosExtendedResponse> auto& p) {
    wire.number(2, 4, p.request);
    wire.bits({4, 0}, {8, 0}, 1, p.valid);
    wire.bits({4, 1}, {8, 1}, 1, p.entity_valid);
    wire.bits({4, 2}, {8, 2}, 1, p.range_valid);
    wire.bits({4, 3}, {8, 3}, 1, p.visible);
    wire.bits({4, 4}, {8, 4}, 4, p.host_frame);
    wire.number(5, 9, p.count);
    wire.number(6, 6, p.entity);
    wire.number(8, 16, p.range);
    wire.numbers(16, 24, p.point);
    wire.numbers(40, 48, p.rgba);
    wire.number(44, 52, p.material);
    wire.number(48, 56, p.normal_azimuth);
    wire.number(52, 60, p.normal_elevation);
}

void layout(auto& wire, Is<SensorResponse> auto& p) {
    wire.number(2, 6, p.view);
    wire.number(4, 4, p.sensor);
    wire.bits({5, 0}, {5, 0}, 2, p.status);
    wire.number(8, 8, p.gate_width);
    wire.number(10, 10, p.gate_height);
    wire.number(12, 12, p.gate_azimuth);
    wire.number(16, 16, p.gate_elevation);
    wire.number(20, 20, p.host_frame);
}

void layout(auto& wire, Is<SensorExtendedResponse> auto& p) {
    wire.number(2, 4, p.view);
    wire.number(4, 8, p.sensor);
    wire.bits({5, 0}, {9, 0}, 2, p.status);
    wire.bits({5, 2}, {9, 2}, 1, p.entity_valid);
    wire.number(6, 6, p.entity);
    wire.number(8, 12, p.gate_width);
    wire.number(10, 14, p.gate_height);
    wire.number(12, 16, p.gate_azimuth);
    wire.number(16, 20, p.gate_elevation);
    wire.number(20, 24, p.host_frame);
    wire.numbers(24, 32, p.track_point);
}

void layout(auto& wire, Is<CollisionSegmentNotification> auto& p) {
    wire.number(2, 4, p.entity);
    wire.number(4, 8, p.segment);
    wire.bits({5, 0}, {9, 0}, 1, p.with_entity);
    wire.number(6, 6, p.other_entity);
    wire.number(8, 12, p.material);
    wire.number(12, 16, p.distance);
}

QUADRIG_CIGI_PACKET(HatHotRequest)
QUADRIG_CIGI_PACKET(LosSegmentRequest)
QUADRIG_CIGI_PACKET(LosVectorRequest)
QUADRIG_CIGI_PACKET(HatHotResponse)
QUADRIG_CIGI_PACKET(HatHotExtendedResponse)
QUADRIG_CIGI_PACKET(LosResponse)
QUADRIG_CIGI_PACKET(LosExtendedResponse)
QUADRIG_CIGI_PACKET(SensorResponse)
QUADRIG_CIGI_PACKET(SensorExtendedResponse)
QUADRIG_CIGI_PACKET(CollisionSegmentNotification)

std::size_t encode(const IgMessage& packet, Format format, std::span<std::byte> out) {
    const bool three = format.version == Version::three;
    const std::string_view text = packet.text.substr(0, IgMessage::kMostCharacters);
    const std::size_t begin = three ? 4 : 8;
    const std::size_t size = (begin + text.size() + 1 + 7) / 8 * 8;
    out = out.first(size);
    std::ranges::fill(out, std::byte{0});
    Writer wire(out, format.order);
    write_header(wire, IgMessage::kId, size, format.version);
    wire.number(three ? 2 : 4, packet.message);
    std::ranges::copy(std::as_bytes(std::span(text)), out.begin() + static_cast<std::ptrdiff_t>(begin));
    return size;
}

}  // namespace quadrig::host::cigi
