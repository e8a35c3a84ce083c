/// `quadrig generate`: a scene with every cluster written out as its objects.
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "appliance/output_files.h"
#include "config/scene_file.h"
#include "display/atomic_file.h"

namespace quadrig::appliance {
namespace {

struct GenerateOptions {
    std::filesystem::path scene, output;
};

void generate(const GenerateOptions& options) {
    // Its own scene may be what it writes: that has been read by then.
    expect_outputs({options.output}, {}, {});
    std::ostringstream text;
    config::write_scene(config::read_scene(options.scene), text);
    const std::string toml = std::move(text).str();
    if (options.output.empty()) {
        std::cout << toml;
        return;
    }
    display::write_whole(options.output, toml);
}

constexpr const char* kGenerateExamples =
    "The same file gives the same objects, to the last bit, on every machine. What is written is a scene file itself:\n"
    "every object, and every texture that the scene uses.\n\n"
    "Examples:\n"
    "  quadrig generate config/scenes/bench/landscape.toml -o expanded.toml\n"
    "  quadrig generate config/scenes/bench/trees.toml | sha256sum";

}  // namespace

void add_generate(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("generate", "Write a scene with its clusters as objects");
    const auto options = std::make_shared<GenerateOptions>();
    command.add_option("scene", options->scene, "The scene")->required()->option_text("SCENE.toml");
    add_option(command, "-o,--output", options->output, read_path, "Write it here (default: to standard output)",
               "FILE.toml");
    command.footer(kGenerateExamples);
    command.callback([options, &action] { action = [options] { generate(*options); }; });
}

}  // namespace quadrig::appliance
