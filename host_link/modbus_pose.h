/// The registers that a Modbus host drives the picture by, and what is read back from them. Pure.
///
/// Two blocks of holding registers carry the same pose: the block of float64 (register layout version 1) at the base
/// address, the block of scaled int32 at kScaledBlock from there. A pose counts when its block's last register, the
/// commit, is written and equals the sequence number in its second. Input registers hold known values and the status.
/// The table is in host_link/README.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "host_link/host_state.h"
#include "host_link/modbus.h"
#include "host_link/reject.h"

namespace quadrig::host::modbus {

inline constexpr std::uint16_t kLayoutVersion = 1;
inline constexpr std::uint16_t kFloatRegisters = 24;
inline constexpr std::uint16_t kScaledBlock = 100;
inline constexpr std::uint16_t kScaledRegisters = 18;
/// Holding registers from the base address on: both blocks, and what lies between them, which reads as 0.
inline constexpr std::uint16_t kHoldingRegisters = 128;
inline constexpr std::uint16_t kInputRegisters = 32;

/// How numbers of several registers lie in them; A is the most significant byte of four.
struct WordOrder {
    bool words_swapped = false;  ///< CDAB: the least significant register first
    bool bytes_swapped = false;  ///< BADC: the low byte of a register first; both: DCBA
};

struct PoseSettings {
    std::uint16_t base = 0;  ///< at most 65536 - kHoldingRegisters
    WordOrder order;
};

struct HostPose {
    std::uint16_t sequence = 0;
    std::uint32_t time = 0;  ///< ms
    GeodeticPose pose;
};

/// Whether a request may write there: within one of the blocks.
bool may_write(const Registers& registers, const PoseSettings& settings);
/// Whether all that it asks for is there.
bool may_read(const Request& request, const PoseSettings& settings);

/// What one host has written: parts in any order, of which nothing counts before the commit.
class PoseRegisters {
  public:
    /// Applies a request that may_write. The pose where it commits one; Reject where the commit or the layout's version
    /// is wrong; nothing where it is only a part.
    std::variant<std::monostate, HostPose, Reject> write(const Request& request, const PoseSettings& settings);

  private:
    std::array<std::byte, std::size_t{2} * kHoldingRegisters> bytes_{};
};

/// The pose as the 48 bytes of the block of float64, register 0 first.
std::array<std::byte, std::size_t{2} * kFloatRegisters> float_block(const HostPose& pose, WordOrder order);

/// What the input registers tell.
struct Status {
    Mode mode = Mode::operate;
    std::uint16_t sequence = 0;  ///< of the newest pose taken
    std::uint32_t frame = 0;     ///< pictures' number, at the last frame's start
    std::uint32_t misses = 0;    ///< deadlines missed
    std::uint32_t poses = 0;     ///< taken
    std::uint32_t rejected = 0;  ///< refused, for whatever reason
};
std::array<std::uint16_t, kInputRegisters> input_registers(const Status& status, WordOrder order);

}  // namespace quadrig::host::modbus
