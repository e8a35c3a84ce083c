/// `quadrig run`: live, driven by hosts over the network.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <vector>

#include "appliance/commands.h"
#include "appliance/frame_run.h"
#include "appliance/host_eye.h"
#include "appliance/option_values.h"
#include "appliance/outlets.h"
#include "appliance/output_files.h"
#include "appliance/own_entities.h"
#include "appliance/painter.h"
#include "appliance/run_options.h"
#include "appliance/run_report.h"
#include "appliance/scene_survey.h"
#include "appliance/stop_signals.h"
#include "config/scene_file.h"
#include "display/frame_writer.h"
#include "host_link/live_link.h"
#include "host_link/recorder.h"

namespace quadrig::appliance {
namespace {

struct LiveOptions : RunOptions {
    std::filesystem::path appliance;
    std::filesystem::path record;
    bool fifo = false;
};

/// A link, and what is known of the host at its other end.
struct LiveHost {
    explicit LiveHost(const host::LinkUrl& url) : link(open_link(url)) {}
    std::unique_ptr<host::LiveLink> link;
    host::HostState state;
    std::optional<HostEye> eye;
    std::optional<View> view;
};
using LiveHosts = std::vector<std::unique_ptr<LiveHost>>;

/// Of several hosts the first in the order given that has a pose and was heard of lately; the others stand by.
LiveHost* driving_host(const LiveHosts& hosts, scheduler::Time now) {
    LiveHost* latest = nullptr;
    for (const auto& host : hosts) {
        if (!host->view || !host->state.newest_arrival) continue;
        if (!host->state.gone(now)) return host.get();
        if (!latest || *host->state.newest_arrival > *latest->state.newest_arrival) latest = host.get();
    }
    return latest;
}

scheduler::FrameHooks hooks_for(LiveHosts& hosts, OwnEntities& entities, Painter& painter, Outlets& outlets,
                                const scheduler::FrameRecord& record, host::Recorder* recorder) {
    const auto draw = [&hosts, &entities, &painter, &record, recorder,
                       standby = standby_view(painter.image_plane())](const scheduler::FrameTick& tick) {
        const host::FrameStatus status{static_cast<std::uint32_t>(tick.number), tick.started,
                                       static_cast<std::uint32_t>(record.deadline_misses)};
        for (const auto& host : hosts) {
            host->link->take_newest(host->state);
            if (recorder != nullptr)
                recorder->frame(
                    {tick.number, tick.due, host->link->heard(), static_cast<std::uint32_t>(painter.step())});
            host->link->frame_begins(status);
            host->view = host->eye->view(host->state, tick.due);
        }
        const auto others = entities.at(status, tick.due);
        scheduler::DrawnFrame drawn;
        LiveHost* host = driving_host(hosts, tick.started);
        if (!host) {
            Environment environment;
            environment.seconds = std::chrono::duration<double>(tick.elapsed).count();
            environment.bodies = others;
            drawn.stages = painter.paint(standby, environment, tick.number);
            return drawn;
        }
        drawn.stages = painter.paint(*host->view, host->eye->environment(host->state, tick.elapsed, others),
                                     tick.number, {host->state.test_pattern, host->state.overlay});
        if (const auto arrival = host->eye->fresh_arrival(host->state)) drawn.input_age = tick.started - *arrival;
        return drawn;
    };
    return {stop_requested, draw,
            [&](const scheduler::FrameTick& tick) { outlets.hand_over(painter.image(), tick.number); }};
}

/// Of the protocols only CIGI has words for questions.
bool may_ask(const std::unique_ptr<LiveHost>& host) { return host->link->url().protocol == host::Protocol::cigi; }

LiveHosts listen(const std::vector<host::LinkUrl>& links) {
    LiveHosts hosts;
    for (const host::LinkUrl& url : links) {
        hosts.push_back(std::make_unique<LiveHost>(url));
        std::cerr << "quadrig: " << url.text << " listens on " << hosts.back()->link->place() << '\n';
    }
    return hosts;
}

config::ApplianceSettings settings_of(const LiveOptions& options) {
    config::ApplianceSettings settings = options.settings;
    if (!options.appliance.empty())
        settings =
            combined(settings, config::read_appliance(options.appliance, {display::kSinkUrls, display::is_sink_url}));
    if (!settings.scene) throw WrongUse("--scene is missing: what is there to see?");
    if (settings.links.empty())
        throw WrongUse("--link is missing: who is to drive? Say for example cigi://127.0.0.1:8004");
    if (!options.record.empty() && settings.links.size() != 1)
        throw WrongUse("--record takes one link, beside those of entities: a recording is one host's");
    expect_outputs({options.report, options.contact_sheet, options.record}, settings.sinks,
                   {*settings.scene, options.appliance, options.ladder});
    return settings;
}

void run(const LiveOptions& options) {
    const config::ApplianceSettings given = settings_of(options);
    const PictureSettings settings = picture_settings(options, given);
    watch_stop_signals();
    // Links use these for as long as they run: they go after them.
    std::optional<SceneSurvey> survey;
    std::unique_ptr<host::Recorder> recorder;
    LiveHosts hosts = listen(given.links);
    std::optional<OwnEntities::Recording> recorded;
    if (!options.record.empty()) recorded = {options.record, {settings.rate.numerator, settings.rate.denominator}};
    OwnEntities entities(given.entities, recorded);
    Painter painter(scene_with_entities(given), settings);
    const Scene& scene = painter.scene();

    RunLength length{options.frames, options.duration};
    std::optional<std::uint64_t> most_frames = length.frames;
    if (length.duration) most_frames = scheduler::first_frame_from(settings.rate, *length.duration);
    Outlets outlets(
        {given.sinks, painter.video_format(), display::WhenFull::drop, {}, most_frames, options.contact_sheet});
    if (std::any_of(hosts.begin(), hosts.end(), may_ask)) survey.emplace(scene);
    if (!options.record.empty())
        recorder = std::make_unique<host::Recorder>(*hosts.front()->link,
                                                    host::Recorder::Settings{recorded->file, recorded->numbering});
    for (const auto& host : hosts) {
        const host::LinkUrl& url = host->link->url();
        host->eye.emplace(scene, painter.image_plane(), url.protocol, options.ignore_host_window, entity_types(given));
        host::SessionOptions session = session_options(url, scene, painter.image_plane(), entity_types(given));
        if (survey) session.surveyor = [&survey](const host::SurveyLine& line) { return survey->answer(line); };
        host->link->start(session);
    }
    entities.start(scene.origin);
    painter.warm_up(standby_view(painter.image_plane()));
    scheduler::FrameReport report = report_about(painter);
    scheduler::FrameRecord record;
    run_in_real_time(settings.rate, length, options.fifo,
                     hooks_for(hosts, entities, painter, outlets, record, recorder.get()), record, report);

    for (const auto& host : hosts) {
        host->link->stop();
        nlohmann::ordered_json told = live_link_report(*host->link);
        if (recorder) told["recorded"] = json_of(*recorder);
        report.links.push_back(std::move(told));
    }
    for (auto& told : entities.stop()) report.links.push_back(std::move(told));
    finish_report(report, record, painter, outlets, options.report);
    if (recorder) recorder->finish();
}

constexpr const char* kRunNotes =
    "Ports are bound before the scene is loaded: a host may begin at once. Until its first pose comes, the picture is\n"
    "that from 2 m above the scene's origin, looking north. Say 0.0.0.0 to be heard beyond this machine. Of several\n"
    "hosts the first that was heard within a second drives. SIGINT (control-C), SIGTERM and SIGHUP end the run with\n"
    "its report.\n\n"
    "The same settings may come from a file, for example:\n"
    "  scene = \"scenes/takeoff.toml\"\n"
    "  links = [\"fdm://127.0.0.1:5500\"]\n"
    "  size  = [1280, 720]\n"
    "  [[entity]]                        # another aircraft, flown by a host of its own\n"
    "  model = \"x-29\"\n"
    "  link  = \"fdm://127.0.0.1:5501\"\n\n"
    "Examples:\n"
    "  quadrig run --scene config/scenes/takeoff.toml --link fdm://127.0.0.1:5500 --sink y4m:- | mpv -\n"
    "  quadrig run --scene config/scenes/turn.toml --link cigi://127.0.0.1:8004 --seconds 60 --report run.json";

}  // namespace

void add_run(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("run", "Draw live, driven by a host over the network");
    const auto options = std::make_shared<LiveOptions>();
    add_option(command, "appliance", options->appliance, read_path, "Settings in a file; options win over it",
               "[APPLIANCE.toml]");
    add_list_option(command, "--link", options->settings.links, read_live_link,
                    "Where a host is listened to: cigi://ADDRESS:PORT,\nfdm://ADDRESS:PORT, can://INTERFACE or\n"
                    "modbus://ADDRESS:PORT (required; may be given again)",
                    "URL");
    add_host_options(command, *options);
    add_picture_options(command, *options);
    add_option(command, "--record", options->record, read_path,
               "Write what the host sends into a recording (one link only)", "FILE");
    command.add_flag("--fifo", options->fifo, "Ask for real-time priority (SCHED_FIFO; needs the privilege)");
    command.footer(kRunNotes);
    command.callback([options, &action] { action = [options] { run(*options); }; });
}

}  // namespace quadrig::appliance
