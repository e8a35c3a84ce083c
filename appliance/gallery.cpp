/// `quadrig gallery`: every scene of a directory, each from its own camera, and all of them on one page.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "appliance/camera_view.h"
#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "appliance/run_options.h"
#include "config/camera_path.h"
#include "config/config_directory.h"
#include "config/scene_file.h"
#include "display/contact_sheet.h"
#include "display/png_file.h"
#include "ig_core/image_generator.h"

namespace quadrig::appliance {
namespace {

constexpr int kSheetColumns = 3, kMostThumbnailWidth = 400;

struct GalleryOptions {
    std::filesystem::path scenes = config::config_directory() / "scenes" / "gallery", output;
    config::ImageSize size{1280, 720};
    config::QualityStep quality = config::shipped_ladder().back();
    int threads = default_threads();
};

std::vector<std::filesystem::path> scenes_in(const std::filesystem::path& directory) {
    std::error_code error;
    const std::filesystem::directory_iterator entries(directory, error);
    if (error) throw std::runtime_error(directory.string() + ": cannot be read: " + error.message());
    std::vector<std::filesystem::path> scenes;
    for (const auto& entry : entries)
        if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
    std::sort(scenes.begin(), scenes.end());
    if (scenes.empty()) throw std::runtime_error(directory.string() + ": there are no scenes, *.toml, in it");
    return scenes;
}

display::Picture picture_of(const std::filesystem::path& scene, const GalleryOptions& options) {
    const config::Camera camera =
        config::read_camera_path(std::filesystem::path(scene).replace_extension(".json")).front();
    display::Picture picture(options.size.width, options.size.height);
    ImageGenerator(config::read_scene(scene), options.threads)
        .render(view_from(camera, options.size), {}, options.quality.quality, picture.image());
    return picture;
}

void gallery(const GalleryOptions& options) {
    const auto scenes = scenes_in(options.scenes);
    std::filesystem::create_directories(options.output);
    const int width = std::min(options.size.width, kMostThumbnailWidth);
    const int height = std::max(1, options.size.height * width / options.size.width);
    const int rows = (static_cast<int>(scenes.size()) + kSheetColumns - 1) / kSheetColumns;
    display::ContactSheet sheet(kSheetColumns, rows, width, height);
    for (const auto& scene : scenes) {
        display::Picture picture = picture_of(scene, options);
        display::write_png(options.output / scene.filename().replace_extension(".png"), picture.image());
        sheet.add(picture.image());
    }
    display::write_png(options.output / "contact_sheet.png", sheet.image());
}

constexpr const char* kGalleryExamples =
    "A directory of scenes NAME.toml, each with a camera path NAME.json whose first camera is taken. Without --scenes\n"
    "it is the gallery that travels along: the figures of Gardner 1984, and more.\n\n"
    "Example:\n"
    "  quadrig gallery -o gallery";

}  // namespace

void add_gallery(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("gallery", "Draw all scenes of a directory, and a page of them");
    const auto options = std::make_shared<GalleryOptions>();
    add_option(command, "-o,--output", options->output, read_path,
               "Write NAME.png and contact_sheet.png here (required)", "DIRECTORY")
        ->required();
    add_option(command, "--scenes", options->scenes, read_path, "Where the scenes and their cameras are", "DIRECTORY");
    add_option(command, "--size", options->size, read_size, "Pixels of each picture (default: 1280x720)", "WxH");
    add_option(command, "--quality", options->quality, read_quality,
               config::step_names(config::shipped_ladder()) + " (default: best)", "NAME");
    add_threads_option(command, options->threads);
    command.footer(kGalleryExamples);
    command.callback([options, &action] { action = [options] { gallery(*options); }; });
}

}  // namespace quadrig::appliance
