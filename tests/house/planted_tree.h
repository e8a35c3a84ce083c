/// A source tree that is gone with the object, to plant mistakes in.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace quadrig::tests {

class PlantedTree {
  public:
    PlantedTree() {
        static std::atomic<int> count{0};
        root_ = std::filesystem::temp_directory_path() /
                ("quadrig-tree-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::create_directories(root_);
    }
    ~PlantedTree() {
        std::error_code ignored;
        std::filesystem::remove_all(root_, ignored);
    }
    PlantedTree(const PlantedTree&) = delete;
    PlantedTree& operator=(const PlantedTree&) = delete;

    void plant(const std::filesystem::path& file, std::string_view text) const {
        std::filesystem::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file, std::ios::binary) << text;
    }
    [[nodiscard]] const std::filesystem::path& root() const { return root_; }

  private:
    std::filesystem::path root_;
};

}  // namespace quadrig::tests
