#include "appliance/option_values.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>

#include "display/frame_writer.h"
#include "host_link/read_number.h"

namespace quadrig::appliance {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& expected) {
    throw BadValue("'" + text + "': expected " + expected);
}

double number_in(const std::string& text, const std::string& expected, bool (*holds)(double)) {
    const auto number = host::read_number<double>(text);
    if (!number || !std::isfinite(*number) || !holds(*number)) refuse(text, expected);
    return *number;
}

}  // namespace

std::string last_of(const std::string& names) { return names.substr(names.rfind(',') + 1); }

glm::dvec3 read_triple(const std::string& text) {
    const auto fail = [&] {
        refuse(text, "three numbers in -1e9..1e9 with commas between them and no blanks, such as 3,0,-8");
    };
    const std::size_t first = text.find(','), last = text.rfind(',');
    if (first == last) fail();
    const std::string_view all(text);
    glm::dvec3 values;
    glm::length_t axis = 0;
    for (const std::string_view part :
         {all.substr(0, first), all.substr(first + 1, last - first - 1), all.substr(last + 1)}) {
        const auto value = host::read_number<double>(part);
        if (!value || !(std::abs(*value) <= 1e9)) fail();
        values[axis++] = *value;
    }
    return values;
}

config::ImageSize read_size(const std::string& text) {
    const std::string_view all(text);
    const std::size_t cross = std::min(all.find('x'), all.size() - 1);
    const auto width = host::read_number<int>(all.substr(0, cross)),
               height = host::read_number<int>(all.substr(cross + 1));
    const auto fits = [](const std::optional<int>& n) { return n && *n >= 1 && *n <= config::kLargestImage; };
    if (!fits(width) || !fits(height))
        refuse(text, "WIDTHxHEIGHT, such as 1280x720, each in 1.." + std::to_string(config::kLargestImage));
    return {*width, *height};
}

Degrees read_field_of_view(const std::string& text) {
    return {number_in(text, "degrees above 0 and below 180", [](double x) { return x > 0.0 && x < 180.0; })};
}

scheduler::FrameRate read_rate(const std::string& text) {
    return *scheduler::frame_rate(
        number_in(text, "hertz in 1..1000", [](double x) { return scheduler::frame_rate(x).has_value(); }));
}

scheduler::Time read_duration(const std::string& text) {
    const double seconds =
        number_in(text, "seconds above 0 and at most 1e8", [](double x) { return x > 0.0 && x <= 1e8; });
    return std::chrono::round<scheduler::Time>(std::chrono::duration<double>(seconds));
}

std::uint64_t read_count(const std::string& text) {
    const auto count = host::read_number<std::uint64_t>(text);
    if (!count || *count == 0) refuse(text, "a whole number of at least 1");
    return *count;
}

double read_speed(const std::string& text) {
    return number_in(text, "a factor in 1e-3..1e6", [](double x) { return x >= 1e-3 && x <= 1e6; });
}

double read_scene_time(const std::string& text) {
    return number_in(text, "seconds in -1e9..1e9", [](double x) { return std::abs(x) <= 1e9; });
}

config::QualityStep read_quality(const std::string& text) {
    const config::QualityLadder& ladder = config::shipped_ladder();
    const auto step = config::step_named(ladder, text);
    if (!step) refuse(text, config::step_names(ladder));
    return ladder[*step];
}

host::LinkUrl read_link(const std::string& text) {
    try {
        return host::parse_link_url(text);
    } catch (const host::LinkUrlError& error) {
        throw BadValue(error.what());
    }
}

host::LinkUrl read_live_link(const std::string& text) {
    host::LinkUrl url = read_link(text);
    if (!url.live) throw BadValue("link '" + text + "': needs ADDRESS:PORT, or on CAN an interface");
    return url;
}

config::ApplianceSettings::EntityModel read_entity(const std::string& text) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const auto type = host::read_number<int>(std::string_view(text).substr(0, equals));
    if (!type || *type < 0 || *type > 65535 || equals + 1 >= text.size())
        refuse(text, "TYPE=MODEL, such as 12=x-29, the type in 0..65535");
    return {text.substr(equals + 1), *type};
}

std::string read_sink(const std::string& text) {
    if (!display::is_sink_url(text)) refuse(text, "a sink: " + std::string(display::kSinkUrls));
    return text;
}

std::filesystem::path read_path(const std::string& text) {
    if (text.empty() || text.front() == '-') refuse(text, "a file's name (./-NAME where it begins with a dash)");
    return text;
}

}  // namespace quadrig::appliance
