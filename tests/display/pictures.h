/// Pictures for the tests of this folder.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>

#include "display/picture.h"

namespace quadrig::display::test {

/// Every byte random but alpha, which is 255.
inline Picture random_picture(int width, int height, std::uint32_t seed) {
    Picture picture(width, height);
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        picture.pixels[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(random() & 0xFF);
    return picture;
}

inline void fill(const FrameImage& image, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            std::uint8_t* p = image.row(y) + 4 * x;
            p[0] = r, p[1] = g, p[2] = b, p[3] = 255;
        }
}

/// An empty directory of the test's own, removed again at the end.
class TemporaryDirectory {
  public:
    TemporaryDirectory() {
        std::string name = (std::filesystem::temp_directory_path() / "quadrig-display-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
        path_ = name;
    }
    ~TemporaryDirectory() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace quadrig::display::test
