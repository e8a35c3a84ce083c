/// One way to read and write any CIGI packet whose layout has been told. Internal to the cigi_*.cpp files, each of
/// which tells its packets' layouts first and instantiates decode and encode then.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "host_link/wire.h"

namespace quadrig::host::cigi {

template <class T, class P>
concept Is = std::same_as<std::remove_const_t<T>, P>;

/// The byte swap field of the packets that open a message.
inline constexpr std::uint16_t kByteSwap = 0x8000;

}  // namespace quadrig::host::cigi
