#include "host_link/cigi.h"

namespace quadrig::host::cigi {

namespace {

constexpr std::size_t kSizeStep = 8;

std::uint8_t byte_at(std::span<const std::byte> bytes, std::size_t offset) {
    return std::to_integer<std::uint8_t>(bytes[offset]);
}

bool has_frame_packet_size(std::size_t size) { return size == IgControl::kSize || size == IgControl::kSizeBefore32; }

bool is_size_of(Kind kind, std::size_t size, Version version) {
    if (version == Version::three && (kind == IgControl::kId || kind == StartOfFrame::kId))
        return has_frame_packet_size(size);
    return fixed_size(kind, version).value_or(size) == size;
}

// CIGI 4.0 carries no byte swap field: the first packet's size, 24, tells the byte order. Its ids, 0 and 0xFFFF, read
// alike either way.
std::optional<ByteOrder> order_of_4(std::span<const std::byte> datagram, std::uint16_t first_id) {
    if (datagram.size() < 5 || load<std::uint16_t>(datagram, 2, ByteOrder::big) != first_id ||
        byte_at(datagram, 4) != static_cast<std::uint8_t>(Version::four))
        return std::nullopt;
    const auto size = load<std::uint16_t>(datagram, 0, ByteOrder::big);
    if (size == IgControl::kSize4) return ByteOrder::big;
    if (size == IgControl::kSize4 << 8) return ByteOrder::little;
    return std::nullopt;
}

std::optional<ByteOrder> order_of_3(std::span<const std::byte> frame_packet) {
    const auto swap = load<std::uint16_t>(frame_packet, 6, ByteOrder::big);
    if (swap == 0x8000) return ByteOrder::big;
    if (swap == 0x0080) return ByteOrder::little;
    return std::nullopt;
}

std::optional<Reject> first_packet_fault(std::span<const std::byte> datagram) {
    if (order_of_4(datagram, 0xFFFF)) return Reject::start_of_frame;
    if (datagram.size() < header_size(Version::three)) return Reject::truncated;
    if (byte_at(datagram, 0) == StartOfFrame::kId) return Reject::start_of_frame;
    if (byte_at(datagram, 0) != IgControl::kId) return Reject::no_ig_control;
    if (datagram.size() < 3) return Reject::truncated;
    if (byte_at(datagram, 2) != static_cast<std::uint8_t>(Version::three)) return Reject::unknown_version;
    return std::nullopt;
}

std::optional<Reject> packets_fault(std::span<const std::byte> rest, Format format) {
    const std::size_t header = header_size(format.version);
    while (!rest.empty()) {
        if (rest.size() < header) return Reject::truncated;
        const bool three = format.version == Version::three;
        const std::size_t size = three ? byte_at(rest, 1) : load<std::uint16_t>(rest, 0, format.order);
        const Kind kind = three ? byte_at(rest, 0) : kind_in_4(load<std::uint16_t>(rest, 2, format.order));
        if (size < header || size % kSizeStep != 0 || !is_size_of(kind, size, format.version)) return Reject::bad_size;
        if (size > rest.size()) return Reject::truncated;
        rest = rest.subspan(size);
    }
    return std::nullopt;
}

Message message_of(std::span<const std::byte> datagram, Format format) {
    auto rest = datagram;
    return {format, decode<IgControl>(next_packet(rest, format).bytes, format), datagram};
}

}  // namespace

std::variant<Message, Reject> open_message(std::span<const std::byte> datagram) {
    if (const auto order = order_of_4(datagram, 0x0000)) {
        const Format format{*order, Version::four};
        if (const auto fault = packets_fault(datagram, format)) return *fault;
        return message_of(datagram, format);
    }
    if (const auto fault = first_packet_fault(datagram)) return *fault;
    if (const auto fault = packets_fault(datagram, {})) return *fault;
    const auto order = order_of_3(datagram);
    if (!order) return Reject::bad_byte_order;
    return message_of(datagram, *order);
}

bool looks_like_host_message(std::span<const std::byte> datagram) {
    if (order_of_4(datagram, 0x0000)) return true;
    return datagram.size() >= IgControl::kSizeBefore32 && byte_at(datagram, 0) == IgControl::kId &&
           has_frame_packet_size(byte_at(datagram, 1)) &&
           byte_at(datagram, 2) == static_cast<std::uint8_t>(Version::three) && order_of_3(datagram).has_value();
}

}  // namespace quadrig::host::cigi
