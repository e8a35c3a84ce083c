#include "config/scene_file.h"

#include <numeric>
#include <unordered_map>
#include <utility>

#include "config/convexity.h"
#include "config/toml_section.h"

namespace quadrig::config {
namespace {

// Far beyond any scene, near enough that squares of products stay finite in a double.
constexpr NumberRule kCoordinate{"metres in -1e9..1e9", [](double x) { return x >= -1e9 && x <= 1e9; }};
constexpr NumberRule kLength{"metres in 1e-6..1e9", [](double x) { return x >= 1e-6 && x <= 1e9; }};
constexpr NumberRule kSlope{"a slope in 1e-6..1e6", [](double x) { return x >= 1e-6 && x <= 1e6; }};
constexpr NumberRule kCoefficient{"a coefficient in -1e60..1e60", [](double x) { return x >= -1e60 && x <= 1e60; }};
constexpr NumberRule kColour{"linear light in 0..1", kFraction.holds};
constexpr NumberRule kLatitude{"degrees in -90..90", [](double x) { return x >= -90.0 && x <= 90.0; }};
constexpr NumberRule kLongitude{"degrees in -180..360", [](double x) { return x >= -180.0 && x <= 360.0; }};
constexpr NumberRule kTurn{"degrees in -360..360", [](double x) { return x >= -360.0 && x <= 360.0; }};
constexpr NumberRule kThreshold{"a threshold in -10..10", [](double x) { return x >= -10.0 && x <= 10.0; }};

/// Names given so far, each with the key of the table that has it.
using Names = std::unordered_map<std::string, std::string>;

void take_name(const TomlSection& section, const std::string& name, Names& taken) {
    const auto [first, is_new] = taken.try_emplace(name, section.key());
    if (!is_new) section.refuse("name", "a name of its own", "\"" + name + "\", which " + first->second + " has");
}

Attitude attitude_from(const glm::dvec3& degrees) { return {{degrees.x}, {degrees.y}, {degrees.z}}; }

GeodeticPosition read_origin(const TomlSection& origin) {
    return {{origin.number("latitude", kLatitude)},
            {origin.number("longitude", kLongitude)},
            origin.number("altitude", kCoordinate)};
}

Texture read_texture(const TomlSection& section, Names& taken) {
    Texture texture;
    texture.name = section.text("name");
    take_name(section, texture.name, taken);
    constexpr std::size_t kMost = kMaxTextureTerms;
    const auto coefficients = section.numbers("coefficients", kNotNegative, 1, kMost);
    const auto frequencies = section.numbers("frequencies", kPositive, 1, kMost);
    const auto phases = section.numbers("phases", kAnyNumber, 1, kMost);
    const auto refuse_other_length = [&](std::string_view name, const std::vector<double>& values) {
        if (values.size() == coefficients.size()) return;
        section.refuse(name, "as many as the " + std::to_string(coefficients.size()) + " coefficients",
                       "an array of " + std::to_string(values.size()));
    };
    refuse_other_length("frequencies", frequencies);
    refuse_other_length("phases", phases);
    if (std::accumulate(coefficients.begin(), coefficients.end(), 0.0) <= 0.0) {
        section.refuse("coefficients", "a sum above 0", "0");
    }
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        texture.terms.push_back({coefficients[i], frequencies[i], phases[i]});
    }
    texture.vertical = section.number_or("vertical", kNotNegative, texture.vertical);
    if (section.has("drift")) texture.drift = section.pair("drift", kAnyNumber);
    return texture;
}

Translucence read_translucence(const TomlSection& section) {
    Translucence translucence;
    translucence.threshold = section.number("threshold", kThreshold);
    translucence.limb_threshold = section.number_or("limb_threshold", kThreshold, translucence.threshold);
    translucence.softness = section.number_or("softness", kPositive, translucence.softness);
    if (translucence.limb_threshold < translucence.threshold) {
        section.refuse("limb_threshold", "at least the threshold", "less");
    }
    return translucence;
}

/// Indices of Scene::textures by name.
using TextureIndices = std::unordered_map<std::string, std::uint32_t>;

Paint read_paint(const TomlSection& section, const TextureIndices& textures) {
    Paint paint;
    if (section.has("colour")) paint.colour = section.triple("colour", kColour);
    if (const auto name = section.optional_text("texture")) {
        const auto found = textures.find(*name);
        if (found == textures.end()) section.refuse("texture", "the name of a [[texture]]", "\"" + *name + "\"");
        paint.texture = found->second;
    }
    paint.texture_weight = section.number_or("texture_weight", kFraction, paint.texture_weight);
    if (paint.texture_weight > 0.0 && !paint.texture) section.refuse("texture_weight", "a texture beside it", "none");
    if (!section.has("translucence")) return paint;
    if (!paint.texture) section.refuse("translucence", "a texture beside it", "none");
    paint.translucence = read_translucence(section.table("translucence", {"threshold", "limb_threshold", "softness"}));
    return paint;
}

Ellipsoid read_ellipsoid(const TomlSection& section) {
    Ellipsoid ellipsoid;
    ellipsoid.centre = {section.triple("centre", kCoordinate)};
    ellipsoid.semi_axes = section.triple("semi_axes", kLength);
    if (section.has("attitude")) {
        ellipsoid.attitude = attitude_from(section.triple("attitude", kTurn));
        if (section.has("heading")) section.refuse("heading", "either heading or attitude", "both");
    }
    if (section.has("heading")) ellipsoid.attitude.heading = {section.number("heading", kTurn)};
    return ellipsoid;
}

Hill read_hill(const TomlSection& section) {
    return {{section.triple("apex", kCoordinate)},
            section.number("radius_of_curvature", kLength),
            section.number("slope", kSlope)};
}

Shape read_shape(const TomlSection& object) {
    const int shapes = int{object.has("ellipsoid")} + int{object.has("hill")} + int{object.has("quadric")};
    if (shapes != 1) {
        object.refuse(std::string("expected one of ellipsoid, hill, quadric, found ") +
                      (shapes == 0 ? "none" : "more"));
    }
    if (const auto ellipsoid = object.optional_table("ellipsoid", {"centre", "semi_axes", "heading", "attitude"})) {
        return read_ellipsoid(*ellipsoid);
    }
    if (const auto hill = object.optional_table("hill", {"apex", "radius_of_curvature", "slope"}))
        return read_hill(*hill);
    GeneralQuadric quadric;
    const auto numbers =
        object.numbers("quadric", kCoefficient, quadric.coefficients.size(), quadric.coefficients.size());
    std::copy(numbers.begin(), numbers.end(), quadric.coefficients.begin());
    return quadric;
}

std::vector<BoundingPlane> read_planes(const TomlSection& object) {
    std::vector<BoundingPlane> planes;
    for (const auto& row : object.rows("planes", kCoefficient, 4, kMaxPlanes)) {
        if (row[0] == 0.0 && row[1] == 0.0 && row[2] == 0.0) {
            object.refuse("planes", planes.size(), "a normal B1, B2, B3 other than 0", "0, 0, 0");
        }
        planes.push_back({{row[0], row[1], row[2], row[3]}});
    }
    return planes;
}

Object read_object(const TomlSection& section, const TextureIndices& textures, Names& taken) {
    Object object;
    if (const auto name = section.optional_text("name")) {
        object.name = *name;
        take_name(section, object.name, taken);
    }
    object.shape = read_shape(section);
    object.planes = read_planes(section);
    object.paint = read_paint(section, textures);
    if (const auto* quadric = std::get_if<GeneralQuadric>(&object.shape)) {
        if (const auto reason = why_not_convex(*quadric, object.planes)) {
            section.refuse("quadric", "a solid Q <= 0 that is one convex piece within its planes", "that " + *reason);
        }
    }
    return object;
}

Sun read_sun(const TomlSection& section) {
    Sun sun;
    sun.azimuth = {section.number_or("azimuth", kTurn, sun.azimuth.value)};
    sun.elevation = {section.number_or("elevation", kLatitude, sun.elevation.value)};
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
    // Haze without a colour is the air at the horizon: distant things fade into the sky behind them.
    return {section.number("visibility", kPositive),
            section.has("colour") ? section.triple("colour", kColour) : sky.horizon};
}

}  // namespace

Scene read_scene(const std::filesystem::path& file) {
    const toml::table document = parse_toml_file(file);
    const TomlSection root(file, document, "",
                           {"scene", "sun", "sky", "haze", "ground", "cloud_deck", "texture", "object"});
    Scene scene;
    if (const auto header = root.optional_table("scene", {"name", "origin"})) {
        scene.name = header->optional_text("name").value_or("");
        if (const auto origin = header->optional_table("origin", {"latitude", "longitude", "altitude"})) {
            scene.origin = read_origin(*origin);
        }
    }
    if (const auto sun = root.optional_table("sun", {"azimuth", "elevation", "ambient"})) scene.sun = read_sun(*sun);
    if (const auto sky = root.optional_table("sky", {"horizon", "zenith"})) scene.sky = read_sky(*sky);
    if (const auto haze = root.optional_table("haze", {"visibility", "colour"}))
        scene.haze = read_haze(*haze, scene.sky);

    Names texture_names;
    TextureIndices textures;
    for (const auto& section :
         root.tables("texture", {"name", "coefficients", "frequencies", "phases", "vertical", "drift"})) {
        const auto index = static_cast<std::uint32_t>(scene.textures.size());
        scene.textures.push_back(read_texture(section, texture_names));
        textures.emplace(scene.textures.back().name, index);
    }
    if (const auto ground = root.optional_table("ground", {"colour", "texture", "texture_weight"})) {
        scene.ground = Ground{read_paint(*ground, textures)};
    }
    for (const auto& section :
         root.tables("cloud_deck", {"altitude", "colour", "texture", "texture_weight", "translucence"})) {
        scene.cloud_decks.push_back({section.number("altitude", kCoordinate), read_paint(section, textures)});
    }
    Names object_names;
    for (const auto& section : root.tables("object", {"name", "ellipsoid", "hill", "quadric", "planes", "colour",
                                                      "texture", "texture_weight", "translucence"})) {
        scene.objects.push_back(read_object(section, textures, object_names));
    }
    return scene;
}

}  // namespace quadrig::config
