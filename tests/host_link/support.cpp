#include "support.h"

#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace quadrig::host::test {

namespace {

template <class T>
void put(Bytes& bytes, T value, ByteOrder order) {
    bytes.resize(bytes.size() + sizeof(T));
    store(bytes, bytes.size() - sizeof(T), order, value);
}

struct ScratchDirectory {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("quadrig-host-link-" + std::to_string(getpid()));
    ScratchDirectory() { std::filesystem::create_directories(path); }
    ~ScratchDirectory() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    ScratchDirectory(const ScratchDirectory&) = delete;
    ScratchDirectory& operator=(const ScratchDirectory&) = delete;
};

}  // namespace

Bytes from_hex(std::string_view hex) {
    Bytes bytes;
    std::string digits;
    for (const char c : hex) {
        if (c == ' ') continue;
        digits += c;
        if (digits.size() < 2) continue;
        bytes.push_back(static_cast<std::byte>(std::stoi(digits, nullptr, 16)));
        digits.clear();
    }
    return bytes;
}

std::string to_hex(std::span<const std::byte> bytes) {
    std::string hex;
    for (const std::byte b : bytes) {
        hex += "0123456789abcdef"[std::to_integer<unsigned>(b) >> 4];
        hex += "0123456789abcdef"[std::to_integer<unsigned>(b) & 15U];
    }
    return hex;
}

Bytes raw_packet(std::uint8_t id, std::uint8_t size, std::uint8_t fill) {
    Bytes bytes(std::max<std::size_t>(size, 2), std::byte{fill});
    bytes[0] = std::byte{id};
    bytes[1] = std::byte{size};
    return bytes;
}

Bytes operator+(Bytes left, const Bytes& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

cigi::IgControl ig_control(std::uint32_t host_frame, std::uint32_t timestamp) {
    cigi::IgControl packet;
    packet.mode = cigi::IgMode::operate;
    packet.timestamp_valid = true;
    packet.host_frame = host_frame;
    packet.timestamp = timestamp;
    return packet;
}

cigi::EntityControl ownship(double latitude, double longitude, double altitude) {
    cigi::EntityControl packet;
    packet.latitude = latitude;
    packet.longitude = longitude;
    packet.altitude = altitude;
    return packet;
}

std::filesystem::path scratch(const std::string& name) {
    static const ScratchDirectory directory;
    return directory.path / name;
}

PcapWriter::PcapWriter(std::uint32_t link_type) {
    put<std::uint32_t>(bytes_, 0xa1b2c3d4, ByteOrder::little);
    put<std::uint16_t>(bytes_, 2, ByteOrder::little);
    put<std::uint16_t>(bytes_, 4, ByteOrder::little);
    put<std::uint64_t>(bytes_, 0, ByteOrder::little);
    put<std::uint32_t>(bytes_, 65535, ByteOrder::little);
    put<std::uint32_t>(bytes_, link_type, ByteOrder::little);
}

void PcapWriter::packet(std::span<const std::byte> bytes, Time captured, std::size_t cut) {
    const auto microseconds = captured / std::chrono::microseconds(1);
    put(bytes_, static_cast<std::uint32_t>(microseconds / 1000000), ByteOrder::little);
    put(bytes_, static_cast<std::uint32_t>(microseconds % 1000000), ByteOrder::little);
    put(bytes_, static_cast<std::uint32_t>(bytes.size() - cut), ByteOrder::little);
    put(bytes_, static_cast<std::uint32_t>(bytes.size()), ByteOrder::little);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end() - static_cast<std::ptrdiff_t>(cut));
}

std::filesystem::path PcapWriter::save(const std::string& name) const {
    auto path = scratch(name);
    write_file(path, bytes_);
    return path;
}

Bytes ipv4_udp(std::span<const std::byte> payload, const Endpoints& endpoints) {
    Bytes packet;
    put<std::uint16_t>(packet, 0x4500, ByteOrder::big);
    put(packet, static_cast<std::uint16_t>(28 + payload.size()), ByteOrder::big);
    put<std::uint32_t>(packet, 0, ByteOrder::big);
    put<std::uint16_t>(packet, 0x4011, ByteOrder::big);  // time to live 64, UDP
    put<std::uint16_t>(packet, 0, ByteOrder::big);
    put(packet, endpoints.source, ByteOrder::big);
    put(packet, endpoints.destination, ByteOrder::big);
    put(packet, endpoints.source_port, ByteOrder::big);
    put(packet, endpoints.destination_port, ByteOrder::big);
    put(packet, static_cast<std::uint16_t>(8 + payload.size()), ByteOrder::big);
    put<std::uint16_t>(packet, 0, ByteOrder::big);
    packet.insert(packet.end(), payload.begin(), payload.end());
    return packet;
}

Bytes ipv6_udp(std::span<const std::byte> payload, std::uint16_t destination_port) {
    Bytes packet;
    put<std::uint32_t>(packet, 0x60000000, ByteOrder::big);
    put(packet, static_cast<std::uint16_t>(8 + payload.size()), ByteOrder::big);
    put<std::uint16_t>(packet, 0x1140, ByteOrder::big);  // UDP, hop limit 64
    for (int end = 0; end < 2; ++end) {
        put<std::uint64_t>(packet, 0, ByteOrder::big);
        put<std::uint64_t>(packet, 1, ByteOrder::big);
    }
    put<std::uint16_t>(packet, 8005, ByteOrder::big);
    put(packet, destination_port, ByteOrder::big);
    put(packet, static_cast<std::uint16_t>(8 + payload.size()), ByteOrder::big);
    put<std::uint16_t>(packet, 0, ByteOrder::big);
    packet.insert(packet.end(), payload.begin(), payload.end());
    return packet;
}

Bytes ethernet(const Bytes& packet, std::uint16_t type) {
    Bytes frame(12);
    put(frame, type, ByteOrder::big);
    return frame + packet;
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

Bytes read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    const auto bytes = std::as_bytes(std::span(content));
    return {bytes.begin(), bytes.end()};
}

std::vector<std::vector<std::string>> tshark_fields(const std::filesystem::path& capture,
                                                    const std::vector<std::string>& fields) {
    std::string command = "tshark -r '" + capture.string() + "' -T fields -E separator='|'";
    for (const auto& field : fields) command += " -e " + field;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>/dev/null").c_str(), "r"), &pclose);
    if (!pipe) throw std::runtime_error("cannot run a shell");
    std::string output;
    std::array<char, 4096> part{};
    while (const auto count = std::fread(part.data(), 1, part.size(), pipe.get())) output.append(part.data(), count);
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        auto& row = rows.emplace_back();
        std::istringstream cells(line + '|');
        for (std::string cell; std::getline(cells, cell, '|');) row.push_back(cell);
    }
    if (rows.empty()) throw std::runtime_error("tshark gave nothing; is it installed? " + command);
    return rows;
}

}  // namespace quadrig::host::test
