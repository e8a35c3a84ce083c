/// Memory asked for ahead of its use: objects are visited in an order that no processor foresees.
#pragma once

#include <cstddef>
#include <span>

namespace quadrig {

/// Begins to bring an array into the caches, and goes on without waiting for it. Whether it is there changes nothing
/// but the time.
template <class Thing>
void fetch(std::span<const Thing> things) {
    constexpr std::size_t kLine = 64;  // bytes of a cache line
    const auto* const bytes = reinterpret_cast<const char*>(things.data());
    for (std::size_t at = 0; at < things.size_bytes(); at += kLine) __builtin_prefetch(bytes + at);
    // GCC takes a function that does nothing else for one without effect, and drops its calls.
    asm volatile("");
}
template <class Thing>
void fetch(const Thing& thing) {
    fetch(std::span<const Thing>(&thing, 1));
}

}  // namespace quadrig
