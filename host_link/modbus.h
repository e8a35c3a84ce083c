/// Modbus/TCP requests as a server hears them: bytes of a stream to whole requests, checked to the last count. Pure.
///
/// Frame: u16 transaction, u16 protocol (0), u16 length of what follows, u8 unit, then u8 function and its data, all
/// big-endian. Source: Modbus Application Protocol 1.1b3, sections 6.3, 6.4, 6.6, 6.12, 6.17; Modbus Messaging on
/// TCP/IP Implementation Guide 1.0b, section 3.1.3.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

namespace quadrig::host::modbus {

inline constexpr std::size_t kHeaderSize = 7;
inline constexpr std::size_t kLargestFrame = 260;

enum class Function : std::uint8_t {
    read_holding_registers = 3,
    read_input_registers = 4,
    write_single_register = 6,
    write_multiple_registers = 16,
    read_write_multiple_registers = 23
};

/// "read_holding_registers"…
std::string_view name_of(Function function);

/// The codes that an exception response carries.
enum class Exception : std::uint8_t { illegal_function = 1, illegal_address = 2, illegal_value = 3 };

struct Registers {
    std::uint16_t address = 0;
    std::uint16_t count = 0;  ///< address + count is at most 65536
};

struct Request {
    Function function = Function::read_holding_registers;
    std::optional<Registers> read;
    std::optional<Registers> write;
    std::span<const std::byte> values;  ///< of the registers written, two bytes each, the high one first
};

/// Reads a whole frame, header included. What is not a request of the five functions above, with counts that the
/// specification allows and that agree with the frame's length, is the exception to answer with.
std::variant<Request, Exception> read_request(std::span<const std::byte> frame);

/// A request that writes, as a host sends it; returns its size. One register: function 6, more: function 16. `out`
/// holds kLargestFrame bytes, `values` 2 to 246, an even number.
std::size_t write_request(std::uint16_t transaction, std::uint16_t address, std::span<const std::byte> values,
                          std::span<std::byte> out);

/// Cuts a stream of bytes into frames, whatever pieces it arrives in.
class FrameBuffer {
  public:
    /// Takes bytes off `stream` until a frame is whole, and gives it; valid until the next call. Absent once `stream`
    /// is used up, or where it cannot be Modbus.
    std::optional<std::span<const std::byte>> next(std::span<const std::byte>& stream);
    /// The stream holds a header that no frame has: nothing after it can be told apart.
    [[nodiscard]] bool broken() const { return broken_; }

  private:
    std::array<std::byte, kLargestFrame> bytes_{};
    std::size_t size_ = 0;
    bool whole_ = false;  ///< the frame in `bytes_` has been given
    bool broken_ = false;
};

}  // namespace quadrig::host::modbus
