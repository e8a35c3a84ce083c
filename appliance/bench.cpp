/// `quadrig bench`: how long frames take along a camera path.
#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include "appliance/camera_view.h"
#include "appliance/commands.h"
#include "appliance/frame_run.h"
#include "appliance/option_values.h"
#include "appliance/outlets.h"
#include "appliance/output_files.h"
#include "appliance/painter.h"
#include "appliance/run_options.h"
#include "appliance/run_report.h"
#include "appliance/stop_signals.h"
#include "config/camera_path.h"
#include "config/scene_file.h"

namespace quadrig::appliance {
namespace {

struct BenchOptions : RunOptions {
    std::filesystem::path scene, path;
};

std::vector<View> views_along(const std::vector<config::Camera>& cameras, const config::ImageSize& size) {
    std::vector<View> views;
    for (const config::Camera& camera : cameras) views.push_back(view_from(camera, size));
    return views;
}

void bench(const BenchOptions& options) {
    expect_outputs({options.report}, {}, {options.scene, options.path, options.ladder});
    watch_stop_signals();
    const PictureSettings settings = picture_settings(options, options.settings);
    const std::vector<View> views = views_along(config::read_camera_path(options.path), settings.size);
    const std::uint64_t frames = options.frames.value_or(views.size());
    Painter painter(config::read_scene(options.scene), settings);
    Outlets outlets({{}, {}, display::WhenFull::drop, {}, frames, {}});
    painter.warm_up(views.front());

    const auto draw = [&](const scheduler::FrameTick& tick) {
        Environment environment;
        environment.seconds = std::chrono::duration<double>(tick.elapsed).count();
        scheduler::DrawnFrame drawn;
        drawn.stages = painter.paint(views[tick.number % views.size()], environment, tick.number);
        return drawn;
    };
    scheduler::FrameReport report = report_about(painter);
    scheduler::FrameRecord record;
    run_as_fast_as_possible(
        settings.rate, {frames, std::nullopt},
        {stop_requested, draw,
         [&](const scheduler::FrameTick& tick) { outlets.hand_over(painter.image(), tick.number); }},
        record);
    finish_report(report, record, painter, outlets, options.report);
}

constexpr const char* kBenchNotes =
    "CAMERAS.json is an array of eyes; frame k is seen from the k-th, and after the last from the first again:\n"
    "  [{\"eye\": [0, 0, 8], \"attitude\": [10, 0, 0], \"fov\": 60}, ...]\n"
    "--rate only says how far textures drift from frame to frame; frames follow each other as fast as they can.\n\n"
    "Example:\n"
    "  quadrig bench config/scenes/takeoff.toml --path config/scenes/takeoff_cameras.json --frames 600 --threads 2 \\\n"
    "      --report bench.json";

}  // namespace

void add_bench(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("bench", "Measure frame times along a camera path, without sinks");
    const auto options = std::make_shared<BenchOptions>();
    command.add_option("scene", options->scene, "The scene")->required()->option_text("SCENE.toml");
    add_option(command, "--path", options->path, read_path, "The camera path (required)", "CAMERAS.json")->required();
    add_option(command, "--frames", options->frames, read_count, "How many (default: one from each camera)", "N");
    add_picture_options(command, *options);
    command.footer(kBenchNotes);
    command.callback([options, &action] { action = [options] { bench(*options); }; });
}

}  // namespace quadrig::appliance
