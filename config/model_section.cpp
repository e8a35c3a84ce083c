#include "config/model_section.h"

#include <map>

#include "config/config_directory.h"
#include "config/object_section.h"
#include "ig_core/scene/placement.h"

namespace quadrig::config {
namespace {

std::filesystem::path models_directory() { return config_directory() / "models"; }

std::filesystem::path file_of(const std::string& model) { return models_directory() / (model + ".toml"); }

/// Names become parts of paths.
bool is_plain(const std::string& name) {
    return name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_") == std::string::npos;
}

bool is_model(const std::string& name) {
    std::error_code none;
    return is_plain(name) && std::filesystem::exists(file_of(name), none);
}

std::string expected_model() { return "the name of a file in " + models_directory().string(); }

}  // namespace

std::vector<Object> read_model(const std::filesystem::path& file) {
    const toml::table document = parse_toml_file(file);
    const TomlSection root(file, document, "", {"object"});
    std::vector<Object> objects;
    Textures none;
    Names names;
    for (const auto& section : root.tables("object", {"name", "ellipsoid", "quadric", "planes", "colour"})) {
        objects.push_back(read_object(section, none));
        objects.back().name = section.text("name");
        take_name(section, objects.back().name, names);
        if (objects.size() > kMostModelObjects) section.refuse("expected at most 1000 objects, found more");
    }
    return objects;
}

Model named_model(const std::string& name) {
    if (!is_model(name)) throw std::runtime_error("model: expected " + expected_model() + ", found \"" + name + "\"");
    return {name, read_model(file_of(name))};
}

std::string model_name(const TomlSection& section) {
    std::string name = section.text("model");
    if (!is_model(name)) section.refuse("model", expected_model(), "\"" + name + "\"");
    return name;
}

void add_models(const TomlSection& document, Names& names, Scene& scene) {
    std::map<std::string, std::vector<Object>> models;
    std::size_t count = 0;
    for (const auto& section : document.tables("model", {"name", "model", "position", "attitude"})) {
        const std::string model = model_name(section), name = section.optional_text("name").value_or(model);
        const auto [known, is_new] = models.try_emplace(model);
        if (is_new) known->second = read_model(file_of(model));
        const ScenePose pose = scene_pose_in(section);
        count += known->second.size();
        if (count > kMostPlacedObjects) section.refuse("expected at most 100000 objects of all models, found more");
        for (const Object& object : known->second) {
            Object& part = scene.objects.emplace_back(*placed(object, pose));
            part.name = name + "." + object.name;
            const auto [first, free] = names.try_emplace(part.name, section.key());
            if (!free)
                section.refuse("expected a name of its own, found an object \"" + part.name + "\", which " +
                               first->second + " has");
        }
    }
}

}  // namespace quadrig::config
