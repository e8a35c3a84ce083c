/// Values of options as they are written on the command line. What cannot be read is a BadValue, which says what can;
/// the option's name is put before it where the option is added.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>

#include "config/appliance_file.h"
#include "frame_scheduler/frame_clock.h"
#include "host_link/link_url.h"
#include "ig_core/geometry/space.h"

namespace quadrig::appliance {

struct BadValue : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// "3,0,-8": three numbers, each within 1e9.
glm::dvec3 read_triple(const std::string& text);
/// "1280x720"
config::ImageSize read_size(const std::string& text);
/// Degrees above 0 and below 180.
Degrees read_field_of_view(const std::string& text);
/// Hertz, 1..1000.
scheduler::FrameRate read_rate(const std::string& text);
/// Seconds above 0, at most 1e8.
scheduler::Time read_duration(const std::string& text);
/// A whole number of at least 1.
std::uint64_t read_count(const std::string& text);
/// A factor in 1e-3..1e6.
double read_speed(const std::string& text);
/// Seconds in -1e9..1e9.
double read_scene_time(const std::string& text);
/// A step of the shipped quality ladder.
config::QualityStep read_quality(const std::string& text);
host::LinkUrl read_link(const std::string& text);
/// One that says where a host is: with ADDRESS:PORT, or on CAN an interface.
host::LinkUrl read_live_link(const std::string& text);
/// "12=x-29": a host's entity type and the model it is drawn as.
config::ApplianceSettings::EntityModel read_entity(const std::string& text);
std::string read_sink(const std::string& text);
/// A file or directory. No name at all, as a script's unset variable gives, is not "no file"; and a name that begins
/// with a dash is the next option, taken for this one's value.
std::filesystem::path read_path(const std::string& text);

/// "--output" of "-o,--output".
std::string last_of(const std::string& names);

/// What `read` makes of the text that stands behind option `name`.
template <class Value>
Value value_of(const std::string& name, const std::string& text, Value (*read)(const std::string&)) {
    try {
        return read(text);
    } catch (const BadValue& bad) {
        throw CLI::ValidationError(name, bad.what());
    }
}

/// Adds an option whose text `read` turns into `target`. A list takes one value each time the option is given.
template <class Value, class Target>
CLI::Option* add_option(CLI::App& command, const std::string& names, Target& target, Value (*read)(const std::string&),
                        const std::string& description, const std::string& value_name) {
    return command
        .add_option_function<std::string>(
            names,
            [&target, read, name = last_of(names)](const std::string& text) { target = value_of(name, text, read); },
            description)
        ->option_text(value_name);
}
template <class Value>
CLI::Option* add_list_option(CLI::App& command, const std::string& names, std::vector<Value>& target,
                             Value (*read)(const std::string&), const std::string& description,
                             const std::string& value_name) {
    return command
        .add_option_function<std::vector<std::string>>(
            names,
            [&target, read, name = last_of(names)](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) target.push_back(value_of(name, text, read));
            },
            description)
        ->allow_extra_args(false)
        ->option_text(value_name);
}

/// --threads; `threads` keeps its value where the option is not given.
template <class Target>
CLI::Option* add_threads_option(CLI::App& command, Target& threads) {
    return command.add_option("--threads", threads, "Threads that draw, 1..1024 (default: one per core)")
        ->check(CLI::Range(1, config::kMostThreads))
        ->option_text("N");
}

}  // namespace quadrig::appliance
