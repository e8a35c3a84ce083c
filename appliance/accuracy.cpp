/// `quadrig accuracy`: what every setting of Quality costs, and how far its pictures are from the truth.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "appliance/accuracy_report.h"
#include "appliance/accuracy_settings.h"
#include "appliance/camera_view.h"
#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "appliance/output_files.h"
#include "appliance/run_options.h"
#include "config/camera_path.h"
#include "config/scene_file.h"
#include "display/atomic_file.h"
#include "display/picture.h"
#include "frame_scheduler/machine.h"
#include "ig_core/image_generator.h"
#include "ig_core/reference/error.h"

namespace quadrig::appliance {
namespace {

struct AccuracyOptions {
    std::filesystem::path scene, path, json, plot, ladder;
    config::ImageSize size{640, 480};
    int threads = default_threads();
    int runs = 15;
    bool against_finest = false;
};

/// What is true from one camera.
struct Truth {
    View view;
    GroundTruth seen;
    std::vector<std::uint8_t> ties;
    reference::LinearImage picture;
};

Truth truth_at(const Scene& scene, const View& view) {
    Truth truth{view, {}, {}, {}};
    truth.seen = reference::ground_truth(scene, view, &truth.ties);
    truth.picture = reference::converged_picture(scene, view, {}).image;
    return truth;
}

/// The best that the image generator itself can do, for pictures whose exact ones would take hours.
constexpr Quality kFinest{.sub_scan_lines = 8, .shading = ShadingRate::four};
Truth finest_at(ImageGenerator& generator, const View& view) {
    display::Picture picture(view.image.width, view.image.height);
    generator.render(view, {}, kFinest, picture.image());
    Truth truth{view, generator.ground_truth(view), {}, reference::linear_image(picture.image())};
    truth.ties.resize(truth.seen.object_ids.size());
    return truth;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void measure_errors(ImageGenerator& generator, const Truth& truth, SettingResult& result) {
    display::Picture picture(truth.view.image.width, truth.view.image.height);
    generator.render(truth.view, {}, result.quality, picture.image());
    CameraResult& camera = result.cameras.emplace_back();
    camera.visibility =
        reference::visibility_error(generator.ground_truth(truth.view, result.quality), truth.seen, truth.ties);
    camera.picture = reference::picture_error(picture.image(), truth.picture);
}

/// All settings take turns, so that the machine's better and worse moments fall on all of them alike.
void measure_times(ImageGenerator& generator, const View& view, int runs, std::size_t camera,
                   std::vector<SettingResult>& results) {
    display::Picture picture(view.image.width, view.image.height);
    std::vector<std::vector<double>> ms(results.size());
    for (int run = 0; run < runs; ++run) {
        for (std::size_t i = 0; i < results.size(); ++i) {
            const auto begun = std::chrono::steady_clock::now();
            generator.render(view, {}, results[i].quality, picture.image());
            ms[i].push_back(
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count());
        }
    }
    for (std::size_t i = 0; i < results.size(); ++i) {
        std::vector<double> shares;
        for (std::size_t run = 0; run < ms[i].size(); ++run) shares.push_back(ms[i][run] / ms[0][run]);
        results[i].cameras[camera].frame_ms = median(ms[i]);
        results[i].cameras[camera].cost = median(shares);
    }
}

std::vector<SettingResult> measure(const AccuracyOptions& options) {
    const auto cameras = config::read_camera_path(options.path);
    const Scene scene = config::read_scene(options.scene);
    ImageGenerator generator(scene, options.threads);
    std::vector<SettingResult> results;
    for (const Quality& quality : accuracy_settings())
        if (!options.against_finest || quality != kFinest) results.push_back({quality, {}, 0, 0, {}, {}, false});
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        std::cerr << "camera " << i + 1 << " of " << cameras.size() << ": the "
                  << (options.against_finest ? "finest" : "exact") << " picture ..." << std::flush;
        const View view = view_from(cameras[i], options.size);
        const Truth truth = options.against_finest ? finest_at(generator, view) : truth_at(scene, view);
        std::cerr << " " << results.size() << " settings ..." << std::flush;
        for (SettingResult& result : results) measure_errors(generator, truth, result);
        measure_times(generator, truth.view, options.runs, i, results);
        std::cerr << " done\n";
    }
    sum_up(results);
    return results;
}

/// How the figures were got, in one line.
std::string conditions(const AccuracyOptions& options) {
    const auto machine = scheduler::this_machine();
    std::ostringstream out;
    out << options.scene.filename().string() << ", " << options.size.width << "x" << options.size.height << ", "
        << options.runs << " paired runs, " << machine.cpu << ", " << options.threads
        << (options.threads == 1 ? " thread, " : " threads, ") << ImageGenerator::simd_target() << ", " << machine.build
        << (options.against_finest ? ", errors against " + config::words_for(kFinest) : "");
    return out.str();
}

void accuracy(const AccuracyOptions& options) {
    expect_outputs({options.json, options.plot, options.ladder}, {}, {options.scene, options.path});
    const std::vector<SettingResult> results = measure(options);
    std::cout << conditions(options) << '\n' << accuracy_table(results);
    if (!options.json.empty()) {
        nlohmann::ordered_json json{{"quadrig", QUADRIG_VERSION},
                                    {"conditions", conditions(options)},
                                    {"scene", options.scene.string()},
                                    {"settings", accuracy_json(results)}};
        display::write_whole(options.json, json.dump(2) + "\n");
    }
    if (!options.plot.empty())
        display::write_whole(options.plot,
                             accuracy_plot(results, options.scene.stem().string() + ": speed against error"));
    if (!options.ladder.empty()) {
        std::ostringstream text;
        text << "# The quality ladder, from the fastest step to the best, as `quadrig accuracy` measured it:\n# "
             << conditions(options)
             << ".\n# `cost` is frame time as a share of the default's, `psnr` in dB, linear light.\n";
        config::write_quality_ladder(ladder_from(results), text);
        display::write_whole(options.ladder, text.str());
    }
}

constexpr const char* kAccuracyNotes =
    "Errors are against the exact renderer: another object or surface at a pixel's centre (true ties apart), relative\n"
    "depth where they agree, and the picture against one supersampled until it does not change: PSNR in linear light,\n"
    "steps of 255 in sRGB. Times are medians of runs in which all settings take turns; cost is the median of the\n"
    "time's ratio to the default's in the same run. The exact picture takes half a minute a camera at 640x480,\n"
    "minutes at 1920x1080.\n\n"
    "Example:\n"
    "  quadrig accuracy config/scenes/takeoff.toml --path config/scenes/takeoff_cameras.json --plot accuracy.svg";

}  // namespace

void add_accuracy(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("accuracy", "Measure speed against error of every quality setting");
    const auto options = std::make_shared<AccuracyOptions>();
    command.add_option("scene", options->scene, "The scene")->required()->option_text("SCENE.toml");
    add_option(command, "--path", options->path, read_path, "The cameras (required)", "CAMERAS.json")->required();
    add_option(command, "--size", options->size, read_size, "Pixels of the picture (default 640x480)", "WxH");
    add_threads_option(command, options->threads);
    command.add_option("--runs", options->runs, "Paired runs, 1..10000 (default 15)")
        ->check(CLI::Range(1, 10000))
        ->option_text("N");
    add_option(command, "--json", options->json, read_path, "Write all figures, by camera too", "FILE.json");
    add_option(command, "--plot", options->plot, read_path, "Plot frame time against PSNR", "FILE.svg");
    CLI::Option* ladder = add_option(command, "--ladder", options->ladder, read_path,
                                     "Make a quality ladder of the settings worth having", "LADDER.toml");
    command
        .add_flag("--against-finest", options->against_finest,
                  "Errors against the finest setting's picture, not the exact one: for large pictures")
        ->excludes(ladder);
    command.footer(kAccuracyNotes);
    command.callback([options, &action] { action = [options] { accuracy(*options); }; });
}

}  // namespace quadrig::appliance
