#include "tests/appliance/files.h"

#include <unistd.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace quadrig::tests {
namespace {

namespace fs = std::filesystem;

struct ScratchRoot {
    fs::path path = fs::temp_directory_path() / ("quadrig-appliance-" + std::to_string(getpid()));
    ScratchRoot() { fs::create_directories(path); }
    ~ScratchRoot() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    ScratchRoot(const ScratchRoot&) = delete;
    ScratchRoot& operator=(const ScratchRoot&) = delete;
};

template <class Number>
Plane<Number> read_plane(const fs::path& file, const std::string& type) {
    const std::string bytes = text_of(file);
    if (bytes.size() < 10 || bytes.substr(0, 6) != "\x93NUMPY" || bytes[6] != 1 || bytes[7] != 0)
        throw std::runtime_error("not a .npy file of version 1.0");
    const std::size_t header = static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
    const std::string literal = bytes.substr(10, header);
    if ((10 + header) % 16 != 0 || literal.back() != '\n' || literal.find("'descr': '" + type + "'") == literal.npos ||
        literal.find("'fortran_order': False") == literal.npos)
        throw std::runtime_error("unexpected header: " + literal);
    Plane<Number> plane;
    const std::size_t shape = literal.find("'shape': (");
    std::istringstream numbers(literal.substr(shape + 10));
    char comma = 0;
    numbers >> plane.rows >> comma >> plane.columns;
    plane.values.resize(static_cast<std::size_t>(plane.rows) * static_cast<std::size_t>(plane.columns));
    if (bytes.size() != 10 + header + plane.values.size() * sizeof(Number))
        throw std::runtime_error("the file's size is not that of its shape");
    std::memcpy(plane.values.data(), bytes.data() + 10 + header, plane.values.size() * sizeof(Number));
    return plane;
}

}  // namespace

fs::path scratch_directory() {
    static const ScratchRoot root;
    static std::atomic<int> count{0};
    fs::path path = root.path / std::to_string(count++);
    fs::create_directory(path);
    return path;
}

fs::path scratch_file(const std::string& name, std::string_view text) {
    fs::path path = scratch_directory() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

std::string shipped(const std::string& path) { return std::string(QUADRIG_SOURCE_DIR) + "/" + path; }

Plane<std::int32_t> read_int32_plane(const fs::path& file) { return read_plane<std::int32_t>(file, "<i4"); }
Plane<double> read_float64_plane(const fs::path& file) { return read_plane<double>(file, "<f8"); }

Y4mStream read_y4m(const std::string& bytes) {
    Y4mStream stream;
    const std::size_t end = bytes.find('\n');
    if (!bytes.starts_with("YUV4MPEG2 ") || end == std::string::npos) throw std::runtime_error("not a Y4M stream");
    stream.header = bytes.substr(0, end);
    std::istringstream words(stream.header);
    for (std::string word; words >> word;) {
        if (word[0] == 'W') stream.width = std::stoi(word.substr(1));
        if (word[0] == 'H') stream.height = std::stoi(word.substr(1));
    }
    const std::string mark = "FRAME\n";
    const std::size_t picture = 3 * static_cast<std::size_t>(stream.width) * static_cast<std::size_t>(stream.height);
    for (std::size_t at = end + 1; at < bytes.size(); at += mark.size() + picture, ++stream.frames)
        if (bytes.compare(at, mark.size(), mark) != 0 || bytes.size() - at < mark.size() + picture)
            throw std::runtime_error("frame " + std::to_string(stream.frames) + " is not whole");
    return stream;
}

Difference difference(const display::Picture& a, const display::Picture& b) {
    if (a.width != b.width || a.height != b.height) throw std::runtime_error("pictures of different sizes");
    Difference found;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const int d = std::abs(a.pixels[i] - b.pixels[i]);
        found.largest = std::max(found.largest, d);
        found.mean += d;
    }
    found.mean /= static_cast<double>(a.pixels.size());
    return found;
}

std::string small_scene(std::string_view sun_and_haze) {
    return std::string(sun_and_haze) + R"(
[scene]
name = "small"
origin = { latitude = 47.26, longitude = 11.34, altitude = 581.0 }
[ground]
colour = [0.25, 0.33, 0.14]
texture = "grass"
texture_weight = 0.6
[[cloud_deck]]
altitude = 900.0
texture = "grass"
texture_weight = 0.3
translucence = { threshold = 0.1, softness = 0.3 }
[[texture]]
name = "grass"
coefficients = [1.0, 0.7]
frequencies = [0.05, 0.11]
phases = [0.3, 1.9]
drift = [2.0, 1.0]
[[object]]
name = "ball"
ellipsoid = { centre = [0.0, 100.0, 20.0], semi_axes = [10.0, 10.0, 10.0] }
colour = [0.8, 0.2, 0.1]
[[object]]
name = "half"
ellipsoid = { centre = [30.0, 120.0, 15.0], semi_axes = [12.0, 9.0, 15.0], attitude = [30.0, 20.0, 10.0] }
planes = [[-1.0, -1.0, 0.2, 140.0]]
colour = [0.1, 0.4, 0.6]
[[object]]
name = "hill"
hill = { apex = [-200.0, 700.0, 120.0], radius_of_curvature = 150.0, slope = 0.6 }
planes = [[0.0, 0.0, 1.0, 0.0]]
colour = [0.3, 0.35, 0.2]
[[object]]
name = "bush"
ellipsoid = { centre = [-25.0, 80.0, 6.0], semi_axes = [8.0, 8.0, 7.0] }
colour = [0.1, 0.25, 0.05]
texture = "grass"
texture_weight = 0.5
translucence = { threshold = 0.05, limb_threshold = 0.4 }
)";
}

std::string still_scene() {
    std::string text = small_scene();
    const std::string drift = "drift = [2.0, 1.0]";
    return text.erase(text.find(drift), drift.size());
}

}  // namespace quadrig::tests
