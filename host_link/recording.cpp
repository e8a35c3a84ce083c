#include "host_link/recording.h"

#include <netinet/in.h>

#include <array>
#include <cstring>
#include <utility>

#include "host_link/wire.h"

namespace quadrig::host {

namespace {

constexpr std::uint8_t kTcp = 6, kUdp = 17;
constexpr std::uint16_t kLinkRaw = 101, kLinkCan = 227;
constexpr std::uint8_t kSyn = 2, kPushAck = 0x18, kFinAck = 0x11;

template <class T>
void put(std::string& out, T value, ByteOrder order) {
    std::array<std::byte, sizeof(T)> raw;
    store(std::span(raw), 0, order, value);
    for (const std::byte b : raw) out += static_cast<char>(b);
}
/// pcapng in little-endian order, networks in big-endian.
void file16(std::string& out, std::uint16_t value) { put(out, value, ByteOrder::little); }
void file32(std::string& out, std::uint32_t value) { put(out, value, ByteOrder::little); }
void net8(std::string& out, std::uint8_t value) { put(out, value, ByteOrder::big); }
void net16(std::string& out, std::uint16_t value) { put(out, value, ByteOrder::big); }
void net32(std::string& out, std::uint32_t value) { put(out, value, ByteOrder::big); }

void append(std::string& out, std::span<const std::byte> bytes) {
    out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// A block: type, length, body padded to 32 bits, length again.
std::string pcapng_block(std::uint32_t type, std::string body) {
    body.resize((body.size() + 3) / 4 * 4);
    const auto length = static_cast<std::uint32_t>(body.size() + 12);
    std::string out;
    file32(out, type);
    file32(out, length);
    out += body;
    file32(out, length);
    return out;
}

std::uint16_t port_of(const sockaddr_storage& address) {
    sockaddr_in v4{};
    std::memcpy(&v4, &address, sizeof v4);  // IPv6 has its port at the same place
    return ntohs(v4.sin_port);
}

}  // namespace

RecordingText::RecordingText(Protocol protocol, RecordingFormat format, std::string interface)
    : protocol_(protocol), format_(format), interface_(std::move(interface)) {}

std::string RecordingText::begin() const {
    if (format_ == RecordingFormat::candump) return {};
    std::string section;
    file32(section, 0x1A2B3C4D);
    file16(section, 1);
    file16(section, 0);
    put(section, std::int64_t{-1}, ByteOrder::little);  // the section's length is not known yet
    std::string interface;
    file16(interface, protocol_ == Protocol::canaerospace ? kLinkCan : kLinkRaw);
    file16(interface, 0);
    file32(interface, 0);  // packets are whole
    constexpr std::uint16_t kTimeResolution = 9;
    file16(interface, kTimeResolution);
    file16(interface, 1);
    interface += '\x09';  // 10^-9 s
    interface.resize(interface.size() + 3);
    file32(interface, 0);  // end of the options
    return pcapng_block(0x0A0D0D0A, section) + pcapng_block(1, interface);
}

std::string RecordingText::block(std::span<const char> packet, Time time) const {
    const auto stamp = static_cast<std::uint64_t>(time.count());
    std::string body;
    file32(body, 0);
    file32(body, static_cast<std::uint32_t>(stamp >> 32));
    file32(body, static_cast<std::uint32_t>(stamp));
    file32(body, static_cast<std::uint32_t>(packet.size()));
    file32(body, static_cast<std::uint32_t>(packet.size()));
    body.append(packet.data(), packet.size());
    return pcapng_block(6, body);
}

// The receiver's address is not known of a socket that listens to several: it is told as the loopback address.
std::string RecordingText::ip_packet(const Heard& heard, std::uint8_t protocol, const std::string& segment) const {
    std::string out;
    if (heard.from.ss_family == AF_INET6) {
        sockaddr_in6 from{};
        std::memcpy(&from, &heard.from, sizeof from);
        net32(out, 0x60000000);
        net16(out, static_cast<std::uint16_t>(segment.size()));
        net8(out, protocol);
        net8(out, 64);
        out.append(reinterpret_cast<const char*>(&from.sin6_addr), sizeof from.sin6_addr);
        out.append(reinterpret_cast<const char*>(&in6addr_loopback), sizeof in6addr_loopback);
        return out + segment;
    }
    sockaddr_in from{};
    std::memcpy(&from, &heard.from, sizeof from);
    net16(out, 0x4500);
    net16(out, static_cast<std::uint16_t>(20 + segment.size()));
    net32(out, 0x00004000);  // not to be fragmented
    net8(out, 64);
    net8(out, protocol);
    net16(out, 0);
    net32(out, ntohl(from.sin_addr.s_addr));
    net32(out, INADDR_LOOPBACK);
    return out + segment;
}

std::string RecordingText::tcp_segment(const Heard& heard, std::uint8_t flags, std::uint32_t sequence) {
    std::string segment;
    net16(segment, port_of(heard.from));
    net16(segment, heard.to_port);
    net32(segment, sequence);
    net32(segment, flags == kSyn ? 0 : 1);
    net8(segment, 0x50);
    net8(segment, flags);
    net16(segment, 0xFFFF);
    net32(segment, 0);
    if (flags == kPushAck) append(segment, heard.bytes);
    return ip_packet(heard, kTcp, segment);
}

std::string RecordingText::modbus_piece(const Heard& heard, Time time) {
    const auto next = next_sequence_.find(heard.source);
    if (heard.closes) {
        if (next == next_sequence_.end()) return {};  // nothing of it is in the recording
        const std::uint32_t end = next->second;
        next_sequence_.erase(next);
        return block(tcp_segment(heard, kFinAck, end), time);
    }
    std::uint32_t& sequence = next != next_sequence_.end() ? next->second : next_sequence_[heard.source];
    std::string out;
    if (next == next_sequence_.end()) out = block(tcp_segment(heard, kSyn, sequence++), time);
    out += block(tcp_segment(heard, kPushAck, sequence), time);
    sequence += static_cast<std::uint32_t>(heard.bytes.size());
    return out;
}

std::string RecordingText::piece(const Heard& heard, Time time) {
    switch (protocol_) {
        case Protocol::canaerospace: {
            if (format_ == RecordingFormat::pcapng)
                return block({reinterpret_cast<const char*>(heard.bytes.data()), heard.bytes.size()}, time);
            const auto frame = can_frame(heard.bytes);
            return frame ? candump_line({time, interface_, *frame}) + '\n' : std::string();
        }
        case Protocol::modbus:
            return modbus_piece(heard, time);
        case Protocol::cigi:
        case Protocol::flightgear_fdm:
            break;
    }
    std::string segment;
    net16(segment, port_of(heard.from));
    net16(segment, heard.to_port);
    net16(segment, static_cast<std::uint16_t>(8 + heard.bytes.size()));
    net16(segment, 0);
    append(segment, heard.bytes);
    return block(ip_packet(heard, kUdp, segment), time);
}

}  // namespace quadrig::host
