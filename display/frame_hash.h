/// Fingerprints of pictures: XXH3, 64 bits, over the visible bytes (R, G, B, A; rows top to bottom, no padding).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "ig_core/view.h"

namespace quadrig::display {

/// XXH3-64 (xxHash 0.8, seed 0) of the picture's bytes as if its rows stood one behind the other.
/// About 0.25 ms for 1280x720. Allocates nothing.
std::uint64_t frame_hash(const FrameImage& image);

/// One hash over any number of frames in order: XXH3-64 over their hashes, eight bytes each, most significant first.
std::uint64_t sequence_hash(std::span<const std::uint64_t> frame_hashes);

/// 16 lower-case hex digits.
std::string hex(std::uint64_t hash);

}  // namespace quadrig::display
