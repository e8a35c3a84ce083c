/// Options that run, replay and bench share.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "config/appliance_file.h"

namespace quadrig::appliance {

/// What was asked for on the command line.
struct RunOptions {
    config::ApplianceSettings settings;
    std::optional<std::uint64_t> frames;
    std::optional<scheduler::Time> duration;
    std::filesystem::path report, contact_sheet;  ///< empty: none
    bool overlay = false;
    bool ignore_host_window = false;
};

/// --size, --rate, --threads, --quality, --report.
void add_picture_options(CLI::App& command, RunOptions& options);
/// --scene, --sink, --contact-sheet, --fov, --ignore-host-window, --overlay, --frames, --seconds.
void add_host_options(CLI::App& command, RunOptions& options);

/// What draws: settings with their defaults in place of what is absent.
struct PictureSettings {
    config::ImageSize size;
    Degrees fov;
    scheduler::FrameRate rate;
    int threads;
    config::QualityPreset quality;
    bool overlay;
};
PictureSettings picture_settings(const config::ApplianceSettings& settings, bool overlay);

/// One thread per core that this process may use.
int default_threads();

}  // namespace quadrig::appliance
