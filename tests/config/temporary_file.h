/// Texts that tests hand to readers of files.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "config/scene_file.h"

namespace quadrig::tests {

/// A file of the given text that is gone with the object.
class TemporaryFile {
  public:
    explicit TemporaryFile(std::string_view text, std::string_view extension = ".toml") {
        static std::atomic<int> count{0};
        path_ = std::filesystem::temp_directory_path() /
                ("quadrig-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + std::string(extension));
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~TemporaryFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// The scene that such a file holds.
inline Scene scene_of(std::string_view text) { return config::read_scene(TemporaryFile(text).path()); }

/// A text with the first occurrence of something in it replaced.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
    return text;
}

}  // namespace quadrig::tests
