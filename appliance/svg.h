/// What every SVG of ours needs.
#pragma once

#include <string>

namespace quadrig::appliance {

/// Text as XML 1.0 takes it.
std::string escaped(const std::string& text);

}  // namespace quadrig::appliance
