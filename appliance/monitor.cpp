/// `quadrig monitor`: what comes over a link, and what is odd about it.
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "appliance/stop_signals.h"
#include "host_link/live_link.h"
#include "host_link/monitor.h"

namespace quadrig::appliance {
namespace {

struct MonitorOptions {
    std::optional<host::LinkUrl> link;
    std::optional<scheduler::Time> duration;
    bool strict = false;
};

void monitor(const MonitorOptions& options) {
    watch_stop_signals();
    std::mutex mutex;
    host::Monitor monitor(*options.link);
    const auto link = open_link(*options.link);
    link->record_to([&](const host::Heard& heard) {
        const std::lock_guard lock(mutex);
        monitor.hear(heard);
    });
    std::cerr << "quadrig: " << link->url().text << " listens on " << link->place() << std::endl;
    link->start(session_options(link->url(), {}));

    const bool terminal = isatty(STDOUT_FILENO) == 1;
    const auto tell = [&] {
        const host::LinkStatistics heard = link->statistics();
        std::string text;
        {
            const std::lock_guard lock(mutex);
            monitor.hear_refusals(heard);
            for (const std::string& line : monitor.take_oddities())
                if (options.strict) text += line + '\n';
            if (!options.strict) text = monitor.view(host::clock_time(CLOCK_MONOTONIC));
        }
        // A new page, from its first line.
        if (terminal && !options.strict) std::cout << "\x1b[H\x1b[2J" << link->url().text << "  ";
        std::cout << text << std::flush;
        if (!std::cout) throw std::runtime_error("standard output cannot be written to");
    };
    using Clock = std::chrono::steady_clock;
    // Hosts that run in step wait for a frame's start.
    constexpr std::chrono::nanoseconds kFrame{16'666'667};
    constexpr std::uint32_t kFramesASecond = 60;
    const auto start = Clock::now();
    host::HostState state;
    for (std::uint32_t frame = 1; !stop_requested(); ++frame) {
        std::this_thread::sleep_until(start + frame * kFrame);
        link->take_newest(state);
        link->frame_begins({frame, host::clock_time(CLOCK_MONOTONIC), 0});
        if (frame % kFramesASecond == 0) tell();
        if (options.duration && Clock::now() - start >= *options.duration) break;
    }
    link->stop();
    tell();
    if (!options.strict) return;
    const auto messages = monitor.statistics().datagrams;
    std::cout << monitor.oddities() << " oddities in " << messages << " messages, " << monitor.statistics().frames
              << " poses\n";
    if (messages == 0) throw std::runtime_error("nothing was heard");
    if (monitor.oddities() != 0) throw std::runtime_error("the host does not conform");
}

constexpr const char* kMonitorNotes =
    "Once a second: the link's rates, and a line for each packet with the last value of every field; values out of\n"
    "range are marked (!), and what is refused is told with its likely cause. Hosts are answered as by 'run'. With\n"
    "--strict: a line for each oddity (refused, lost, doubled, out of order or of range, gaps over 50 ms, restarts)\n"
    "and exit status 1 where there was one, or nothing was heard. SIGINT (control-C), SIGTERM and SIGHUP end it.\n\n"
    "Examples:\n"
    "  quadrig monitor cigi://0.0.0.0:8004\n"
    "  quadrig monitor fdm://127.0.0.1:5500 --seconds 10 --strict";

}  // namespace

void add_monitor(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("monitor", "Show what comes over a link, and what is odd about it");
    const auto options = std::make_shared<MonitorOptions>();
    add_option(command, "url", options->link, read_live_link,
               "cigi://ADDRESS:PORT, fdm://ADDRESS:PORT,\ncan://INTERFACE or modbus://ADDRESS:PORT", "URL")
        ->required();
    add_option(command, "--seconds", options->duration, read_duration, "Stop after S seconds", "S");
    command.add_flag("--strict", options->strict, "Report each oddity; exit status 1 where there was one");
    command.footer(kMonitorNotes);
    command.callback([options, &action] { action = [options] { monitor(*options); }; });
}

}  // namespace quadrig::appliance
