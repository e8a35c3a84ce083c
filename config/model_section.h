/// [[model]] tables of a scene file: models of config_directory()/models set down in the scene.
#pragma once

#include "config/texture_section.h"
#include "config/toml_section.h"
#include "ig_core/scene/scene.h"

namespace quadrig::config {

/// Most objects of one model, and of all models of a scene together.
inline constexpr std::size_t kMostModelObjects = 1000, kMostPlacedObjects = 100'000;

/// The objects of a model in its own axes (X right, Y forward, Z up, metres): a file of [[object]]s without textures
/// and hills. Throws FileError.
std::vector<Object> read_model(const std::filesystem::path& file);

/// A model by its name: a file in config_directory()/models. Throws std::runtime_error where there is none of that
/// name, FileError where it is wrong.
Model named_model(const std::string& name);

/// What a table's `model` names; throws FileError where that is no file in config_directory()/models.
std::string model_name(const TomlSection& section);

/// Puts the objects of the document's models behind those the scene has; `names` are the objects' names so far. Throws
/// FileError.
void add_models(const TomlSection& document, Names& names, Scene& scene);

}  // namespace quadrig::config
