/// Every reader of bytes that somebody else has written, as a fuzzer wants it: bytes in, and nothing may come of them
/// but what the reader promises.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string_view>

namespace quadrig::fuzz {

using Input = std::span<const std::byte>;

/// What a reader promises does not hold. Like any exception that leaves a target, it ends a fuzzer as a crash.
struct LawBroken : std::logic_error {
    using std::logic_error::logic_error;
};
inline void law(bool holds, const char* promise) {
    if (!holds) throw LawBroken(promise);
}

struct Target {
    std::string_view name;
    void (*read)(Input input);
    std::size_t most_bytes;  ///< of an input worth trying
};

std::span<const Target> targets();

// Links: an input is a conversation (messages.h).
void read_cigi(Input input);
void read_fdm(Input input);
void read_fdm_stream(Input input);
void read_canaerospace(Input input);
void read_modbus(Input input);
void read_monitor(Input input);
// Text and files: an input is what they hold.
void read_candump(Input input);
void read_capture(Input input);
void read_recorded_frames(Input input);
void read_link_url(Input input);
void read_scene(Input input);
void read_appliance(Input input);
void read_camera_path(Input input);
void read_quality_ladder(Input input);

}  // namespace quadrig::fuzz
