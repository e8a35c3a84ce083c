#include "host_link/cigi_query.h"

#include "host_link/cigi_codec.h"

namespace quadrig::host::cigi {

namespace {

void triple(auto& wire, std::size_t at, auto& values) {
    for (std::size_t i = 0; i < 3; ++i) wire.number(at + 8 * i, values[i]);
}

void layout(auto& wire, Is<HatHotRequest> auto& p) {
    wire.number(2, p.request);
    wire.bits(4, 0, 2, p.kind);
    wire.bits(4, 2, 1, p.entity_coordinates);
    wire.number(5, p.period);
    wire.number(6, p.entity);
    triple(wire, 8, p.point);
}

void layout(auto& wire, Is<LosSegmentRequest> auto& p) {
    wire.number(2, p.request);
    wire.bits(4, 0, 1, p.extended);
    wire.bits(4, 1, 1, p.source_entity);
    wire.bits(4, 2, 1, p.destination_entity);
    wire.bits(4, 3, 1, p.response_entity);
    wire.bits(4, 4, 1, p.destination_id_valid);
    wire.number(5, p.alpha_threshold);
    wire.number(6, p.entity);
    triple(wire, 8, p.source);
    triple(wire, 32, p.destination);
    wire.number(56, p.material_mask);
    wire.number(60, p.period);
    wire.number(62, p.destination_id);
}

void layout(auto& wire, Is<LosVectorRequest> auto& p) {
    wire.number(2, p.request);
    wire.bits(4, 0, 1, p.extended);
    wire.bits(4, 1, 1, p.source_entity);
    wire.bits(4, 2, 1, p.response_entity);
    wire.number(5, p.alpha_threshold);
    wire.number(6, p.entity);
    wire.number(8, p.azimuth);
    wire.number(12, p.elevation);
    wire.number(16, p.least);
    wire.number(20, p.most);
    triple(wire, 24, p.source);
    wire.number(48, p.material_mask);
    wire.number(52, p.period);
}

void layout(auto& wire, Is<HatHotResponse> auto& p) {
    wire.number(2, p.request);
    wire.bits(4, 0, 1, p.valid);
    wire.bits(4, 1, 1, p.of_terrain);
    wire.bits(4, 4, 4, p.host_frame);
    wire.number(8, p.height);
}

void layout(auto& wire, Is<HatHotExtendedResponse> auto& p) {
    wire.number(2, p.request);
    wire.bits(4, 0, 1, p.valid);
    wire.bits(4, 4, 4, p.host_frame);
    wire.number(8, p.above_terrain);
    wire.number(16, p.of_terrain);
    wire.number(24, p.material);
    wire.number(28, p.normal_azimuth);
    wire.number(32, p.normal_elevation);
}

void layout(auto& wire, Is<LosResponse> auto& p) {
    wire.number(2, p.request);
    wire.bits(4, 0, 1, p.valid);
    wire.bits(4, 1, 1, p.entity_valid);
    wire.bits(4, 2, 1, p.visible);
    wire.bits(4, 4, 4, p.host_frame);
    wire.number(5, p.count);
    wire.number(6, p.entity);
    wire.number(8, p.range);
}

void layout(auto& wire, Is<LosExtendedResponse> auto& p) {
    wire.number(2, p.request);
    wire.bits(4, 0, 1, p.valid);
    wire.bits(4, 1, 1, p.entity_valid);
    wire.bits(4, 2, 1, p.range_valid);
    wire.bits(4, 3, 1, p.visible);
    wire.bits(4, 4, 4, p.host_frame);
    wire.number(5, p.count);
    wire.number(6, p.entity);
    wire.number(8, p.range);
    triple(wire, 16, p.point);
    for (std::size_t i = 0; i < p.rgba.size(); ++i) wire.number(40 + i, p.rgba[i]);
    wire.number(44, p.material);
    wire.number(48, p.normal_azimuth);
    wire.number(52, p.normal_elevation);
}

}  // namespace

template <class P>
P decode(std::span<const std::byte> packet, ByteOrder order) {
    P value;
    const Reader wire(packet, order);
    layout(wire, value);
    return value;
}

template <class P>
std::size_t encode(const P& packet, ByteOrder order, std::span<std::byte> out) {
    out = out.first(P::kSize);
    std::ranges::fill(out, std::byte{0});
    Writer wire(out, order);
    wire.number(0, P::kId);
    wire.number(1, static_cast<std::uint8_t>(P::kSize));
    layout(wire, packet);
    return P::kSize;
}

#define QUADRIG_CIGI_PACKET(P)                                   \
    template P decode<P>(std::span<const std::byte>, ByteOrder); \
    template std::size_t encode<P>(const P&, ByteOrder, std::span<std::byte>);
QUADRIG_CIGI_PACKET(HatHotRequest)
QUADRIG_CIGI_PACKET(LosSegmentRequest)
QUADRIG_CIGI_PACKET(LosVectorRequest)
QUADRIG_CIGI_PACKET(HatHotResponse)
QUADRIG_CIGI_PACKET(HatHotExtendedResponse)
QUADRIG_CIGI_PACKET(LosResponse)
QUADRIG_CIGI_PACKET(LosExtendedResponse)
#undef QUADRIG_CIGI_PACKET

}  // namespace quadrig::host::cigi
