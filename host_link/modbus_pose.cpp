#include "host_link/modbus_pose.h"

#include <algorithm>

#include "host_link/wire.h"

namespace quadrig::host::modbus {

namespace {

// Register by register, from the start of a block.
constexpr std::size_t kVersionAt = 0, kSequenceAt = 1, kTimeAt = 2, kNumbersAt = 4;
// The int32 block's units.
constexpr double kScaledDegrees = 1e-7, kScaledMetres = 1e-3, kScaledAngle = 1e-4;

bool holds(std::uint32_t first, std::uint32_t count, const Registers& r) {
    return r.address >= first && r.address + std::uint32_t{r.count} <= first + count;
}

/// Between the registers' order and big-endian, which is the same step in both directions.
template <std::size_t kSize>
std::array<std::byte, kSize> reordered(std::array<std::byte, kSize> bytes, WordOrder order) {
    if (order.words_swapped != order.bytes_swapped) {
        for (std::size_t i = 0; i < kSize; i += 2) std::swap(bytes[i], bytes[i + 1]);
    }
    if (order.words_swapped) std::ranges::reverse(bytes);
    return bytes;
}

/// Reader and writer of a block's numbers, by register.
struct Block {
    std::span<std::byte> bytes;
    WordOrder order;

    template <class T>
    [[nodiscard]] T get(std::size_t at) const {
        std::array<std::byte, sizeof(T)> raw;
        std::ranges::copy(bytes.subspan(2 * at, sizeof(T)), raw.begin());
        return load<T>(reordered(raw, order), 0, ByteOrder::big);
    }
    template <class T>
    void put(std::size_t at, T value) {
        std::array<std::byte, sizeof(T)> raw;
        store(std::span(raw), 0, ByteOrder::big, value);
        std::ranges::copy(reordered(raw, order), bytes.begin() + static_cast<std::ptrdiff_t>(2 * at));
    }
    /// One register: its bytes are never swapped.
    [[nodiscard]] std::uint16_t word(std::size_t at) const {
        return load<std::uint16_t>(bytes, 2 * at, ByteOrder::big);
    }
    void put_word(std::size_t at, std::uint16_t value) { store(bytes, 2 * at, ByteOrder::big, value); }
};

GeodeticPose float_pose(const Block& block) {
    return {{{block.get<double>(kNumbersAt)}, {block.get<double>(kNumbersAt + 4)}, block.get<double>(kNumbersAt + 8)},
            {{block.get<float>(kNumbersAt + 12)},
             {block.get<float>(kNumbersAt + 14)},
             {block.get<float>(kNumbersAt + 16)}}};
}

GeodeticPose scaled_pose(const Block& block) {
    const auto scaled = [&](std::size_t place, double unit) {
        return block.get<std::int32_t>(kNumbersAt + 2 * place) * unit;
    };
    return {{{scaled(0, kScaledDegrees)}, {scaled(1, kScaledDegrees)}, scaled(2, kScaledMetres)},
            {{scaled(3, kScaledAngle)}, {scaled(4, kScaledAngle)}, {scaled(5, kScaledAngle)}}};
}

}  // namespace

bool may_write(const Registers& registers, const PoseSettings& settings) {
    return holds(settings.base, kFloatRegisters, registers) ||
           holds(settings.base + std::uint32_t{kScaledBlock}, kScaledRegisters, registers);
}

bool may_read(const Request& request, const PoseSettings& settings) {
    if (!request.read) return true;
    if (request.function == Function::read_input_registers) return holds(0, kInputRegisters, *request.read);
    return holds(settings.base, kHoldingRegisters, *request.read);
}

std::variant<std::monostate, HostPose, Reject> PoseRegisters::write(const Request& request,
                                                                    const PoseSettings& settings) {
    const std::size_t first = request.write->address - settings.base, end = first + request.write->count;
    std::ranges::copy(request.values, bytes_.begin() + static_cast<std::ptrdiff_t>(2 * first));
    const bool scaled = first >= kScaledBlock;
    const std::size_t start = scaled ? kScaledBlock : 0;
    const std::size_t commit = (scaled ? kScaledRegisters : kFloatRegisters) - std::size_t{1};
    if (end != start + commit + 1) return std::monostate{};
    const Block block{std::span(bytes_).subspan(2 * start), settings.order};
    if (block.word(commit) != block.word(kSequenceAt)) return Reject::commit_mismatch;
    if (block.word(kVersionAt) != kLayoutVersion) return Reject::unknown_version;
    return HostPose{block.word(kSequenceAt), block.get<std::uint32_t>(kTimeAt),
                    scaled ? scaled_pose(block) : float_pose(block)};
}

std::array<std::byte, std::size_t{2} * kFloatRegisters> float_block(const HostPose& host, WordOrder order) {
    std::array<std::byte, std::size_t{2} * kFloatRegisters> bytes{};
    Block block{bytes, order};
    block.put_word(kVersionAt, kLayoutVersion);
    block.put_word(kSequenceAt, host.sequence);
    block.put(kTimeAt, host.time);
    const auto& [position, attitude] = host.pose;
    block.put(kNumbersAt, position.latitude.value);
    block.put(kNumbersAt + 4, position.longitude.value);
    block.put(kNumbersAt + 8, position.altitude);
    block.put(kNumbersAt + 12, static_cast<float>(attitude.heading.value));
    block.put(kNumbersAt + 14, static_cast<float>(attitude.pitch.value));
    block.put(kNumbersAt + 16, static_cast<float>(attitude.roll.value));
    block.put_word(kFloatRegisters - 1, host.sequence);
    return bytes;
}

std::array<std::uint16_t, kInputRegisters> input_registers(const Status& status, WordOrder order) {
    std::array<std::byte, std::size_t{2} * kInputRegisters> bytes{};
    Block block{bytes, order};
    block.put_word(0, kLayoutVersion);
    block.put_word(1, 0x1234);
    block.put(2, std::uint32_t{0x12345678});
    block.put(4, 123456.0F);
    block.put(6, 123456.789);
    block.put_word(16, static_cast<std::uint16_t>(status.mode));
    block.put_word(17, status.sequence);
    block.put(18, status.frame);
    block.put(20, status.misses);
    block.put(22, status.poses);
    block.put(24, status.rejected);
    std::array<std::uint16_t, kInputRegisters> registers{};
    for (std::size_t i = 0; i < registers.size(); ++i) registers[i] = block.word(i);
    return registers;
}

}  // namespace quadrig::host::modbus
