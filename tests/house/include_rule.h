/// The include rule of the house: arrows in the code run one way only. A folder may include itself, and what its row
/// allows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadrig::tests {

/// Sources (.h, .cpp) below the folders of the product, relative to the root, sorted.
std::vector<std::filesystem::path> product_sources(const std::filesystem::path& root);

/// Every include of the tree's own files that points the wrong way, or at no file at all, as "FILE:LINE includes
/// "PATH": why".
std::vector<std::string> wrong_includes(const std::filesystem::path& root);

}  // namespace quadrig::tests
