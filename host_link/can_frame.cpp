#include "host_link/can_frame.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "host_link/read_number.h"
#include "host_link/wire.h"

namespace quadrig::host {

namespace {

constexpr std::uint32_t kExtended = 1U << 31, kRemote = 1U << 30, kError = 1U << 29;
constexpr std::uint32_t kStandardMask = 0x7FF, kExtendedMask = 0x1FFFFFFF;
constexpr std::size_t kHeader = 8;
/// In the record's FD flags, as in Linux: a CAN FD frame.
constexpr std::byte kFdFrame{4};
constexpr std::size_t kFdDataSize = 64;
constexpr std::size_t kStandardDigits = 3, kExtendedDigits = 8;

CanFrame from_flags(std::uint32_t id_and_flags) {
    CanFrame frame;
    frame.extended = (id_and_flags & kExtended) != 0;
    frame.remote = (id_and_flags & kRemote) != 0;
    frame.error = (id_and_flags & kError) != 0;
    frame.id = id_and_flags & (frame.extended ? kExtendedMask : kStandardMask);
    return frame;
}

/// Takes the next blank-separated word off `text`.
std::string_view word(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const std::string_view first = text.substr(0, text.find(' '));
    text.remove_prefix(first.size());
    return first;
}

std::optional<Time> candump_time(std::string_view stamp) {
    if (stamp.size() < 2 || stamp.front() != '(' || stamp.back() != ')') return std::nullopt;
    stamp = stamp.substr(1, stamp.size() - 2);
    const auto point = stamp.find('.');
    if (point == std::string_view::npos) return std::nullopt;
    const std::string_view digits = stamp.substr(point + 1);
    const auto seconds = read_number<std::uint32_t>(stamp.substr(0, point));
    const auto fraction = read_number<std::uint32_t>(digits);
    if (!seconds || !fraction) return std::nullopt;
    // Microseconds, or nanoseconds from can-utils of 2024 on.
    if (digits.size() == 6) return std::chrono::seconds(*seconds) + std::chrono::microseconds(*fraction);
    if (digits.size() == 9) return std::chrono::seconds(*seconds) + std::chrono::nanoseconds(*fraction);
    return std::nullopt;
}

/// A length code above 8, as the bus had it: the frame has 8 bytes all the same.
bool is_raw_length(std::string_view text) {
    return text.size() == 2 && text[0] == '_' &&
           read_number<std::uint8_t>(text.substr(1), 16).value_or(0) > kCanDataSize;
}

/// What stands behind "ID##": a digit of flags, and data.
bool is_fd_data(std::string_view text) {
    const auto is_digit = [](char c) { return read_number<std::uint8_t>({&c, 1}, 16).has_value(); };
    if (text.empty() || !is_digit(text.front())) return false;
    std::string digits(text.substr(1));
    std::erase(digits, '.');
    return digits.size() % 2 == 0 && digits.size() <= 2 * kFdDataSize && std::ranges::all_of(digits, is_digit);
}

std::optional<CanFrame> candump_frame(std::string_view text) {
    const auto hash = text.find('#');
    if (hash != kStandardDigits && hash != kExtendedDigits) return std::nullopt;
    const auto id = read_number<std::uint32_t>(text.substr(0, hash), 16);
    if (!id || (hash == kStandardDigits && *id > kStandardMask)) return std::nullopt;
    CanFrame frame;
    frame.extended = hash == kExtendedDigits;
    frame.error = frame.extended && (*id & kError) != 0;
    frame.id = *id & (frame.extended ? kExtendedMask : kStandardMask);
    std::string_view data = text.substr(hash + 1);
    if (!data.empty() && (data.front() == 'R' || data.front() == 'r')) {
        frame.remote = true;
        return frame;
    }
    if (data.starts_with('#')) {
        frame.fd = true;
        return is_fd_data(data.substr(1)) ? std::optional(frame) : std::nullopt;
    }
    while (!data.empty()) {
        if (frame.size == kCanDataSize && is_raw_length(data)) break;
        if (data.front() == '.') data.remove_prefix(1);
        const auto byte = read_number<std::uint8_t>(data.substr(0, 2), 16);
        if (!byte || data.size() < 2 || frame.size == kCanDataSize) return std::nullopt;
        frame.data[frame.size++] = std::byte{*byte};
        data.remove_prefix(2);
    }
    return frame;
}

/// As Linux allows interfaces to be called (IFNAMSIZ).
bool is_interface(std::string_view name) {
    constexpr std::size_t kLongest = 15;
    const auto shows = [](char c) { return c > ' ' && c != '\x7f'; };
    return !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, shows);
}

}  // namespace

std::optional<CanFrame> can_frame(std::span<const std::byte> record) {
    if (record.size() < kHeader) return std::nullopt;
    CanFrame frame = from_flags(load<std::uint32_t>(record, 0, ByteOrder::big));
    const auto size = std::to_integer<std::uint8_t>(record[4]);
    // Linux marks CAN XL by bit 7 of what is the length here.
    const bool classic = (record[5] & kFdFrame) == std::byte{0} && size <= kCanDataSize;
    if (!classic || record.size() < kHeader + (frame.remote ? 0 : size)) return std::nullopt;
    if (frame.remote) return frame;
    frame.size = size;
    std::ranges::copy(record.subspan(kHeader, size), frame.data.begin());
    return frame;
}

std::array<std::byte, kCanRecordSize> can_record(const CanFrame& frame) {
    std::array<std::byte, kCanRecordSize> record{};
    const std::uint32_t flags =
        (frame.extended ? kExtended : 0) | (frame.remote ? kRemote : 0) | (frame.error ? kError : 0);
    store(std::span(record), 0, ByteOrder::big, frame.id | flags);
    record[4] = std::byte{frame.size};
    if (frame.fd) record[5] = kFdFrame;
    std::ranges::copy(frame.data, record.begin() + kHeader);
    return record;
}

std::optional<CandumpLine> read_candump_line(std::string_view line) {
    const auto time = candump_time(word(line));
    if (!time) return std::nullopt;
    const std::string_view interface = word(line);
    if (!is_interface(interface)) return std::nullopt;
    const auto frame = candump_frame(word(line));
    if (!frame) return std::nullopt;
    return CandumpLine{*time, interface, *frame};
}

std::string candump_line(const CandumpLine& line) {
    const auto microseconds = line.time / std::chrono::microseconds(1);
    std::array<char, 80> text{};
    const CanFrame& frame = line.frame;
    int used = std::snprintf(text.data(), text.size(), "(%010lld.%06lld) %.16s %0*X#",
                             static_cast<long long>(microseconds / 1'000'000),
                             static_cast<long long>(microseconds % 1'000'000), std::string(line.interface).c_str(),
                             static_cast<int>(frame.extended ? 8 : 3), frame.id | (frame.error ? kError : 0));
    std::string out(text.data(), static_cast<std::size_t>(used));
    if (frame.remote) return out + 'R';
    if (frame.fd) return out + "#0";
    for (std::size_t i = 0; i < frame.size; ++i) {
        used = std::snprintf(text.data(), text.size(), "%02X", std::to_integer<unsigned>(frame.data[i]));
        out.append(text.data(), static_cast<std::size_t>(used));
    }
    return out;
}

}  // namespace quadrig::host
