/// Native FDM packets in a stream of bytes: TCP has no boundaries of its own, and the packets carry no length. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "host_link/flightgear_fdm.h"

namespace quadrig::host::flightgear {

/// Cuts a stream into packets: each begins with its version (24 or 25, in either byte order: what is swapped is refused
/// later, whole), which tells its size. Where there is none, the stream is skipped up to the next version that has
/// another one behind its packet.
class PacketStream {
  public:
    /// Takes bytes off `stream` until a packet is whole, and gives it; valid until the next call. Absent once `stream`
    /// is used up.
    std::optional<std::span<const std::byte>> next(std::span<const std::byte>& stream);
    /// How often something else stood where a packet should have begun.
    [[nodiscard]] std::uint64_t breaks() const { return breaks_; }

  private:
    /// Of a packet that may begin there; 0 where none can.
    [[nodiscard]] std::size_t size_at(std::size_t place) const;
    void drop(std::size_t count);

    // A packet, and the version of the next.
    std::array<std::byte, kSize25 + sizeof(std::uint32_t)> bytes_{};
    std::size_t size_ = 0;
    std::size_t given_ = 0;  ///< bytes of the packet given last
    bool in_step_ = true;    ///< a connection begins with a packet
    std::uint64_t breaks_ = 0;
};

}  // namespace quadrig::host::flightgear
