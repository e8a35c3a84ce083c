/// One way to read and write any CIGI packet whose layout has been told. Internal to the cigi_*.cpp files, each of
/// which tells its packets' layouts first and instantiates decode and encode then.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "host_link/cigi_format.h"
#include "host_link/wire.h"

namespace quadrig::host::cigi {

template <class T, class P>
concept Is = std::same_as<std::remove_const_t<T>, P>;

/// The byte swap field of 3.x's packets that open a message.
inline constexpr std::uint16_t kByteSwap = 0x8000;

/// In place of a byte offset: that version does not have the field.
inline constexpr int kNone = -1;
/// The lowest bit of a field of some bits; bit 0 is 0x01.
struct At {
    int byte = kNone, bit = 0;
};

/// A packet's two layouts are told once, for Reader and for Writer: of every field its byte offset from the start of
/// the packet in 3.x, then that in 4.0.
template <class Wire>
class Layout {
  public:
    Layout(Wire wire, Version version) : wire_(wire), version_(version) {}

    void number(int in_3, int in_4, auto& value) {
        const int at = version_ == Version::three ? in_3 : in_4;
        if (at != kNone) wire_.number(static_cast<std::size_t>(at), value);
    }
    void bits(At in_3, At in_4, int count, auto& value) {
        const At at = version_ == Version::three ? in_3 : in_4;
        if (at.byte != kNone) wire_.bits(static_cast<std::size_t>(at.byte), at.bit, count, value);
    }
    /// Numbers of one size, back to back.
    void numbers(int in_3, int in_4, auto& values) {
        const auto size = static_cast<int>(sizeof values[0]);
        for (auto& value : values) {
            number(in_3, in_4, value);
            if (in_3 != kNone) in_3 += size;
            if (in_4 != kNone) in_4 += size;
        }
    }
    [[nodiscard]] Version version() const { return version_; }

  private:
    Wire wire_;
    Version version_;
};

/// The two packets that open a message grew from 16 to 24 bytes with 3.2.
template <class P>
concept FramePacket = requires {
    P::kSizeBefore32;
};

template <class P>
constexpr std::size_t size_in(Version version) {
    if constexpr (requires { P::kSize; }) {
        if (version == Version::three) return P::kSize;
    }
    return P::kSize4;
}

template <class P>
P decode(std::span<const std::byte> packet, Format format) {
    P value;
    if constexpr (FramePacket<P>) {
        if (packet.size() < P::kSize) counter_since_32(value).reset();
    }
    Layout wire(Reader(packet, format.order), format.version);
    layout(wire, value);
    return value;
}

/// Id and size.
inline void write_header(Writer& wire, Kind kind, std::size_t size, Version version) {
    if (version == Version::three) {
        wire.number(0, static_cast<std::uint8_t>(kind));
        wire.number(1, static_cast<std::uint8_t>(size));
    } else {
        wire.number(0, static_cast<std::uint16_t>(size));
        wire.number(2, *id_in_4(kind));
    }
}

template <class P>
std::size_t encode(const P& packet, Format format, std::span<std::byte> out) {
    const bool three = format.version == Version::three;
    std::size_t size = size_in<P>(format.version);
    if constexpr (FramePacket<P>) {
        if (three && !counter_since_32(packet)) size = P::kSizeBefore32;
    }
    out = out.first(size);
    std::ranges::fill(out, std::byte{0});
    Writer wire(out, format.order);
    write_header(wire, P::kId, size, format.version);
    if constexpr (FramePacket<P>) {
        wire.number(three ? 2 : 4, format.version);
        if (three) wire.number(6, kByteSwap);
    }
    Layout fields(wire, format.version);
    layout(fields, packet);
    return size;
}

#define QUADRIG_CIGI_PACKET(P)                                \
    template P decode<P>(std::span<const std::byte>, Format); \
    template std::size_t encode<P>(const P&, Format, std::span<std::byte>);

}  // namespace quadrig::host::cigi
