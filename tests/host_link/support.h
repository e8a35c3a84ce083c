/// What the tests of host_link share: bytes, messages, capture files written from scratch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_link/cigi.h"
#include "host_link/host_state.h"
#include "host_link/wire.h"

namespace quadrig::host::test {

using Bytes = std::vector<std::byte>;

inline constexpr cigi::Format kLittle4{ByteOrder::little, cigi::Version::four};
inline constexpr cigi::Format kBig4{ByteOrder::big, cigi::Version::four};

Bytes from_hex(std::string_view hex);
std::string to_hex(std::span<const std::byte> bytes);

template <class P>
void append(Bytes& message, const P& packet, cigi::Format format) {
    constexpr std::size_t kLargest = 72;
    const std::size_t before = message.size();
    message.resize(before + kLargest);
    message.resize(before + cigi::encode(packet, format, std::span(message).subspan(before)));
}

template <class... P>
Bytes message(cigi::Format format, const P&... packets) {
    Bytes bytes;
    (append(bytes, packets, format), ...);
    return bytes;
}

/// A packet of any id and size, filled with one byte.
Bytes raw_packet(std::uint8_t id, std::uint8_t size, std::uint8_t fill = 0);
Bytes operator+(Bytes left, const Bytes& right);

/// IG Control, operate, with a frame number and a time stamp in 10 us.
cigi::IgControl ig_control(std::uint32_t host_frame, std::uint32_t timestamp = 0);
/// Entity Control of the ownship near 47 N, 11 E.
cigi::EntityControl ownship(double latitude = 47.26, double longitude = 11.34, double altitude = 1000.0);

/// A directory of this test process's own, removed at its end.
std::filesystem::path scratch(const std::string& name);

/// Writes classic pcap (microseconds) by hand, so that the reader under test is not also the writer.
class PcapWriter {
  public:
    explicit PcapWriter(std::uint32_t link_type);
    void packet(std::span<const std::byte> bytes, Time captured, std::size_t cut = 0);
    std::filesystem::path save(const std::string& name) const;
    [[nodiscard]] const Bytes& bytes() const { return bytes_; }

  private:
    Bytes bytes_;
};

struct Endpoints {
    std::uint32_t source = 0x7F000001, destination = 0x7F000001;
    std::uint16_t source_port = 8005, destination_port = 8004;
};
/// An IPv4 packet with a UDP datagram in it; checksums zero.
Bytes ipv4_udp(std::span<const std::byte> payload, const Endpoints& endpoints = {});
Bytes ipv6_udp(std::span<const std::byte> payload, std::uint16_t destination_port = 8004);
Bytes ethernet(const Bytes& packet, std::uint16_t type);

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
Bytes read_file(const std::filesystem::path& path);

/// What tshark reads in a capture: one row a packet, one column a field; columns in the order asked for.
std::vector<std::vector<std::string>> tshark_fields(const std::filesystem::path& capture,
                                                    const std::vector<std::string>& fields);

}  // namespace quadrig::host::test
