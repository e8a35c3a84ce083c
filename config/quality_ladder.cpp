#include "config/quality_ladder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <utility>

#include "config/shipped_ladder.h"
#include "config/toml_section.h"
#include "config/toml_text.h"

namespace quadrig::config {
namespace {

constexpr std::array<std::pair<SetUp, std::string_view>, 3> kSetUps{
    {{SetUp::anchored, "anchored"}, {SetUp::textbook, "textbook"}, {SetUp::textbook_single, "textbook-single"}}};
constexpr std::array<std::pair<DistanceRule, std::string_view>, 2> kDistanceRules{
    {{DistanceRule::exact, "exact"}, {DistanceRule::interpolated, "interpolated"}}};
constexpr std::array<std::pair<SineMethod, std::string_view>, 4> kSines{{{SineMethod::parabola, "parabola"},
                                                                         {SineMethod::polynomial, "polynomial"},
                                                                         {SineMethod::table, "table"},
                                                                         {SineMethod::library, "library"}}};

constexpr std::array<std::pair<ShadingRate, std::string_view>, 5> kShadingRates{{{ShadingRate::one, "one"},
                                                                                 {ShadingRate::half, "half"},
                                                                                 {ShadingRate::quarter, "quarter"},
                                                                                 {ShadingRate::eighth, "eighth"},
                                                                                 {ShadingRate::four, "four"}}};

template <class Named, class Value>
std::string_view name_of(const Named& names, Value value) {
    return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == value; })->second;
}

template <class Named, class Value>
Value named_or(const TomlSection& section, std::string_view key, const Named& names, Value usual) {
    const auto text = section.optional_text(key);
    if (!text) return usual;
    std::string expected;
    for (const auto& [value, name] : names) {
        if (name == *text) return value;
        expected += (expected.empty() ? "" : " or ") + std::string(name);
    }
    section.refuse(key, expected, "\"" + *text + "\"");
}

template <int kLeast, int kMost>
constexpr bool is_whole(double x) {
    return x >= kLeast && x <= kMost && std::trunc(x) == x;
}
constexpr NumberRule kSubScanLines{"0, 1, 2, 4 or 8",
                                   [](double x) { return x == 0 || x == 1 || x == 2 || x == 4 || x == 8; }};
constexpr NumberRule kTermsLeftOut{"a whole number in 0..7", is_whole<0, 7>};
constexpr NumberRule kSmallestFeature{"pixels in 0..64", [](double x) { return x >= 0.0 && x <= 64.0; }};

const KnownKeys kStepKeys{"name",
                          "cost",
                          "psnr",
                          "sub_scan_lines",
                          "set_up",
                          "distance",
                          "sine",
                          "terms_left_out",
                          "smooth_stretches",
                          "shading",
                          "smallest_feature"};

QualityStep read_step(const TomlSection& section) {
    const Quality usual;
    QualityStep step;
    step.name = section.text("name");
    if (step.name == kAutomaticQuality) section.refuse("name", "another name: this one means all steps", "\"auto\"");
    step.cost = section.number("cost", kPositive);
    step.psnr = section.number("psnr", kPositive);
    Quality& q = step.quality;
    q.sub_scan_lines = static_cast<int>(section.number_or("sub_scan_lines", kSubScanLines, usual.sub_scan_lines));
    q.set_up = named_or(section, "set_up", kSetUps, usual.set_up);
    q.distance = named_or(section, "distance", kDistanceRules, usual.distance);
    q.sine = named_or(section, "sine", kSines, usual.sine);
    q.terms_left_out = static_cast<int>(section.number_or("terms_left_out", kTermsLeftOut, usual.terms_left_out));
    q.smooth_stretches = section.flag_or("smooth_stretches", usual.smooth_stretches);
    q.shading = named_or(section, "shading", kShadingRates, usual.shading);
    q.smallest_feature = section.number_or("smallest_feature", kSmallestFeature, usual.smallest_feature);
    return step;
}

QualityLadder ladder_from(const std::filesystem::path& file, const toml::table& document) {
    const TomlSection all(file, document, "", {"quality"});
    QualityLadder ladder;
    for (const TomlSection& section : all.tables("quality", kStepKeys)) {
        QualityStep step = read_step(section);
        if (step_named(ladder, step.name)) section.refuse("name", "a name of its own", "\"" + step.name + "\" again");
        if (!ladder.empty() && step.cost < ladder.back().cost)
            section.refuse("cost", "no less than the step before costs", "less");
        ladder.push_back(std::move(step));
    }
    if (!step_named(ladder, "default")) all.refuse("a quality ladder needs a [[quality]] named \"default\"");
    return ladder;
}

}  // namespace

const QualityLadder& shipped_ladder() {
    static const QualityLadder ladder = [] {
        const std::filesystem::path file = "config/quality.toml";
        return ladder_from(file, parse_toml_text(file, shipped_ladder_text()));
    }();
    return ladder;
}

QualityLadder read_quality_ladder(const std::filesystem::path& file) {
    return ladder_from(file, parse_toml_file(file));
}

void write_quality_ladder(const QualityLadder& ladder, std::ostream& out) {
    const Quality usual;
    for (const QualityStep& step : ladder) {
        const Quality& q = step.quality;
        out << "\n[[quality]]\nname = " << Quoted{step.name} << "\ncost = " << Exact{step.cost}
            << "\npsnr = " << Exact{step.psnr} << "\nsub_scan_lines = " << q.sub_scan_lines << '\n';
        if (q.set_up != usual.set_up) out << "set_up = \"" << name_of(kSetUps, q.set_up) << "\"\n";
        if (q.distance != usual.distance) out << "distance = \"" << name_of(kDistanceRules, q.distance) << "\"\n";
        if (q.sine != usual.sine) out << "sine = \"" << name_of(kSines, q.sine) << "\"\n";
        if (q.terms_left_out != usual.terms_left_out) out << "terms_left_out = " << q.terms_left_out << '\n';
        if (q.smooth_stretches != usual.smooth_stretches)
            out << "smooth_stretches = " << (q.smooth_stretches ? "true" : "false") << '\n';
        if (q.shading != usual.shading) out << "shading = \"" << name_of(kShadingRates, q.shading) << "\"\n";
        if (q.smallest_feature != usual.smallest_feature)
            out << "smallest_feature = " << Exact{q.smallest_feature} << '\n';
    }
}

std::optional<std::size_t> step_named(const QualityLadder& ladder, std::string_view name) {
    const auto found = std::find_if(ladder.begin(), ladder.end(), [&](const auto& step) { return step.name == name; });
    if (found == ladder.end()) return std::nullopt;
    return static_cast<std::size_t>(found - ladder.begin());
}

std::size_t default_step(const QualityLadder& ladder) { return *step_named(ladder, "default"); }

std::string step_names(const QualityLadder& ladder) {
    std::string names;
    for (const QualityStep& step : ladder) names += (names.empty() ? "" : ", ") + step.name;
    return names;
}

std::string quality_names(const QualityLadder& ladder) {
    return step_names(ladder) + " or " + std::string(kAutomaticQuality);
}

std::string words_for(const Quality& q) {
    const Quality usual;
    std::string words = q.sub_scan_lines == 0   ? "no antialiasing"
                        : q.sub_scan_lines == 1 ? "1 sub-scan line"
                                                : std::to_string(q.sub_scan_lines) + " sub-scan lines";
    const auto add = [&](bool differs, const std::string& text) {
        if (differs) words += ", " + text;
    };
    add(q.set_up != usual.set_up, std::string(name_of(kSetUps, q.set_up)) + " set-up");
    add(q.distance != usual.distance, std::string(name_of(kDistanceRules, q.distance)) + " distance");
    add(q.sine != usual.sine, std::string(name_of(kSines, q.sine)) + " sine");
    add(q.terms_left_out == 1, "one sine fewer");
    add(q.terms_left_out > 1, std::to_string(q.terms_left_out) + " sines fewer");
    add(!q.smooth_stretches, "nothing interpolated");
    add(pixels_across(q.shading) > 1.0, "drawn half as fine");
    add(pixels_across(q.shading) < 1.0, "drawn twice as fine");
    add(shades_pairs(q.shading), "every second pixel shaded");
    if (q.smallest_feature > 0.0) {
        std::string pixels = std::to_string(q.smallest_feature);
        pixels.erase(pixels.find_last_not_of('0') + 1);
        if (pixels.back() == '.') pixels.pop_back();
        add(true, "nothing below " + pixels + " pixels");
    }
    return words;
}

}  // namespace quadrig::config
