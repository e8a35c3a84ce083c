#include "config/scene_file.h"

#include <limits>

#include "config/cluster_section.h"
#include "config/ground_section.h"
#include "config/model_section.h"
#include "config/object_section.h"

namespace quadrig::config {
namespace {

constexpr NumberRule kElevation{"degrees in -90..90", [](double x) { return x >= -90.0 && x <= 90.0; }};

Sun read_sun(const TomlSection& section) {
    Sun sun;
    sun.azimuth = {section.number_or("azimuth", kTurn, sun.azimuth.value)};
    sun.elevation = {section.number_or("elevation", kElevation, sun.elevation.value)};
    sun.ambient = section.number_or("ambient", kFraction, sun.ambient);
    return sun;
}

Sky read_sky(const TomlSection& section) {
    Sky sky;
    if (section.has("horizon")) sky.horizon = section.triple("horizon", kColour);
    if (section.has("zenith")) sky.zenith = section.triple("zenith", kColour);
    return sky;
}

Haze read_haze(const TomlSection& section, const Sky& sky) {
    // Without a visibility there is no haze, but its colour still serves a host that sends one. Haze without a colour
    // is the air at the horizon: distant things fade into the sky behind them.
    return {
        section.has("visibility") ? section.number("visibility", kPositive) : std::numeric_limits<double>::infinity(),
        section.has("colour") ? section.triple("colour", kColour) : sky.horizon};
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) {
    const toml::table document = parse_toml_file(file);
    const TomlSection root(file, document, "",
                           {"scene", "sun", "sky", "haze", "ground", "runway", "ground_polygon", "light", "cloud_deck",
                            "texture", "cluster", "model", "object"});
    Scene scene;
    if (const auto header = root.optional_table("scene", {"name", "origin"})) {
        scene.name = header->optional_text("name").value_or("");
        if (const auto origin = optional_geodetic(*header, "origin")) scene.origin = *origin;
    }
    if (const auto sun = root.optional_table("sun", {"azimuth", "elevation", "ambient"})) scene.sun = read_sun(*sun);
    if (const auto sky = root.optional_table("sky", {"horizon", "zenith"})) scene.sky = read_sky(*sky);
    if (const auto haze = root.optional_table("haze", {"visibility", "colour"}))
        scene.haze = read_haze(*haze, scene.sky);

    Textures textures;
    for (const auto& section : root.tables("texture", {"name", "coefficients", "frequencies", "phases", "vertical",
                                                       "drift", "rise", "churn", "pattern", "scale"}))
        textures.read(section);
    if (const auto ground = root.optional_table("ground", {"colour", "texture", "texture_weight"})) {
        scene.ground = Ground{read_paint(*ground, textures)};
    }
    for (const auto& section :
         root.tables("cloud_deck", {"altitude", "colour", "texture", "texture_weight", "translucence"})) {
        scene.cloud_decks.push_back({section.number("altitude", kCoordinate), read_paint(section, textures)});
    }
    add_ground_features(root, textures, scene);
    Names object_names;
    for (const auto& section : root.tables("object", {"name", "ellipsoid", "hill", "quadric", "planes", "colour",
                                                      "texture", "texture_weight", "translucence", "motion"})) {
        scene.objects.push_back(read_object(section, textures));
        if (const auto name = section.optional_text("name")) {
            scene.objects.back().name = *name;
            take_name(section, *name, object_names);
        }
    }
    add_models(root, object_names, scene);
    add_clusters(root, textures, object_names, scene);
    scene.textures = textures.take();
    return scene;
}

}  // namespace quadrig::config
