/// Appliance files: what `quadrig run` is told by a file instead of by options. The format is in config/README.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "config/file_error.h"
#include "config/quality_ladder.h"
#include "frame_scheduler/frame_clock.h"
#include "host_link/host_state.h"
#include "host_link/link_url.h"
#include "ig_core/geometry/space.h"

namespace quadrig::config {

/// Pixels, 1..kLargestImage each way.
struct ImageSize {
    int width = 1280;
    int height = 720;
};
inline constexpr int kLargestImage = 16384;
inline constexpr int kMostThreads = 1024;
inline constexpr std::size_t kMostEntityModels = 64;

/// Every setting is absent, or its list empty, where it was not given.
struct ApplianceSettings {
    std::optional<std::filesystem::path> scene;
    std::vector<host::LinkUrl> links;
    std::vector<std::string> sinks;
    std::optional<ImageSize> size;
    std::optional<Degrees> fov;  ///< horizontal field of view, above 0 and below 180
    std::optional<scheduler::FrameRate> rate;
    std::optional<int> threads;  ///< 1..kMostThreads
    /// A model of config_directory()/models, and what places it: the driving host, as its entities of a type
    /// (0..65535); a place in the scene or on the earth; or a link of its own.
    struct EntityModel {
        std::string model;
        std::variant<int, ScenePose, host::GeodeticPose, host::LinkUrl> placed_by;
    };
    std::vector<EntityModel> entities;
    std::optional<std::string> quality;  ///< a step of the shipped ladder, or kAutomaticQuality
};

/// What a text has to be, in words and as a test.
struct TextRule {
    std::string_view expected;
    bool (*holds)(const std::string&);
};

/// Reads an appliance file. A relative scene is taken from the file's own directory. `sink` says what a sink URL is.
/// Throws FileError at the first mistake.
ApplianceSettings read_appliance(const std::filesystem::path& file, const TextRule& sink);

/// Whether a TOML file holds a setting of an appliance, as no scene does. Throws FileError where it is not TOML.
bool is_appliance_file(const std::filesystem::path& file);

/// `first`, and from `second` what `first` leaves open.
ApplianceSettings combined(ApplianceSettings first, ApplianceSettings second);

}  // namespace quadrig::config
