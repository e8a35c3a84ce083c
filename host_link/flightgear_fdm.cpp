#include "host_link/flightgear_fdm.h"

#include <algorithm>
#include <optional>

#include "host_link/wire.h"

namespace quadrig::host::flightgear {

namespace {

std::size_t size_of(std::uint32_t version) { return version == 24 ? kSize24 : kSize25; }
bool is_known(std::uint32_t version) { return version == 24 || version == 25; }

std::optional<Reject> fault(std::span<const std::byte> datagram) {
    if (datagram.size() < sizeof(std::uint32_t)) return Reject::truncated;
    const auto version = load<std::uint32_t>(datagram, 0, ByteOrder::big);
    if (is_known(version)) {
        if (datagram.size() == size_of(version)) return std::nullopt;
        const bool cut = datagram.size() < size_of(version) && datagram.size() != kSize24;
        return cut ? Reject::truncated : Reject::version_size_mismatch;
    }
    if (is_known(load<std::uint32_t>(datagram, 0, ByteOrder::little))) return Reject::byte_swapped_version;
    return Reject::unknown_version;
}

void layout(auto& wire, auto& p, std::uint32_t version) {
    wire.number(0, p.version);
    wire.number(8, p.longitude);
    wire.number(16, p.latitude);
    wire.number(24, p.altitude);
    wire.number(32, p.height_above_ground);
    wire.number(36, p.phi);
    wire.number(40, p.theta);
    wire.number(44, p.psi);
    wire.number(version == 24 ? 356 : 500, p.cur_time);
    wire.number(version == 24 ? 364 : 508, p.visibility);
}

}  // namespace

std::variant<NetFdm, Reject> decode(std::span<const std::byte> datagram) {
    if (const auto reason = fault(datagram)) return *reason;
    NetFdm packet;
    const Reader wire(datagram, ByteOrder::big);
    layout(wire, packet, load<std::uint32_t>(datagram, 0, ByteOrder::big));
    return packet;
}

std::size_t encode(const NetFdm& packet, std::span<std::byte> out) {
    out = out.first(size_of(packet.version));
    std::ranges::fill(out, std::byte{0});
    Writer wire(out, ByteOrder::big);
    layout(wire, packet, packet.version);
    return out.size();
}

}  // namespace quadrig::host::flightgear
