/// New inputs out of old ones, the same from the same seed everywhere: a fuzzer without a compiler's help.
#pragma once

#include <random>
#include <span>

#include "tests/fuzz/messages.h"

namespace quadrig::fuzz {

/// One of `corpus`, changed in one to eight places: bits, bytes, numbers that lie at a border, pieces left out, put in
/// twice, or taken from another; cut to `most_bytes`.
Bytes mutated(std::span<const Bytes> corpus, std::size_t most_bytes, std::mt19937_64& random);

}  // namespace quadrig::fuzz
