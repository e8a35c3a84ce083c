/// Numbers on the wire: IEEE-754 and two's complement, in either byte order.
///
/// Reader and Writer answer to the same calls, so that one description of a packet's layout both decodes and encodes
/// it. Precondition everywhere: the offset and the number fit the bytes; whoever knows a packet's size checks it first.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

namespace quadrig::host {

enum class ByteOrder { little, big };

inline constexpr ByteOrder kNativeOrder =
    std::endian::native == std::endian::little ? ByteOrder::little : ByteOrder::big;

template <class T>
T load(std::span<const std::byte> bytes, std::size_t offset, ByteOrder order) {
    std::array<std::byte, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes.data() + offset, sizeof(T));
    if (order != kNativeOrder) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
}

template <class T>
void store(std::span<std::byte> bytes, std::size_t offset, ByteOrder order, T value) {
    auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    if (order != kNativeOrder) std::ranges::reverse(raw);
    std::memcpy(bytes.data() + offset, raw.data(), sizeof(T));
}

class Reader {
  public:
    Reader(std::span<const std::byte> bytes, ByteOrder order) : bytes_(bytes), order_(order) {}

    template <class T>
    void number(std::size_t offset, T& value) const {
        value = load<T>(bytes_, offset, order_);
    }
    /// `count` bits of one byte, the lowest at `first` (bit 0 = 0x01).
    template <class T>
    void bits(std::size_t offset, int first, int count, T& value) const {
        const unsigned byte = std::to_integer<unsigned>(bytes_[offset]);
        value = static_cast<T>((byte >> first) & ((1U << count) - 1U));
    }

  private:
    std::span<const std::byte> bytes_;
    ByteOrder order_;
};

/// Bits are added to what is there: start from zeroed bytes.
class Writer {
  public:
    Writer(std::span<std::byte> bytes, ByteOrder order) : bytes_(bytes), order_(order) {}

    template <class T>
    void number(std::size_t offset, T value) {
        store(bytes_, offset, order_, value);
    }
    template <class T>
    void bits(std::size_t offset, int first, int count, T value) {
        const unsigned field = static_cast<unsigned>(value) & ((1U << count) - 1U);
        bytes_[offset] |= static_cast<std::byte>(field << first);
    }

  private:
    std::span<std::byte> bytes_;
    ByteOrder order_;
};

}  // namespace quadrig::host
