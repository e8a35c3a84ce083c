#include "tests/appliance/flights.h"

#include <cmath>

#include "host_link/flightgear_fdm.h"
#include "tests/appliance/files.h"

namespace quadrig::tests {
namespace {

constexpr double kLatitude = 47.26, kLongitude = 11.34, kAltitude = 581.0;

}  // namespace

Bytes fdm_message(const Pose& pose, std::uint32_t cur_time) {
    host::flightgear::NetFdm packet;
    packet.latitude = Degrees{kLatitude}.radians();
    packet.longitude = Degrees{kLongitude}.radians();
    packet.altitude = kAltitude + pose.height;
    packet.psi = static_cast<float>(pose.attitude.heading.radians());
    packet.theta = static_cast<float>(pose.attitude.pitch.radians());
    packet.phi = static_cast<float>(pose.attitude.roll.radians());
    packet.cur_time = cur_time;
    Bytes bytes(host::flightgear::kSize24);
    host::flightgear::encode(packet, bytes);
    return bytes;
}

Bytes cigi_message(std::uint32_t host_frame, const Pose& pose, const Bytes& more, host::cigi::Format format) {
    host::cigi::EntityControl entity = host::test::ownship(kLatitude, kLongitude, kAltitude + pose.height);
    entity.yaw = static_cast<float>(pose.attitude.heading.value);
    entity.pitch = static_cast<float>(pose.attitude.pitch.value);
    entity.roll = static_cast<float>(pose.attitude.roll.value);
    Bytes bytes = host::test::message(format, host::test::ig_control(host_frame, host_frame * 1667), entity);
    if (format.version == host::cigi::Version::four)
        host::test::append(bytes, static_cast<const host::cigi::EntityPosition&>(entity), format);
    bytes.insert(bytes.end(), more.begin(), more.end());
    return bytes;
}

std::filesystem::path recording(const std::vector<Bytes>& datagrams, std::uint16_t port,
                                std::chrono::microseconds period) {
    constexpr std::uint32_t kRawIp = 101;
    constexpr std::chrono::seconds kBegin{1'700'000'000};
    host::test::PcapWriter writer(kRawIp);
    std::chrono::microseconds captured = kBegin;
    for (const Bytes& datagram : datagrams) {
        writer.packet(host::test::ipv4_udp(datagram, {.destination_port = port}), captured);
        captured += period;
    }
    auto path = scratch_directory() / "flight.pcap";
    host::test::write_file(path, writer.bytes());
    return path;
}

std::filesystem::path fdm_climb(int count) {
    std::vector<Bytes> datagrams;
    for (int i = 0; i < count; ++i)
        datagrams.push_back(
            fdm_message({14.0 + 0.1 * i, {{360.0 - std::fmod(0.3 * i, 360.0)}, {2.0}, {-std::fmod(0.2 * i, 360.0)}}}));
    return recording(datagrams, 5500);
}

}  // namespace quadrig::tests
