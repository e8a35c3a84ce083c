/// Files that tests of the program write for it and read from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "display/picture.h"

namespace quadrig::tests {

/// An empty directory of its own, gone when the tests end.
std::filesystem::path scratch_directory();
/// A file in a scratch directory.
std::filesystem::path scratch_file(const std::string& name, std::string_view text);
std::string text_of(const std::filesystem::path& file);
/// A file of the repository.
std::string shipped(const std::string& path);

/// A .npy file, read by the letter of NumPy's format description and by nothing of ours.
template <class Number>
struct Plane {
    int rows = 0, columns = 0;
    std::vector<Number> values;
    [[nodiscard]] Number at(int row, int column) const {
        return values.at(static_cast<std::size_t>(row * columns + column));
    }
};
Plane<std::int32_t> read_int32_plane(const std::filesystem::path& file);
Plane<double> read_float64_plane(const std::filesystem::path& file);

/// Number of frames in a Y4M stream of 4:4:4 pictures; its header line. Throws where it is not one, to the last byte.
struct Y4mStream {
    std::string header;
    int width = 0, height = 0;
    std::size_t frames = 0;
};
Y4mStream read_y4m(const std::string& bytes);

/// Largest difference of any colour value, and the mean of all.
struct Difference {
    int largest = 0;
    double mean = 0.0;
};
Difference difference(const display::Picture& a, const display::Picture& b);

/// A small scene with every kind of thing in it, its origin at 47.26 N, 11.34 E, 581 m. `sun_and_haze` stands in place
/// of its own [sun] and [haze].
std::string small_scene(std::string_view sun_and_haze = "[sun]\nazimuth = 200\nelevation = 35\n");
/// The same without drift: what is seen does not depend on when.
std::string still_scene();

}  // namespace quadrig::tests
