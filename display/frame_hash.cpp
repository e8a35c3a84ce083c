#include "display/frame_hash.h"

// The state lives on the stack, so its layout is needed.
#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

#include <cstdio>
#include <vector>

namespace quadrig::display {

std::uint64_t frame_hash(const FrameImage& image) {
    const std::size_t row_bytes = 4 * static_cast<std::size_t>(image.width);
    if (image.row_bytes == static_cast<std::ptrdiff_t>(row_bytes))
        return XXH3_64bits(image.top_row, row_bytes * static_cast<std::size_t>(image.height));
    XXH3_state_t state;
    XXH3_INITSTATE(&state);
    XXH3_64bits_reset(&state);
    for (int r = 0; r < image.height; ++r) XXH3_64bits_update(&state, image.row(r), row_bytes);
    return XXH3_64bits_digest(&state);
}

std::uint64_t sequence_hash(std::span<const std::uint64_t> frame_hashes) {
    std::vector<XXH64_canonical_t> bytes(frame_hashes.size());
    for (std::size_t i = 0; i < frame_hashes.size(); ++i) XXH64_canonicalFromHash(&bytes[i], frame_hashes[i]);
    return XXH3_64bits(bytes.data(), bytes.size() * sizeof(XXH64_canonical_t));
}

std::string hex(std::uint64_t hash) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    return digits;
}

}  // namespace quadrig::display
