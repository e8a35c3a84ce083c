/// `quadrig record`: what a host sends becomes a recording.
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "appliance/stop_signals.h"
#include "host_link/recorder.h"

namespace quadrig::appliance {
namespace {

struct RecordOptions {
    std::filesystem::path file;
    std::optional<host::LinkUrl> link;
    std::optional<scheduler::Time> duration;
};

void record(const RecordOptions& options) {
    if (!options.link) throw WrongUse("--link is missing: what is there to hear?");
    watch_stop_signals();
    const auto link = open_link(*options.link);
    host::Recorder recorder(*link, {options.file, std::nullopt});
    link->start(session_options(link->url(), {}));
    std::cerr << "quadrig: " << link->url().text << " listens on " << link->place() << '\n';
    const auto start = std::chrono::steady_clock::now();
    while (!stop_requested() && !(options.duration && std::chrono::steady_clock::now() - start >= *options.duration))
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    link->stop();
    recorder.finish();
    std::cerr << "quadrig: " << recorder.recorded() << " recorded, " << recorder.left_out() << " left out, "
              << link->statistics().frames << " poses among them\n";
}

constexpr const char* kRecordNotes =
    "No pictures: only what hosts send, as the link hears it. The file is pcapng, or for CAN candump's text where its\n"
    "name ends in .log. SIGINT (control-C), SIGTERM and SIGHUP end the recording; whatever ends it, all but the last\n"
    "tenth of a second is in the file. 'quadrig run --record FILE' records while it draws.\n\n"
    "Examples:\n"
    "  quadrig record flight.pcapng --link fdm://127.0.0.1:5500 --seconds 600\n"
    "  quadrig record flight.log --link can://can0";

}  // namespace

void add_record(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("record", "Write what a host sends into a recording");
    const auto options = std::make_shared<RecordOptions>();
    command.add_option("file", options->file, "The recording to write")->required()->option_text("FILE");
    add_option(command, "--link", options->link, read_live_link, "Where a host is listened to (required)", "URL");
    add_option(command, "--seconds", options->duration, read_duration, "Stop after S seconds", "S");
    command.footer(kRecordNotes);
    command.callback([options, &action] { action = [options] { record(*options); }; });
}

}  // namespace quadrig::appliance
