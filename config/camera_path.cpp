#include "config/camera_path.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace quadrig::config {
namespace {

using Json = nlohmann::json;

/// Of one camera: ".eye", ".eye[2]", and "" for the camera itself.
using Lines = std::map<std::string, std::size_t>;

class CameraReader {
  public:
    CameraReader(const std::filesystem::path& file, std::size_t index, const Lines& lines)
        : file_(file), camera_("[" + std::to_string(index) + "]"), lines_(lines) {}

    [[nodiscard]] Camera read(const Json& camera) const {
        if (!camera.is_object()) refuse("", "an object of eye, attitude and fov", camera);
        for (const auto& [name, value] : camera.items()) {
            if (name != "eye" && name != "attitude" && name != "fov") {
                fail("." + name, "expected one of eye, attitude, fov, found an unknown key");
            }
        }
        const glm::dvec3 eye = triple(camera, "eye", "metres in -1e9..1e9", 1e9);
        const glm::dvec3 attitude = triple(camera, "attitude", "degrees in -360..360", 360.0);
        const Json& fov = required(camera, "fov");
        if (!fov.is_number() || fov.get<double>() < 1.0 || fov.get<double>() > 170.0) {
            refuse(".fov", "degrees in 1..170", fov);
        }
        return {{eye}, {{attitude.x}, {attitude.y}, {attitude.z}}, {fov.get<double>()}};
    }

  private:
    /// `key` as in Lines; one that is missing is told with the camera's line.
    [[noreturn]] void fail(const std::string& key, const std::string& complaint) const {
        const auto line = lines_.find(key);
        throw FileError(file_, line != lines_.end() ? line->second : lines_.at(""), camera_ + key, complaint);
    }

    [[noreturn]] void refuse(const std::string& key, const std::string& expected, const Json& found) const {
        fail(key,
             "expected " + expected + ", found " + excerpt(found.dump(-1, ' ', false, Json::error_handler_t::replace)));
    }

    [[nodiscard]] const Json& required(const Json& camera, const std::string& name) const {
        const auto found = camera.find(name);
        if (found == camera.end()) fail("." + name, "expected this key, found none");
        return *found;
    }

    [[nodiscard]] glm::dvec3 triple(const Json& camera, const std::string& name, const std::string& expected,
                                    double limit) const {
        const Json& array = required(camera, name);
        if (!array.is_array() || array.size() != 3) refuse("." + name, "an array of 3 numbers", array);
        glm::dvec3 values;
        for (std::size_t i = 0; i < 3; ++i) {
            const Json& element = array[i];
            if (!element.is_number() || !(std::abs(element.get<double>()) <= limit)) {
                refuse("." + name + "[" + std::to_string(i) + "]", expected, element);
            }
            values[static_cast<glm::length_t>(i)] = element.get<double>();
        }
        return values;
    }

    const std::filesystem::path& file_;
    std::string camera_;
    const Lines& lines_;
};

/// Reads each camera as soon as the parser has it whole, while the lines of its keys are known.
class PathReader {
  public:
    PathReader(const std::filesystem::path& file, const std::string& text) : file_(file), text_(text), stream_(text) {}

    std::vector<Camera> read() {
        // The parser takes it for the text's end.
        if (const std::size_t nul = text_.find('\0'); nul != std::string::npos)
            throw FileError(file_, line_before(nul), "", "not JSON: a character of code 0");
        Json other;  // than an array of cameras
        try {
            other = Json::parse(stream_, [this](int depth, Json::parse_event_t event, Json& parsed) {
                return take(depth, event, parsed);
            });
        } catch (const Json::parse_error& error) {
            throw FileError(file_, line_before(error.byte), key_here(), std::string("not JSON: ") + error.what());
        } catch (const Json::exception& error) {
            throw FileError(file_, line_here(), key_here(), std::string("not JSON: ") + error.what());
        }
        if (cameras_.empty()) {
            const std::string found = is_array_ ? "none" : other.type_name();
            throw FileError(file_, 1, "", "expected an array of at least one camera, found " + found);
        }
        return std::move(cameras_);
    }

  private:
    using Event = Json::parse_event_t;

    /// Depth 0 is the path, 1 a camera, 2 its keys and values, 3 their elements. False: need not be kept.
    bool take(int depth, Event event, const Json& parsed) {
        if (depth == 0 && event == Event::array_start) is_array_ = true;
        if (!is_array_) return true;
        // What a camera cannot have, however deep: the array around it is refused.
        if (depth > 4) return false;
        if (depth == 1 && (event == Event::object_start || event == Event::array_start)) {
            lines_ = {{"", line_here()}};
            key_.clear();
        } else if (depth == 1) {
            lines_.emplace("", line_here());
            cameras_.push_back(CameraReader(file_, cameras_.size(), lines_).read(parsed));
            lines_.clear();
            return false;
        } else if (depth == 2 && event == Event::key) {
            key_ = "." + parsed.get<std::string>();
            element_.reset();
            if (!lines_.emplace(key_, line_here()).second)
                throw FileError(file_, line_here(), key_here(), "expected once, found again");
        } else if (depth == 2 && event == Event::array_start) {
            element_ = 0;
        } else if (depth == 2) {
            key_.clear();
            element_.reset();
        } else if (depth == 3 && event == Event::value && element_) {
            lines_.emplace(key_ + index(*element_), line_here());
            ++*element_;
        }
        return true;
    }

    static std::string index(std::size_t i) { return "[" + std::to_string(i) + "]"; }

    /// Where in a camera the parser is; nothing between cameras.
    [[nodiscard]] std::string key_here() const {
        if (lines_.empty()) return "";
        return index(cameras_.size()) + key_ + (element_ ? index(*element_) : "");
    }

    /// The parser has read one character more than a number has.
    std::size_t line_here() {
        const std::streamoff position = stream_.tellg();
        return line_before(position < 0 ? text_.size() : static_cast<std::size_t>(position - 1));
    }

    /// Positions only go up, so that each character is looked at once.
    std::size_t line_before(std::size_t position) {
        for (const std::size_t end = std::min(position, text_.size()); counted_ < end; ++counted_)
            if (text_[counted_] == '\n') ++line_;
        return line_;
    }

    const std::filesystem::path& file_;
    const std::string& text_;
    std::istringstream stream_;
    std::size_t counted_ = 0, line_ = 1;
    bool is_array_ = false;
    Lines lines_;
    std::string key_;
    std::optional<std::size_t> element_;  ///< of the array that is the key's value
    std::vector<Camera> cameras_;
};

}  // namespace

std::vector<Camera> read_camera_path(const std::filesystem::path& file) {
    const std::string text = read_text_file(file);
    return PathReader(file, text).read();
}

}  // namespace quadrig::config
