/// Which objects may be in view: the first stage of a frame.
#pragma once

#include <cstdint>
#include <span>

#include "ig_core/outline/image_bounds.h"
#include "ig_core/view.h"

namespace quadrig {

/// An object in view; all of it in one line of the caches.
struct alignas(64) InView {
    ImageBounds bounds;
    std::uint32_t object = 0;
    static constexpr std::uint32_t kNoSlot = ~0U;
    std::uint32_t slot = kNoSlot;  ///< of its outline (objects_in_view.h)
    std::int32_t first_strip = 0, last_strip = 0;
};

/// Writes to `in_view` those objects that may show on the image, in their order, and returns how many: at most all of
/// them. Their bounds are image_bounds. The first lane of `extents` is that of object `first`.
std::size_t select(std::span<const SolidExtents> extents, std::uint32_t first, const View& view, InView* in_view);

}  // namespace quadrig
