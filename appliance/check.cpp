/// `quadrig check`: what is in a file, or what is wrong with it.
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "appliance/commands.h"
#include "appliance/playback.h"
#include "appliance/run_options.h"
#include "config/appliance_file.h"
#include "config/camera_path.h"
#include "config/scene_file.h"
#include "config/scene_summary.h"
#include "display/frame_writer.h"

namespace quadrig::appliance {
namespace {

using Path = std::filesystem::path;

/// A candump log, or the four bytes that pcap (both byte orders, micro- and nanoseconds) and pcapng files begin with.
bool is_recording(const Path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".pcap" || extension == ".pcapng") return true;
    if (host::is_candump_log(file)) return true;
    std::array<char, 4> begin{};
    std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
    for (const std::string_view magic :
         {"\xa1\xb2\xc3\xd4", "\xd4\xc3\xb2\xa1", "\xa1\xb2\x3c\x4d", "\x4d\x3c\xb2\xa1", "\x0a\x0d\x0d\x0a"})
        if (std::string_view(begin.data(), begin.size()) == magic) return true;
    return false;
}

void check_cameras(const Path& file) {
    const auto cameras = config::read_camera_path(file);
    std::cout << "camera path: " << cameras.size() << (cameras.size() == 1 ? " camera\n" : " cameras\n");
}

void check_appliance(const Path& file) {
    const auto settings = config::read_appliance(file, {display::kSinkUrls, display::is_sink_url});
    std::cout << "appliance:   settings for 'quadrig run'\n";
    if (settings.scene) std::cout << "scene:       " << settings.scene->string() << '\n';
    for (const host::LinkUrl& link : settings.links) std::cout << "link:        " << link.text << '\n';
    for (const std::string& sink : settings.sinks) std::cout << "sink:        " << sink << '\n';
    for (const auto& entity : settings.entities) {
        std::cout << "entity:      " << entity.model;
        if (const int* type = std::get_if<int>(&entity.placed_by)) std::cout << ", the host's of type " << *type;
        if (const auto* link = std::get_if<host::LinkUrl>(&entity.placed_by)) std::cout << ", driven by " << link->text;
        std::cout << '\n';
    }
    if (settings.size) std::cout << "size:        " << settings.size->width << 'x' << settings.size->height << '\n';
    if (settings.fov) std::cout << "fov:         " << settings.fov->value << " degrees\n";
    if (settings.rate) std::cout << "rate:        " << settings.rate->hertz() << " Hz\n";
    if (settings.threads) std::cout << "threads:     " << *settings.threads << '\n';
    if (settings.quality) std::cout << "quality:     " << *settings.quality << '\n';
    if (settings.scene) scene_with_entities(settings);
}

void print_pose(const char* title, const std::optional<host::PoseSample>& pose) {
    if (!pose) return;
    std::cout << title << std::fixed << std::setprecision(6) << "latitude " << pose->position.latitude.value
              << ", longitude " << pose->position.longitude.value << std::setprecision(2) << ", altitude "
              << pose->position.altitude << " m, heading " << pose->attitude.heading.value << ", pitch "
              << pose->attitude.pitch.value << ", roll " << pose->attitude.roll.value << '\n';
}

void print_counts(const char* title, const host::NamedCounts& counts) {
    std::cout << title;
    const char* separator = "";
    for (const auto& [name, count] : counts) {
        std::cout << separator << name << ' ' << count;
        separator = ", ";
    }
    std::cout << (counts.empty() ? "none\n" : "\n");
}

void check_recording(const Path& file) {
    const host::Capture capture = host::read_capture(file);
    host::SessionOptions options;
    options.protocol = capture.protocol;
    Playback playback(capture, options);
    playback.state_at(playback.end());
    const host::LinkStatistics& counts = playback.statistics();
    std::cout << "recording:   " << title_of(capture.protocol) << ", " << text(capture.flow) << '\n'
              << "flight:      " << counts.frames << " poses in " << std::fixed << std::setprecision(3)
              << std::chrono::duration<double>(playback.end() - playback.begin()).count() << " s; " << counts.gaps.count
              << " gaps, the longest interval " << std::chrono::duration<double>(counts.gaps.longest).count() << " s\n";
    print_pose("first pose:  ", counts.first_pose);
    print_pose("last pose:   ", counts.last_pose);
    std::cout << "datagrams:   " << counts.datagrams << ", " << counts.bytes << " bytes; lost " << counts.lost
              << ", duplicate " << counts.duplicate << ", reordered " << counts.reordered << '\n';
    print_counts("packets:     ", packets_by_name(counts));
    print_counts("rejected:    ", rejected_by_reason(counts));
    std::cout << "in the file: " << capture.counts.packets << " packets; " << capture.counts.other_flow
              << " of other flows, " << capture.counts.not_udp << " other than UDP and Modbus, "
              << capture.counts.fragments << " fragments, " << capture.counts.damaged << " damaged\n";
    if (capture.truncated) throw std::runtime_error(file.string() + ": ends early: " + *capture.truncated);
}

void check(const Path& file) {
    // What a file is is told by its beginning, and then read from there again.
    if (std::error_code none; std::filesystem::is_other(file, none))
        throw std::runtime_error(file.string() + ": expected a regular file, found a pipe or a device");
    if (is_recording(file)) return check_recording(file);
    if (file.extension() == ".json") return check_cameras(file);
    if (config::is_appliance_file(file)) return check_appliance(file);
    std::cout << config::summary(config::read_scene(file));
}

}  // namespace

void add_check(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("check", "Say what is in a file, or what is wrong with it");
    const auto file = std::make_shared<Path>();
    command.add_option("file", *file, "A scene, an appliance file, a camera path (.json) or a recording")
        ->required()
        ->option_text("FILE");
    command.footer(
        "What is in order is described on standard output (exit status 0); what is wrong is said on standard error\n"
        "with file, line and key (exit status 1).\n\n"
        "Examples:\n"
        "  quadrig check config/scenes/one_tree.toml\n"
        "  quadrig check config/traces/netfdm-c172-takeoff.pcap");
    command.callback([file, &action] { action = [file] { check(*file); }; });
}

}  // namespace quadrig::appliance
