#include "tests/hard_cases/catalogue.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "config/scene_file.h"

namespace quadrig::test {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& complaint) {
    throw std::runtime_error(file.string() + ": " + complaint);
}

/// What follows `beginning` on the next line.
std::string line_after(const std::string& beginning, std::istream& in, const std::filesystem::path& file) {
    std::string line;
    std::getline(in, line);
    if (line.rfind(beginning, 0) != 0 || line.size() == beginning.size())
        refuse(file, "expected a line that begins with '" + beginning + "'");
    return line.substr(beginning.size());
}

View camera_of(const std::string& text, const std::filesystem::path& file) {
    std::map<std::string, std::string> options;
    std::istringstream words(text);
    for (std::string name, value; words >> name >> value;) options[name] = value;
    const auto numbers = [&](const std::string& name, std::size_t count) {
        std::string list = options[name];
        std::replace_if(
            list.begin(), list.end(), [](char c) { return c == ',' || c == 'x'; }, ' ');
        std::vector<double> values;
        std::istringstream in(list);
        for (double value = 0; in >> value;) values.push_back(value);
        if (values.size() != count)
            refuse(file, "the camera's " + name + " takes " + std::to_string(count) + " numbers");
        return values;
    };
    const auto eye = numbers("--eye", 3), attitude = numbers("--attitude", 3), size = numbers("--size", 2);
    return {{{eye[0], eye[1], eye[2]}},
            eye_from_scene_rotation({{attitude[0]}, {attitude[1]}, {attitude[2]}}),
            ImagePlane::symmetric(static_cast<int>(size[0]), static_cast<int>(size[1]), {numbers("--fov", 1)[0]})};
}

}  // namespace

HardCase read_hard_case(const std::filesystem::path& file) {
    std::ifstream in(file);
    HardCase hard_case{file.stem().string(), line_after("# ", in, file), {}, {}};
    hard_case.view = camera_of(line_after("# camera: ", in, file), file);
    hard_case.scene = config::read_scene(file);
    return hard_case;
}

std::vector<std::filesystem::path> hard_case_files(const std::string& beginning) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(QUADRIG_SOURCE_DIR "/tests/hard_cases/cases")) {
        const std::filesystem::path& file = entry.path();
        if (file.extension() == ".toml" && file.filename().string().rfind(beginning, 0) == 0) files.push_back(file);
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace quadrig::test
