/// Options that run, replay and bench share.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "config/appliance_file.h"
#include "ig_core/scene/scene.h"

namespace quadrig::appliance {

/// What was asked for on the command line.
struct RunOptions {
    config::ApplianceSettings settings;
    std::optional<std::uint64_t> frames;
    std::optional<scheduler::Time> duration;
    std::filesystem::path report, contact_sheet, ladder;  ///< empty: none; the shipped ladder
    bool overlay = false;
    bool ignore_host_window = false;
};

/// --size, --rate, --threads, --quality, --ladder, --report.
void add_picture_options(CLI::App& command, RunOptions& options);
/// --scene, --sink, --contact-sheet, --fov, --ignore-host-window, --overlay, --frames, --seconds.
void add_host_options(CLI::App& command, RunOptions& options);

/// What draws: settings with their defaults in place of what is absent.
struct PictureSettings {
    config::ImageSize size;
    Degrees fov;
    scheduler::FrameRate rate;
    int threads;
    config::QualityLadder ladder;
    std::size_t step;  ///< of the ladder, to begin with
    bool automatic;    ///< whether the frame loop may leave it
    bool overlay;
};
/// Throws WrongUse where the ladder has no such quality.
PictureSettings picture_settings(const RunOptions& options, const config::ApplianceSettings& settings);

/// The scene of the settings, with a model for every entity of theirs.
Scene scene_with_entities(const config::ApplianceSettings& settings);
/// The host's types that they stand for, in the order of the scene's models; -1 for one that no host places.
std::vector<int> entity_types(const config::ApplianceSettings& settings);

/// One thread per core that this process may use.
int default_threads();

}  // namespace quadrig::appliance
