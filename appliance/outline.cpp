/// `quadrig outline`: the visibility figure of an object.
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>

#include "appliance/camera_view.h"
#include "appliance/commands.h"
#include "appliance/figure_svg.h"
#include "appliance/option_values.h"
#include "appliance/output_files.h"
#include "config/quality_ladder.h"
#include "config/scene_file.h"
#include "display/atomic_file.h"
#include "display/picture.h"
#include "display/png_file.h"
#include "ig_core/image_generator.h"
#include "ig_core/outline/framing.h"

namespace quadrig::appliance {
namespace {

/// What of its panel an object fills where the eye is placed for it: the rest is for curves and lines that go on.
constexpr double kFilled = 0.8;
/// Pixels of the shaded picture for one of the panel's, so that it stays sharp on fine screens.
constexpr int kPictureScale = 2;
constexpr Colour kPaper{1.0};

struct OutlineOptions {
    std::filesystem::path scene, figure;
    std::vector<std::string> objects;
    std::optional<glm::dvec3> eye;
    std::optional<glm::dvec3> attitude;
    config::ImageSize size{480, 480};
    Degrees fov{30.0};
};

const Object& object_named(const Scene& scene, const std::string& name, const std::filesystem::path& file) {
    std::string names;
    for (const Object& object : scene.objects) {
        if (object.name == name) return object;
        if (!object.name.empty()) names += (names.empty() ? "" : ", ") + object.name;
    }
    throw std::runtime_error(file.string() + ": no object is named '" + name + "'; " +
                             (names.empty() ? "none has a name" : "there are: " + names));
}

glm::dvec3 attitude_of(const OutlineOptions& options) {
    return options.attitude.value_or(glm::dvec3(30.0, -20.0, 0.0));
}

View view_of(const OutlineOptions& options, const Object& object, const Solid& solid) {
    const glm::dvec3 angles = attitude_of(options);
    View view = view_from({{}, {{angles.x}, {angles.y}, {angles.z}}, options.fov}, options.size);
    const auto eye = options.eye ? ScenePoint{*options.eye}
                                 : eye_that_frames(solid, view.eye_from_scene, kFilled * view.image.x(view.image.width),
                                                   kFilled * view.image.top);
    if (!eye)
        throw std::runtime_error("'" + object.name +
                                 "' has no extent to frame; say where to look from, with --eye and --attitude");
    view.eye = *eye;
    return view;
}

/// The object by itself, on paper.
std::string shaded(const Scene& scene, const Object& object, const View& view, const OutlineOptions& options) {
    Scene alone;
    alone.origin = scene.origin;
    alone.sun = scene.sun;
    alone.sky = {kPaper, kPaper};
    alone.textures = scene.textures;
    alone.objects = {object};
    View fine = view;
    fine.image =
        ImagePlane::symmetric(kPictureScale * options.size.width, kPictureScale * options.size.height, options.fov);
    display::Picture picture(fine.image.width, fine.image.height);
    ImageGenerator(std::move(alone)).render(fine, {}, config::shipped_ladder().back().quality, picture.image());
    return display::png_bytes(picture.image());
}

std::string subtitle(const Object& object, const OutlineOptions& options, const View& view) {
    const auto kind = [](const auto& shape) {
        using Shape = std::decay_t<decltype(shape)>;
        return std::is_same_v<Shape, Ellipsoid> ? "ellipsoid" : std::is_same_v<Shape, Hill> ? "hill" : "quadric";
    };
    const glm::dvec3 angles = attitude_of(options);
    std::ostringstream text;
    text << std::visit(kind, object.shape) << " with " << object.planes.size()
         << (object.planes.size() == 1 ? " bounding plane" : " bounding planes") << " from " << view.eye.metres.x
         << ", " << view.eye.metres.y << ", " << view.eye.metres.z << " m; heading " << angles.x << "\u00b0, pitch "
         << angles.y << "\u00b0, roll " << angles.z << "\u00b0; field of view " << options.fov.value << "\u00b0";
    return text.str();
}

FigureRow row_of(const Scene& scene, const Object& object, const OutlineOptions& options) {
    const Solid solid = make_solid(object);
    const View view = view_of(options, object, solid);
    const ImagePlane& image = view.image;
    return {object.name, subtitle(object, options, view),
            make_figure(solid, view.eye, view.eye_from_scene,
                        {image.left, image.x(image.width), image.z(image.height), image.top}),
            shaded(scene, object, view, options)};
}

void outline(const OutlineOptions& options) {
    if (options.eye && !options.attitude) throw WrongUse("--eye needs --attitude: where to look from there");
    expect_outputs({options.figure}, {}, {options.scene});
    const Scene scene = config::read_scene(options.scene);
    std::vector<const Object*> objects;
    for (const std::string& name : options.objects) objects.push_back(&object_named(scene, name, options.scene));
    std::vector<FigureRow> rows;
    for (const Object* object : objects) rows.push_back(row_of(scene, *object, options));
    display::write_whole(options.figure, figure_svg(rows, options.size));
}

constexpr const char* kOutlineExamples =
    "Three panels: all curves and lines that can bound the object's picture; the segments of them that are seen,\n"
    "with their key points and the z-bands between; and the shaded object (Gardner 1984, Figure 5). Without --eye\n"
    "each object is looked at from where it fills its panels, along --attitude.\n\n"
    "Examples:\n"
    "  quadrig outline config/scenes/sphere_with_six_planes.toml --object sphere -o sphere.svg\n"
    "  quadrig outline config/scenes/one_tree.toml --object block --object trunk --eye -4,24,3 \\\n"
    "      --attitude -10,-5,0 --size 480x360 --fov 60 -o block_and_trunk.svg";

}  // namespace

void add_outline(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("outline", "Draw how an object's visible outline is found");
    const auto options = std::make_shared<OutlineOptions>();
    command.add_option("scene", options->scene, "The scene")->required()->option_text("SCENE.toml");
    command.add_option("--object", options->objects, "Name of an object (required; may be given again)")
        ->required()
        ->allow_extra_args(false)
        ->option_text("NAME");
    add_option(command, "--eye", options->eye, read_triple, "Where the eye is, metres in the scene", "X,Y,Z");
    add_option(command, "--attitude", options->attitude, read_triple,
               "Heading, pitch and roll, degrees (default: 30,-20,0)", "H,P,R");
    add_option(command, "--size", options->size, read_size, "Pixels of each panel (default: 480x480)", "WxH");
    add_option(command, "--fov", options->fov, read_field_of_view, "Horizontal field of view, degrees (default: 30)",
               "DEG");
    add_option(command, "-o,--output", options->figure, read_path, "Write the figure (required)", "FIGURE.svg")
        ->required();
    command.footer(kOutlineExamples);
    command.callback([options, &action] { action = [options] { outline(*options); }; });
}

}  // namespace quadrig::appliance
