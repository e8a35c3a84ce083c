#include "appliance/run_options.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "config/model_section.h"
#include "config/scene_file.h"

namespace quadrig::appliance {

void add_picture_options(CLI::App& command, RunOptions& options) {
    config::ApplianceSettings& settings = options.settings;
    add_option(command, "--size", settings.size, read_size, "Pixels of the picture (default 1280x720)", "WxH");
    add_option(command, "--rate", settings.rate, read_rate, "Frames a second, 1..1000 (default 60)", "HZ");
    add_threads_option(command, settings.threads);
    command
        .add_option(
            "--quality", settings.quality,
            "A step of the quality ladder: " + config::quality_names(config::shipped_ladder()) + "\n(default: default)")
        ->option_text("NAME");
    add_option(command, "--ladder", options.ladder, read_path,
               "A quality ladder of your own (quadrig accuracy makes them)", "LADDER.toml");
    add_option(command, "--report", options.report, read_path, "Write the run's report to a file, as JSON",
               "FILE.json");
}

void add_host_options(CLI::App& command, RunOptions& options) {
    config::ApplianceSettings& settings = options.settings;
    add_option(command, "--scene", settings.scene, read_path, "The scene to fly through (required)", "SCENE.toml");
    add_list_option(command, "--sink", settings.sinks, read_sink,
                    "Where pictures go: png:DIRECTORY, y4m:FILE (y4m:- is standard\n"
                    "output), none:. May be given again (default: nowhere)",
                    "URL");
    add_list_option(command, "--entity", settings.entities, read_entity,
                    "Draw the host's entities of a type as a model of config/models.\nMay be given again",
                    "TYPE=MODEL");
    add_option(command, "--contact-sheet", options.contact_sheet, read_path, "Write a page of evenly spaced frames",
               "FILE.png");
    add_option(command, "--fov", settings.fov, read_field_of_view, "Horizontal field of view, degrees (default 60)",
               "DEG");
    command.add_flag("--ignore-host-window", options.ignore_host_window,
                     "Keep --fov also where a host sends a view window of its own\n(CIGI View Definition)");
    command.add_flag("--overlay", options.overlay, "Lay a centre cross and the frame's number over the picture");
    auto* frames = add_option(command, "--frames", options.frames, read_count, "Stop after N frames", "N");
    add_option(command, "--seconds", options.duration, read_duration, "Stop after S seconds", "S")->excludes(frames);
}

int default_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

Scene scene_with_entities(const config::ApplianceSettings& settings) {
    Scene scene = config::read_scene(*settings.scene);
    for (const auto& entity : settings.entities) scene.models.push_back(config::named_model(entity.model));
    return scene;
}

std::vector<int> entity_types(const config::ApplianceSettings& settings) {
    std::vector<int> types;
    for (const auto& entity : settings.entities) {
        const int* type = std::get_if<int>(&entity.placed_by);
        types.push_back(type != nullptr ? *type : -1);
    }
    return types;
}

PictureSettings picture_settings(const RunOptions& options, const config::ApplianceSettings& settings) {
    config::QualityLadder ladder =
        options.ladder.empty() ? config::shipped_ladder() : config::read_quality_ladder(options.ladder);
    const bool automatic = settings.quality == config::kAutomaticQuality;
    const auto step =
        automatic ? config::default_step(ladder) : config::step_named(ladder, settings.quality.value_or("default"));
    if (!step) throw WrongUse("--quality " + *settings.quality + ": expected " + config::quality_names(ladder));
    return {settings.size.value_or(config::ImageSize{}),
            settings.fov.value_or(Degrees{60.0}),
            settings.rate.value_or(scheduler::FrameRate{}),
            settings.threads.value_or(default_threads()),
            std::move(ladder),
            *step,
            automatic,
            options.overlay};
}

}  // namespace quadrig::appliance
