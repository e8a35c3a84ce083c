/// `quadrig render`: one still picture, and what is seen at its pixel centres.
#include <filesystem>
#include <memory>

#include "appliance/camera_view.h"
#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "appliance/output_files.h"
#include "appliance/run_options.h"
#include "config/quality_ladder.h"
#include "config/scene_file.h"
#include "display/npy_file.h"
#include "display/picture.h"
#include "display/png_file.h"
#include "ig_core/image_generator.h"
#include "ig_core/reference/reference_renderer.h"
#include "ig_core/scene/motion.h"

namespace quadrig::appliance {
namespace {

struct RenderOptions {
    std::filesystem::path scene, picture, object_ids, surface_ids, depth;
    glm::dvec3 eye{0.0}, attitude{0.0};
    config::ImageSize size;
    Degrees fov{60.0};
    double seconds = 0.0;
    config::QualityStep quality = config::shipped_ladder()[config::default_step(config::shipped_ladder())];
    int threads = default_threads();
    bool reference = false;
    int samples = 4;

    [[nodiscard]] bool wants_ground_truth() const {
        return !object_ids.empty() || !surface_ids.empty() || !depth.empty();
    }
};

View view_of(const RenderOptions& options) {
    const Attitude attitude{{options.attitude.x}, {options.attitude.y}, {options.attitude.z}};
    return view_from({{options.eye}, attitude, options.fov}, options.size);
}

void write_ground_truth(const RenderOptions& options, const GroundTruth& truth) {
    const auto [columns, rows] = options.size;
    if (!options.object_ids.empty()) display::write_npy(options.object_ids, truth.object_ids, rows, columns);
    if (!options.surface_ids.empty()) display::write_npy(options.surface_ids, truth.surface_ids, rows, columns);
    if (!options.depth.empty()) display::write_npy(options.depth, truth.depth, rows, columns);
}

void render(const RenderOptions& options) {
    if (options.picture.empty() && !options.wants_ground_truth())
        throw WrongUse("nothing to make; ask for -o picture.png, --object-ids, --surface-ids or --depth");
    expect_outputs({options.picture, options.object_ids, options.surface_ids, options.depth}, {}, {options.scene});
    Scene scene = scene_at(config::read_scene(options.scene), options.seconds);
    const View view = view_of(options);
    Environment environment;
    environment.seconds = options.seconds;
    display::Picture picture(options.size.width, options.size.height);
    if (options.reference) {
        if (options.wants_ground_truth()) write_ground_truth(options, reference::ground_truth(scene, view));
        if (options.picture.empty()) return;
        reference::to_srgb8(reference::picture(scene, view, environment, options.samples), picture.image());
    } else {
        ImageGenerator generator(std::move(scene), options.threads);
        if (options.wants_ground_truth()) write_ground_truth(options, generator.ground_truth(view));
        if (options.picture.empty()) return;
        generator.render(view, environment, options.quality.quality, picture.image());
    }
    display::write_png(options.picture, picture.image());
}

constexpr const char* kRenderExamples =
    "Scene axes: X east, Y north, Z up, metres. The eye looks north at heading 0; headings go clockwise,\n"
    "pitch is up, roll is right wing down. The .npy planes are NumPy arrays of rows x columns, row 0 at the top,\n"
    "sampled at pixel centres: int32 object (its index in the scene file, -1 sky, -2 ground), int32 surface (0 the\n"
    "quadric, j its j-th plane), float64 depth k along the look direction in metres (inf for the sky).\n\n"
    "Examples:\n"
    "  quadrig render config/scenes/one_tree.toml --eye 0,0,8 --attitude 0,0,0 --size 640x480 --fov 60 -o tree.png\n"
    "  quadrig render config/scenes/village.toml --eye -60,-200,25 --attitude 15,-5,0 --size 640x480 --fov 60 \\\n"
    "      -o village.png --object-ids ids.npy --depth k.npy\n"
    "  quadrig render config/scenes/village.toml --eye -60,-200,25 --attitude 15,-5,0 --size 640x480 --fov 60 \\\n"
    "      -o exact.png --reference --samples 8";

}  // namespace

void add_render(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("render", "Draw one still picture of a scene");
    const auto options = std::make_shared<RenderOptions>();
    command.add_option("scene", options->scene, "The scene")->required()->option_text("SCENE.toml");
    add_option(command, "--eye", options->eye, read_triple, "Where the eye is, metres in the scene (required)", "X,Y,Z")
        ->required();
    add_option(command, "--attitude", options->attitude, read_triple, "Heading, pitch and roll, degrees (required)",
               "H,P,R")
        ->required();
    add_option(command, "--size", options->size, read_size, "Pixels, 1..16384 each way (required)", "WxH")->required();
    add_option(command, "--fov", options->fov, read_field_of_view,
               "Horizontal field of view, degrees above 0 and below 180 (required)", "DEG")
        ->required();
    add_option(command, "--time", options->seconds, read_scene_time,
               "Scene time, by which textures drift and objects move (default 0)", "S");
    add_option(command, "-o,--output", options->picture, read_path, "Write the picture", "PICTURE.png");
    add_option(command, "--object-ids", options->object_ids, read_path, "Write which object is seen", "IDS.npy");
    add_option(command, "--surface-ids", options->surface_ids, read_path, "Write which of its surfaces is seen",
               "IDS.npy");
    add_option(command, "--depth", options->depth, read_path, "Write how deep it is seen", "K.npy");
    auto* reference = command.add_flag("--reference", options->reference,
                                       "Draw by exact rays instead of the image generator: slow, to judge by");
    command.add_option("--samples", options->samples, "With --reference: N x N rays a pixel, 1..64 (default 4)")
        ->check(CLI::Range(1, 64))
        ->needs(reference)
        ->option_text("N");
    add_option(command, "--quality", options->quality, read_quality,
               config::step_names(config::shipped_ladder()) + " (default: default)", "NAME")
        ->excludes(reference);
    add_threads_option(command, options->threads)->excludes(reference);
    command.footer(kRenderExamples);
    command.callback([options, &action] { action = [options] { render(*options); }; });
}

}  // namespace quadrig::appliance
