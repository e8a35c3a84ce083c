/// Textures of a scene by name: its own [[texture]]s, and the patterns that travel along (patterns.toml).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "config/toml_section.h"
#include "ig_core/scene/scene.h"

namespace quadrig::config {

/// Names given so far, each with the key of the table that has it.
using Names = std::unordered_map<std::string, std::string>;

/// Refuses a name that another table has.
void take_name(const TomlSection& section, const std::string& name, Names& taken);

/// The patterns of config_directory()/patterns.toml, in its order; none where that file is not there. Throws FileError.
std::vector<Texture> read_patterns();

/// Reads and finds textures; the list that it fills becomes Scene::textures.
class Textures {
  public:
    /// A [[texture]] of the scene: terms of its own, or a pattern's made larger. Throws FileError.
    void read(const TomlSection& section);

    /// The index of the texture that the section's `texture` names; a pattern is added to the list when it is first
    /// named. Throws FileError where neither has that name.
    std::uint32_t index_of(const TomlSection& section, const std::string& name);

    [[nodiscard]] std::vector<Texture> take() { return std::move(list_); }

  private:
    const std::vector<Texture>& patterns();

    std::optional<std::vector<Texture>> patterns_;  ///< read when first asked for
    std::vector<Texture> list_;
    std::unordered_map<std::string, std::uint32_t> indices_;
    Names names_;
};

}  // namespace quadrig::config
