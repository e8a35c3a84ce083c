/// The text of config/quality.toml as it was when the program was built.
#pragma once

#include <string_view>

namespace quadrig::config {

std::string_view shipped_ladder_text();

}  // namespace quadrig::config
