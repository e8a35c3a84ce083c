/// `quadrig patterns`: which texture patterns there are, and what they look like.
#include <filesystem>
#include <iostream>
#include <memory>

#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "appliance/output_files.h"
#include "appliance/pattern_sheet.h"
#include "config/config_directory.h"
#include "config/texture_section.h"
#include "display/png_file.h"

namespace quadrig::appliance {
namespace {

struct PatternsOptions {
    std::filesystem::path sheet;
    double seconds = 0.0;
};

void patterns(const PatternsOptions& options) {
    expect_outputs({options.sheet}, {}, {});
    const std::vector<Texture> all = config::read_patterns();
    if (all.empty()) throw std::runtime_error("there is no patterns.toml in " + config::config_directory().string());
    for (const Texture& pattern : all) std::cout << pattern.name << '\n';
    if (options.sheet.empty()) return;
    display::Picture sheet = pattern_sheet(all, options.seconds);
    display::write_png(options.sheet, sheet.image());
}

constexpr const char* kPatternsExamples =
    "Scenes name a pattern like a texture of their own: texture = \"foliage\". The sheet has a row for each, in the\n"
    "order in which the names are printed: on a plane, a hill and an ellipsoid, each at three distances.\n\n"
    "Example:\n"
    "  quadrig patterns -o sheet.png";

}  // namespace

void add_patterns(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("patterns", "Name the texture patterns, and draw a sheet of them");
    const auto options = std::make_shared<PatternsOptions>();
    add_option(command, "-o,--output", options->sheet, read_path, "Draw the sheet", "SHEET.png");
    add_option(command, "--time", options->seconds, read_scene_time, "Scene time, which patterns drift by (default 0)",
               "S");
    command.footer(kPatternsExamples);
    command.callback([options, &action] { action = [options] { patterns(*options); }; });
}

}  // namespace quadrig::appliance
