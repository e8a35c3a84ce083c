/// The settings of Quality that `quadrig accuracy` measures.
#pragma once

#include <vector>

#include "ig_core/quality.h"

namespace quadrig::appliance {

/// The default, each approximation by itself, and what can be combined to be faster or better than the default. Each
/// once; the default first.
std::vector<Quality> accuracy_settings();

}  // namespace quadrig::appliance
