#include "config/texture_section.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "config/config_directory.h"

namespace quadrig::config {
namespace {

constexpr double kMost = 1e60;  // products, and squares of sums, are to be numbers still, and no zeros
constexpr NumberRule kUpwards{"a number in 0..1e60", [](double x) { return x >= 0.0 && x <= kMost; }};
constexpr NumberRule kEitherWay{"a number in -1e60..1e60", [](double x) { return x >= -kMost && x <= kMost; }};
constexpr NumberRule kFrequency{"a number above 0 and at most 1e60", [](double x) { return x > 0.0 && x <= kMost; }};
constexpr NumberRule kScale{"a factor in 1e-6..1e6", [](double x) { return x >= 1e-6 && x <= 1e6; }};

std::vector<TextureTerm> read_terms(const TomlSection& section) {
    const auto coefficients = section.numbers("coefficients", kUpwards, 1, kMaxTextureTerms);
    const auto frequencies = section.numbers("frequencies", kFrequency, 1, kMaxTextureTerms);
    const auto phases = section.numbers("phases", kEitherWay, 1, kMaxTextureTerms);
    const auto refuse_other_length = [&](std::string_view name, const std::vector<double>& values) {
        if (values.size() == coefficients.size()) return;
        section.refuse(name, "as many as the " + std::to_string(coefficients.size()) + " coefficients",
                       "an array of " + std::to_string(values.size()));
    };
    refuse_other_length("frequencies", frequencies);
    refuse_other_length("phases", phases);
    if (std::accumulate(coefficients.begin(), coefficients.end(), 0.0) < 1.0 / kMost) {
        section.refuse("coefficients", "a sum of at least 1e-60", "less");
    }
    std::vector<TextureTerm> terms;
    for (std::size_t i = 0; i < coefficients.size(); ++i) terms.push_back({coefficients[i], frequencies[i], phases[i]});
    return terms;
}

/// Vertical variation, and what moves with time; what is absent stays.
void read_movement(const TomlSection& section, Texture& texture) {
    texture.vertical = section.number_or("vertical", kUpwards, texture.vertical);
    if (section.has("drift")) texture.drift = section.pair("drift", kEitherWay);
    texture.rise = section.number_or("rise", kEitherWay, texture.rise);
    texture.churn = section.number_or("churn", kEitherWay, texture.churn);
}

const Texture* named(const std::vector<Texture>& textures, const std::string& name) {
    const auto found =
        std::find_if(textures.begin(), textures.end(), [&](const Texture& texture) { return texture.name == name; });
    return found == textures.end() ? nullptr : &*found;
}

/// A pattern under another name, its lengths times `scale`.
Texture read_scaled_pattern(const TomlSection& section, const std::vector<Texture>& patterns) {
    for (const std::string_view other : {"coefficients", "frequencies", "phases"})
        if (section.has(other)) section.refuse(other, "terms or a pattern", "both");
    const std::string name = section.text("pattern");
    const Texture* pattern = named(patterns, name);
    if (pattern == nullptr) section.refuse("pattern", "the name of a pattern", "\"" + name + "\"");
    Texture texture = *pattern;
    const double scale = section.number_or("scale", kScale, 1.0);
    for (TextureTerm& term : texture.terms) term.frequency /= scale;
    return texture;
}

}  // namespace

void take_name(const TomlSection& section, const std::string& name, Names& taken) {
    const auto [first, is_new] = taken.try_emplace(name, section.key());
    if (!is_new) section.refuse("name", "a name of its own", "\"" + name + "\", which " + first->second + " has");
}

std::vector<Texture> read_patterns() {
    const std::filesystem::path file = config_directory() / "patterns.toml";
    if (!std::filesystem::exists(file)) return {};
    const toml::table document = parse_toml_file(file);
    const TomlSection root(file, document, "", {"texture"});
    std::vector<Texture> patterns;
    Names names;
    for (const auto& section : root.tables(
             "texture", {"name", "coefficients", "frequencies", "phases", "vertical", "drift", "rise", "churn"})) {
        patterns.push_back({section.text("name"), read_terms(section)});
        Texture& pattern = patterns.back();
        take_name(section, pattern.name, names);
        read_movement(section, pattern);
    }
    return patterns;
}

void Textures::read(const TomlSection& section) {
    if (section.has("scale") && !section.has("pattern")) section.refuse("scale", "a pattern beside it", "none");
    Texture texture;
    if (section.has("pattern"))
        texture = read_scaled_pattern(section, patterns());
    else
        texture.terms = read_terms(section);
    texture.name = section.text("name");
    take_name(section, texture.name, names_);
    read_movement(section, texture);
    indices_.emplace(texture.name, static_cast<std::uint32_t>(list_.size()));
    list_.push_back(std::move(texture));
}

std::uint32_t Textures::index_of(const TomlSection& section, const std::string& name) {
    const auto found = indices_.find(name);
    if (found != indices_.end()) return found->second;
    const Texture* pattern = named(patterns(), name);
    if (pattern == nullptr)
        section.refuse(
            "texture", "the name of a [[texture]] or of a pattern",
            "\"" + name + "\"" + (patterns().empty() ? ", and no patterns in " + config_directory().string() : ""));
    const auto index = static_cast<std::uint32_t>(list_.size());
    indices_.emplace(name, index);
    list_.push_back(*pattern);
    return index;
}

const std::vector<Texture>& Textures::patterns() {
    if (!patterns_) patterns_ = read_patterns();
    return *patterns_;
}

}  // namespace quadrig::config
