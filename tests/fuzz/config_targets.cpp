// Files that users write: what is taken is written and read again alike, what is not is refused with the file's name.
#include <sstream>
#include <string>

#include "config/appliance_file.h"
#include "config/camera_path.h"
#include "config/quality_ladder.h"
#include "config/scene_file.h"
#include "tests/fuzz/input_file.h"

namespace quadrig::fuzz {
namespace {

const InputFile& file() {
    static const InputFile file;
    return file;
}

/// Of scenes with more, the second reading is left out.
constexpr std::size_t kMostObjectsReadAgain = 200;

std::string written(const Scene& scene) {
    std::ostringstream text;
    config::write_scene(scene, text);
    return std::move(text).str();
}

/// What `reader` refuses has to name the file.
template <class Reader>
void read(Input input, Reader reader) {
    const std::filesystem::path& path = file().holding(input);
    try {
        reader(path);
    } catch (const config::FileError& error) {
        law(std::string_view(error.what()).starts_with(path.string() + ":"), "an error names the file");
    }
}

Input bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

}  // namespace

void read_scene(Input input) {
    read(input, [](const std::filesystem::path& path) {
        const Scene scene = config::read_scene(path);
        if (scene.objects.size() > kMostObjectsReadAgain) return;
        const std::string once = written(scene);
        try {
            law(written(config::read_scene(file().holding(bytes_of(once)))) == once, "a scene survives its file");
        } catch (const config::FileError&) {
            law(false, "a scene that was read can be written and read");
        }
    });
}

void read_appliance(Input input) {
    read(input, [](const std::filesystem::path& path) {
        config::is_appliance_file(path);
        const auto settings = config::read_appliance(
            path, {"a sink", [](const std::string& text) { return text.find(':') != std::string::npos; }});
        for (const host::LinkUrl& link : settings.links) law(link.live, "an appliance's links are live");
    });
}

void read_camera_path(Input input) {
    read(input, [](const std::filesystem::path& path) {
        for (const config::Camera& camera : config::read_camera_path(path))
            law(camera.horizontal_fov.value >= 1.0 && camera.horizontal_fov.value <= 170.0,
                "a camera sees less than all");
    });
}

void read_quality_ladder(Input input) {
    read(input, [](const std::filesystem::path& path) {
        const config::QualityLadder ladder = config::read_quality_ladder(path);
        law(config::default_step(ladder) < ladder.size(), "a ladder has a default");
        std::ostringstream text;
        config::write_quality_ladder(ladder, text);
        try {
            const auto again = config::read_quality_ladder(file().holding(bytes_of(text.str())));
            law(again.size() == ladder.size(), "a ladder survives its file");
            for (std::size_t i = 0; i < ladder.size(); ++i)
                law(again[i].name == ladder[i].name && again[i].quality == ladder[i].quality,
                    "a ladder survives its file");
        } catch (const config::FileError&) {
            law(false, "a ladder that was read can be written and read");
        }
    });
}

}  // namespace quadrig::fuzz
