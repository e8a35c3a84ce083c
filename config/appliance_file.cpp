#include "config/appliance_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "config/model_section.h"
#include "config/place_section.h"
#include "config/toml_section.h"

namespace quadrig::config {
namespace {

const KnownKeys kKeys{"scene", "links", "sinks", "size", "fov", "rate", "threads", "quality", "entity"};

bool is_whole_in(double number, double least, double most) {
    return number >= least && number <= most && std::trunc(number) == number;
}
constexpr NumberRule kPixels{"pixels, a whole number in 1..16384",
                             [](double x) { return is_whole_in(x, 1.0, kLargestImage); }};
constexpr NumberRule kFieldOfView{"degrees above 0 and below 180", [](double x) { return x > 0.0 && x < 180.0; }};
constexpr NumberRule kRate{"hertz in 1..1000", [](double x) { return scheduler::frame_rate(x).has_value(); }};
constexpr NumberRule kThreads{"a whole number in 1..1024", [](double x) { return is_whole_in(x, 1.0, kMostThreads); }};

constexpr NumberRule kEntityType{"a whole number in 0..65535", [](double x) { return is_whole_in(x, 0.0, 65535.0); }};

/// `refuse` is told what was expected and what was found.
template <class Refuse>
host::LinkUrl link_from(const std::string& text, const Refuse& refuse) {
    host::LinkUrl url;
    try {
        url = host::parse_link_url(text);
    } catch (const host::LinkUrlError& error) {
        refuse("a link", "one that cannot be understood: " + std::string(error.what()));
    }
    if (!url.live) refuse("a link with ADDRESS:PORT", "\"" + text + "\"");
    return url;
}

ApplianceSettings::EntityModel entity_from(const TomlSection& section) {
    ApplianceSettings::EntityModel entity{model_name(section), {}};
    const int ways =
        int{section.has("type")} + int{section.has("position")} + int{section.has("place")} + int{section.has("link")};
    if (ways != 1)
        section.refuse(std::string("expected one of type, position, place, link, found ") +
                       (ways == 0 ? "none" : "more"));
    if (section.has("attitude") && (section.has("type") || section.has("link")))
        section.refuse("attitude", "position or place beside it", "who tells the attitude itself");
    if (section.has("position")) {
        entity.placed_by = scene_pose_in(section);
    } else if (const auto place = optional_geodetic(section, "place")) {
        entity.placed_by = host::GeodeticPose{*place, section.has("attitude") ? attitude_in(section) : Attitude{}};
    } else if (const auto link = section.optional_text("link")) {
        entity.placed_by = link_from(*link, [&](const std::string& expected, const std::string& found) {
            section.refuse("link", expected, found);
        });
    } else {
        entity.placed_by = static_cast<int>(section.number("type", kEntityType));
    }
    return entity;
}

}  // namespace

ApplianceSettings read_appliance(const std::filesystem::path& file, const TextRule& sink) {
    const toml::table document = parse_toml_file(file);
    const TomlSection section(file, document, "", kKeys);
    ApplianceSettings settings;
    if (const auto scene = section.optional_text("scene")) settings.scene = file.parent_path() / *scene;
    for (const std::string& link : section.texts("links"))
        settings.links.push_back(link_from(link, [&](const std::string& expected, const std::string& found) {
            section.refuse("links", settings.links.size(), expected, found);
        }));
    for (const std::string& url : section.texts("sinks")) {
        if (!sink.holds(url))
            section.refuse("sinks", settings.sinks.size(), std::string(sink.expected), "\"" + url + "\"");
        settings.sinks.push_back(url);
    }
    if (section.has("size")) {
        const glm::dvec2 size = section.pair("size", kPixels);
        settings.size = ImageSize{static_cast<int>(size.x), static_cast<int>(size.y)};
    }
    if (section.has("fov")) settings.fov = Degrees{section.number("fov", kFieldOfView)};
    if (section.has("rate")) settings.rate = scheduler::frame_rate(section.number("rate", kRate));
    if (section.has("threads")) settings.threads = static_cast<int>(section.number("threads", kThreads));
    for (const TomlSection& entity :
         section.tables("entity", {"model", "type", "position", "place", "attitude", "link"})) {
        settings.entities.push_back(entity_from(entity));
        if (settings.entities.size() > kMostEntityModels) entity.refuse("expected at most 64 entities, found more");
    }
    if (const auto name = section.optional_text("quality")) {
        if (*name != kAutomaticQuality && !step_named(shipped_ladder(), *name))
            section.refuse("quality", quality_names(shipped_ladder()), "\"" + *name + "\"");
        settings.quality = *name;
    }
    return settings;
}

bool is_appliance_file(const std::filesystem::path& file) {
    const toml::table document = parse_toml_file(file);
    return std::any_of(kKeys.begin(), kKeys.end(), [&](std::string_view key) {
        const toml::node* node = document.get(key);
        return node != nullptr && !(key == "scene" && node->is_table());
    });
}

ApplianceSettings combined(ApplianceSettings first, ApplianceSettings second) {
    const auto fill = [](auto& target, auto& source) {
        if (!target) target = std::move(source);
    };
    fill(first.scene, second.scene);
    if (first.links.empty()) first.links = std::move(second.links);
    if (first.sinks.empty()) first.sinks = std::move(second.sinks);
    if (first.entities.empty()) first.entities = std::move(second.entities);
    fill(first.size, second.size);
    fill(first.fov, second.fov);
    fill(first.rate, second.rate);
    fill(first.threads, second.threads);
    fill(first.quality, second.quality);
    return first;
}

}  // namespace quadrig::config
