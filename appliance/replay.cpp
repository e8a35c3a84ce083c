/// `quadrig replay`: a recorded flight becomes pictures, the same ones every time.
#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <memory>

#include "appliance/commands.h"
#include "appliance/entities_again.h"
#include "appliance/frame_run.h"
#include "appliance/host_eye.h"
#include "appliance/option_values.h"
#include "appliance/outlets.h"
#include "appliance/output_files.h"
#include "appliance/painter.h"
#include "appliance/playback.h"
#include "appliance/run_options.h"
#include "appliance/run_report.h"
#include "appliance/stop_signals.h"
#include "config/scene_file.h"
#include "display/frame_writer.h"
#include "host_link/recorded_frames.h"

namespace quadrig::appliance {
namespace {

struct ReplayOptions : RunOptions {
    std::filesystem::path recording, appliance;
    std::optional<host::LinkUrl> link;
    bool fast = false;
    bool fifo = false;
};

/// Of `all`, those asked for.
std::uint64_t frames_wanted(const ReplayOptions& options, const scheduler::FrameRate& rate, std::uint64_t all) {
    const std::uint64_t wanted =
        options.duration ? scheduler::first_frame_from(rate, *options.duration) : options.frames.value_or(all);
    return std::min(all, wanted);
}

/// Until the recording ends. Capture times are only numbers in a file: without a limit, those that would run for days
/// are refused.
std::uint64_t frames_in(const ReplayOptions& options, const scheduler::FrameRate& rate, const Playback& playback) {
    using namespace std::chrono_literals;
    const scheduler::Time length = playback.end() - playback.begin();
    if (length > 24h && !options.frames && !options.duration)
        throw std::runtime_error("by its own clock this recording lasts " +
                                 std::to_string(std::chrono::duration_cast<std::chrono::hours>(length).count()) +
                                 " hours; say how much of it with --frames or --seconds");
    return scheduler::first_frame_from(rate, length + 1ns);
}

/// What a frame of the loop shows.
struct Shown {
    const host::HostState* state = nullptr;
    scheduler::Time time{};             ///< by the recording's clock
    std::uint64_t number = 0;           ///< as the picture is called
    std::optional<std::uint32_t> step;  ///< of the quality ladder; absent: as the settings say
};
using ShownAt = std::function<Shown(std::uint64_t)>;

scheduler::FrameHooks hooks_for(const ShownAt& at, HostEye& eye, EntitiesAgain& entities, Painter& painter,
                                Outlets& outlets, Shown& shown) {
    const scheduler::FrameRate rate = painter.settings().rate;
    const auto draw = [&at, &eye, &entities, &painter, &shown, rate, standby = standby_view(painter.image_plane()),
                       next = std::uint64_t{0}](const scheduler::FrameTick& tick) mutable {
        // Frames left out for being late are latched all the same, so that the next one looks as it always does.
        std::optional<View> view;
        std::span<const PlacedModel> others;
        for (; next <= tick.number; ++next) {
            shown = at(next);
            view = eye.view(*shown.state, shown.time);
            others = entities.at(shown.number);
        }
        const scheduler::Time elapsed = scheduler::frame_time(rate, shown.number);
        scheduler::DrawnFrame drawn;
        if (!view) {
            Environment environment;
            environment.seconds = std::chrono::duration<double>(elapsed).count();
            environment.bodies = others;
            drawn.stages = painter.paint(standby, environment, shown.number, {false, std::nullopt, shown.step});
            return drawn;
        }
        drawn.stages = painter.paint(*view, eye.environment(*shown.state, elapsed, others), shown.number,
                                     {shown.state->test_pattern, shown.state->overlay, shown.step});
        if (const auto arrival = eye.fresh_arrival(*shown.state))
            drawn.input_age = shown.time + (tick.started - tick.due) - *arrival;
        return drawn;
    };
    return {[&outlets] { return stop_requested() || outlets.has_error(); }, draw,
            [&](const scheduler::FrameTick&) { outlets.hand_over(painter.image(), shown.number); }};
}

/// The frames of the live run that made the recording, where it left them behind and they fit what is asked for.
std::optional<host::RecordedFrames> recorded_frames(const ReplayOptions& options, const scheduler::FrameRate& rate) {
    auto frames = host::read_recorded_frames(options.recording);
    if (!frames || frames->frames.empty()) return std::nullopt;
    if (frames->numbering == host::FrameNumbering{rate.numerator, rate.denominator}) return frames;
    std::cerr << "quadrig: " << options.recording.string()
              << ": its live run had another rate; played by the times of its datagrams\n";
    return std::nullopt;
}

/// Whether the steps that the live run chose by itself are to be gone through again.
bool repeats_steps(const PictureSettings& settings, const std::optional<host::RecordedFrames>& run) {
    if (!settings.automatic || !run) return false;
    for (const host::RecordedFrame& frame : run->frames)
        if (frame.step >= settings.ladder.size())
            throw std::runtime_error("the live run had another quality ladder: its frame " +
                                     std::to_string(frame.number) + " was drawn with step " +
                                     std::to_string(frame.step) + " of it, and this one has " +
                                     std::to_string(settings.ladder.size()));
    return true;
}

/// Settings of an appliance file come behind options; its links are those of the live run, and so are its sinks.
config::ApplianceSettings settings_of(const ReplayOptions& options) {
    if (options.appliance.empty()) return options.settings;
    auto file = config::read_appliance(options.appliance, {display::kSinkUrls, display::is_sink_url});
    file.links.clear();
    file.sinks.clear();
    return combined(options.settings, std::move(file));
}

void replay(const ReplayOptions& options) {
    const config::ApplianceSettings given = settings_of(options);
    if (!given.scene) throw WrongUse("--scene is missing: what is there to see?");
    expect_outputs({options.report, options.contact_sheet}, given.sinks,
                   {options.recording, *given.scene, options.appliance, options.ladder});
    if (options.link && options.link->live)
        throw WrongUse("link '" + options.link->text +
                       "': a recording's is named without an address: cigi:, fdm:, can: or modbus:");
    watch_stop_signals();
    PictureSettings settings = picture_settings(options, given);
    const auto run = recorded_frames(options, settings.rate);
    const bool steps = repeats_steps(settings, run);
    // As fast as frames can be drawn there is no time to be short of, and the same frames are to come every time.
    if (options.fast || steps) settings.automatic = false;
    const host::Capture capture = read_capture(
        options.recording, options.link ? std::optional(options.link->protocol) : std::nullopt, run.has_value());
    if (capture.truncated)
        std::cerr << "quadrig: " << options.recording.string() << ": ends early (" << *capture.truncated
                  << "); played up to there\n";
    Painter painter(scene_with_entities(given), settings);
    const Scene& scene = painter.scene();
    const host::LinkUrl link =
        options.link.value_or(host::parse_link_url(std::string(name_of(capture.protocol)) + ":"));
    const host::SessionOptions session = session_options(link, scene, painter.image_plane(), entity_types(given));
    std::optional<RunAgain> again;
    std::optional<Playback> playback;
    ShownAt shown_at;
    if (run) {
        again.emplace(capture, session, *run);
        shown_at = [&again, steps](std::uint64_t index) {
            const host::RecordedFrame& frame = again->frame(index);
            return Shown{&again->state_at(index), frame.due, frame.number,
                         steps ? std::optional(frame.step) : std::nullopt};
        };
    } else {
        // Frame k shows the flight at begin + k / rate of the recording's clock, whenever it is drawn.
        playback.emplace(capture, session);
        shown_at = [&playback, rate = settings.rate](std::uint64_t index) {
            const scheduler::Time time = playback->begin() + scheduler::frame_time(rate, index);
            return Shown{&playback->state_at(time), time, index, std::nullopt};
        };
    }
    HostEye eye(scene, painter.image_plane(), capture.protocol, options.ignore_host_window, entity_types(given));
    EntitiesAgain entities(given.entities, scene.origin, run ? std::optional(options.recording) : std::nullopt);

    const std::uint64_t all = again ? again->size() : frames_in(options, settings.rate, *playback);
    const std::uint64_t frames = frames_wanted(options, settings.rate, all);
    Outlets outlets({given.sinks, painter.video_format(),
                     options.fast ? display::WhenFull::wait : display::WhenFull::drop, stop_requested, frames,
                     options.contact_sheet});
    painter.warm_up(standby_view(painter.image_plane()));
    Shown shown;
    const scheduler::FrameHooks hooks = hooks_for(shown_at, eye, entities, painter, outlets, shown);
    scheduler::FrameReport report = report_about(painter);
    scheduler::FrameRecord record;
    // Frames are counted by their numbers, so that one left out for being late is not drawn after the end.
    const RunLength length{std::nullopt, scheduler::frame_time(settings.rate, frames)};
    if (options.fast)
        run_as_fast_as_possible(settings.rate, length, hooks, record);
    else
        run_in_real_time(settings.rate, length, options.fifo, hooks, record, report);

    if (frames == all && !stop_requested()) {
        if (again) again->play_rest();
        if (playback) playback->state_at(playback->end());
    }
    nlohmann::ordered_json told = link_report(link.text, again ? again->statistics() : playback->statistics());
    told["recording"] = options.recording.string();
    told["flow"] = text(capture.flow);
    if (capture.truncated) told["truncated"] = *capture.truncated;
    report.links.push_back(std::move(told));
    for (auto& entity : entities.reports()) report.links.push_back(std::move(entity));
    finish_report(report, record, painter, outlets, options.report);
}

constexpr const char* kReplayNotes =
    "The recording is a pcap or pcapng file of CIGI or FlightGear FDM over UDP, of Modbus/TCP or of CANaerospace, or\n"
    "a log of candump. Of its flows that with the most datagrams of a host is played. Frame k shows the flight k/HZ\n"
    "seconds after its first pose, smoothed between the host's samples: in real time and with --fast, with any number\n"
    "of threads, frame k is the same picture. In real time a frame that is late is left out, and the one before it\n"
    "held; the report counts them. What 'quadrig run --record' wrote is shown frame by frame as it was in that run,\n"
    "at the same rate.\n\n"
    "Examples:\n"
    "  quadrig replay config/traces/netfdm-c172-takeoff.pcap --scene config/scenes/takeoff.toml --fast \\\n"
    "      --sink y4m:takeoff.y4m --contact-sheet takeoff.png --report takeoff.json\n"
    "  quadrig replay config/traces/cigi33-737-turn.pcapng --scene config/scenes/turn.toml --rate 30 --overlay \\\n"
    "      --sink y4m:- | mpv -";

}  // namespace

void add_replay(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("replay", "Play a recorded flight through the image generator");
    const auto options = std::make_shared<ReplayOptions>();
    command.add_option("recording", options->recording, "The recording")->required()->option_text("RECORDING");
    add_option(command, "appliance", options->appliance, read_path,
               "The settings file of the live run, for its entities; options win over it", "[APPLIANCE.toml]");
    add_option(command, "--link", options->link, read_link,
               "The recording's protocol, cigi:, fdm:, can: or modbus:,\nwith options such as\ncigi:?ownship=3 "
               "(default: what it holds)",
               "URL");
    add_host_options(command, *options);
    add_picture_options(command, *options);
    auto* fast = command.add_flag("--fast", options->fast,
                                  "As fast as frames can be drawn, and sinks take them: none is left out");
    command.add_flag("--fifo", options->fifo, "Ask for real-time priority (SCHED_FIFO; needs the privilege)")
        ->excludes(fast);
    command.footer(kReplayNotes);
    command.callback([options, &action] { action = [options] { replay(*options); }; });
}

}  // namespace quadrig::appliance
