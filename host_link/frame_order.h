/// What the host's frame numbers say: which messages were lost, doubled, out of order, and when the host started anew.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "host_link/host_state.h"

namespace quadrig::host {

enum class Arrival : std::uint8_t {
    next,       ///< newer than all before it: to be taken
    duplicate,  ///< the same message once more
    late,       ///< overtaken by a newer one: not to be taken, or the picture would go back
    restart     ///< the host counts anew: to be taken, and nothing before it is comparable
};

/// Follows a counter of 32 bits that wraps and goes up by one a message.
///
/// A number that was seen before tells a doubled message from a restarted host by the message's bytes: a network
/// repeats them, a host that counts anew does not. A number more than kWindow behind, or kFarAhead in front, is a
/// restart; so is any that does not go on after kLate without a newer one: no network holds a message back for so long.
class FrameOrder {
  public:
    static constexpr std::uint32_t kWindow = 256;
    static constexpr std::uint32_t kFarAhead = 1U << 16;
    static constexpr Time kLate = std::chrono::seconds(1);

    /// `fingerprint`: a hash of the whole message.
    Arrival arrive(std::uint32_t frame, std::uint64_t fingerprint, Time arrival);

    /// The next number begins a new count, whichever it is.
    void forget() { newest_.reset(); }

    [[nodiscard]] std::uint64_t lost() const {
        return lost_;
    }  ///< numbers that never came; a late one is no longer lost

  private:
    void start(std::uint32_t frame, std::uint64_t fingerprint, Time arrival);

    std::optional<std::uint32_t> newest_;
    Time newest_arrival_{};
    std::array<std::optional<std::uint64_t>, kWindow>
        seen_{};  ///< by frame modulo kWindow, of the kWindow newest numbers
    std::uint64_t lost_ = 0;
    std::uint32_t since_start_ = 0;  ///< numbers from the first of this count to the newest, at most kWindow
};

}  // namespace quadrig::host
