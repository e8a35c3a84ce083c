/// A conversation as one input: messages one after the other, each behind three bytes. The first and the lower half of
/// the second are its size, little-endian; the upper half chooses how long after the one before it comes; the third
/// tells who sends it.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "host_link/host_state.h"
#include "tests/fuzz/targets.h"

namespace quadrig::fuzz {

using Bytes = std::vector<std::byte>;

struct Message {
    host::Time after{};  ///< since the one before; one of kPauses
    std::uint32_t source = 0;
    Input bytes;
};

using namespace std::chrono_literals;
inline constexpr host::Time kPauses[16]{16'667us, 0ns,  1ns,  1us,   100us, 1ms, 4ms,    10ms,
                                        20ms,     49ms, 51ms, 100ms, 251ms, 1s,  3'600s, -1ms};

/// Takes the next message off the input; the last one may be cut.
inline std::optional<Message> next_message(Input& input) {
    constexpr std::size_t kHeader = 3;
    if (input.size() < kHeader) return std::nullopt;
    const auto byte = [&](std::size_t i) { return std::to_integer<std::size_t>(input[i]); };
    Message message{kPauses[byte(1) >> 4U], static_cast<std::uint32_t>(byte(2)), {}};
    const std::size_t size = std::min(byte(0) | (byte(1) & 15U) << 8U, input.size() - kHeader);
    message.bytes = input.subspan(kHeader, size);
    input = input.subspan(kHeader + size);
    return message;
}

/// Puts a message of up to 4095 bytes behind a conversation.
inline void append_message(Bytes& conversation, Input bytes, std::size_t pause = 0, std::uint8_t source = 0) {
    conversation.push_back(static_cast<std::byte>(bytes.size() & 255U));
    conversation.push_back(static_cast<std::byte>(bytes.size() >> 8U | pause << 4U));
    conversation.push_back(static_cast<std::byte>(source));
    conversation.insert(conversation.end(), bytes.begin(), bytes.end());
}

}  // namespace quadrig::fuzz
