#include "display/picture.h"

#include <cstring>

namespace quadrig::display {

void copy_pixels(const FrameImage& from, const FrameImage& to) {
    const std::size_t bytes = 4 * static_cast<std::size_t>(from.width);
    for (int r = 0; r < from.height; ++r) std::memcpy(to.row(r), from.row(r), bytes);
}

}  // namespace quadrig::display
