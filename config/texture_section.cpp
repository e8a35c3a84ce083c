#include "config/texture_section.h"

#include <numeric>
#include <utility>

namespace quadrig::config {
namespace {

Texture read_texture(const TomlSection& section) {
    Texture texture;
    texture.name = section.text("name");
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

}  // namespace

void take_name(const TomlSection& section, const std::string& name, Names& taken) {
    const auto [first, is_new] = taken.try_emplace(name, section.key());
    if (!is_new) section.refuse("name", "a name of its own", "\"" + name + "\", which " + first->second + " has");
}

void Textures::read(const TomlSection& section) {
    Texture texture = read_texture(section);
    take_name(section, texture.name, names_);
    indices_.emplace(texture.name, static_cast<std::uint32_t>(list_.size()));
    list_.push_back(std::move(texture));
}

std::uint32_t Textures::index_of(const TomlSection& section, const std::string& name) {
    const auto found = indices_.find(name);
    if (found == indices_.end()) section.refuse("texture", "the name of a [[texture]]", "\"" + name + "\"");
    return found->second;
}

}  // namespace quadrig::config
