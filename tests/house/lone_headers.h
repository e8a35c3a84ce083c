/// Headers have to compile alone, whatever was included before them.
#pragma once

#include <filesystem>
#include <vector>

namespace quadrig::tests {

/// The headers below the product's folders of `root` that the project's compiler refuses as the only include of a file,
/// relative to the root. Those that a source of the same name beside them includes first are proven by the build.
std::vector<std::filesystem::path> headers_that_need_others(const std::filesystem::path& root);

}  // namespace quadrig::tests
