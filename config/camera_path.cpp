#include "config/camera_path.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace quadrig::config {
namespace {

using Json = nlohmann::json;

class CameraReader {
  public:
    CameraReader(const std::filesystem::path& file, std::size_t index)
        : file_(file), key_("[" + std::to_string(index) + "]") {}

    [[nodiscard]] Camera read(const Json& camera) const {
        if (!camera.is_object()) refuse(key_, "an object of eye, attitude and fov", camera);
        for (const auto& [name, value] : camera.items()) {
            if (name != "eye" && name != "attitude" && name != "fov") {
                throw FileError(file_, 0, key_ + "." + name,
                                "expected one of eye, attitude, fov, found an unknown key");
            }
        }
        const glm::dvec3 eye = triple(camera, "eye", "metres in -1e9..1e9", 1e9);
        const glm::dvec3 attitude = triple(camera, "attitude", "degrees in -360..360", 360.0);
        const Json& fov = required(camera, "fov");
        if (!fov.is_number() || fov.get<double>() < 1.0 || fov.get<double>() > 170.0) {
            refuse(key_ + ".fov", "degrees in 1..170", fov);
        }
        return {{eye}, {{attitude.x}, {attitude.y}, {attitude.z}}, {fov.get<double>()}};
    }

  private:
    [[noreturn]] void refuse(const std::string& key, const std::string& expected, const Json& found) const {
        constexpr std::size_t kShown = 40;
        const std::string text = found.dump(-1, ' ', false, Json::error_handler_t::replace);
        throw FileError(
            file_, 0, key,
            "expected " + expected + ", found " + (text.size() > kShown ? text.substr(0, kShown) + "..." : text));
    }

    [[nodiscard]] const Json& required(const Json& camera, const std::string& name) const {
        const auto found = camera.find(name);
        if (found == camera.end()) throw FileError(file_, 0, key_ + "." + name, "expected this key, found none");
        return *found;
    }

    [[nodiscard]] glm::dvec3 triple(const Json& camera, const std::string& name, const std::string& expected,
                                    double limit) const {
        const Json& array = required(camera, name);
        if (!array.is_array() || array.size() != 3) refuse(key_ + "." + name, "an array of 3 numbers", array);
        glm::dvec3 values;
        for (std::size_t i = 0; i < 3; ++i) {
            const Json& element = array[i];
            if (!element.is_number() || !(std::abs(element.get<double>()) <= limit)) {
                refuse(key_ + "." + name + "[" + std::to_string(i) + "]", expected, element);
            }
            values[static_cast<glm::length_t>(i)] = element.get<double>();
        }
        return values;
    }

    const std::filesystem::path& file_;
    std::string key_;
};

Json parse_json_file(const std::filesystem::path& file) {
    const std::string text = read_text_file(file);
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        const auto before = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
        const auto line = static_cast<std::size_t>(std::count(text.begin(), before, '\n')) + 1;
        throw FileError(file, line, "", std::string("not JSON: ") + error.what());
    } catch (const Json::exception& error) {
        throw FileError(file, 0, "", std::string("not JSON: ") + error.what());
    }
}

}  // namespace

std::vector<Camera> read_camera_path(const std::filesystem::path& file) {
    const Json document = parse_json_file(file);
    if (!document.is_array() || document.empty()) {
        throw FileError(file, 0, "", "expected an array of at least one camera, found something else");
    }
    std::vector<Camera> cameras;
    cameras.reserve(document.size());
    for (const Json& camera : document) cameras.push_back(CameraReader(file, cameras.size()).read(camera));
    return cameras;
}

}  // namespace quadrig::config
