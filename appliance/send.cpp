/// `quadrig send`: a recording becomes a host.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "appliance/commands.h"
#include "appliance/option_values.h"
#include "appliance/stop_signals.h"
#include "host_link/capture.h"
#include "host_link/sender.h"

namespace quadrig::appliance {
namespace {

struct SendOptions {
    std::filesystem::path recording;
    std::optional<host::LinkUrl> to;
    double speed = 1.0;
};

/// Ten years: a time that a clock can still be ahead by.
constexpr std::chrono::duration<double, std::nano> kEver = std::chrono::hours(24 * 3650);

void send(const SendOptions& options) {
    if (!options.to) throw WrongUse("--to is missing: where to?");
    if (options.to->port == 0) throw WrongUse("--to " + options.to->text + ": nobody listens at port 0");
    watch_stop_signals();
    const host::Capture capture = host::read_capture(options.recording, options.to->protocol);
    const auto sender = host::open_sender(*options.to);
    // Absolute times: a sleep that ends late does not move what comes after it.
    const auto start = std::chrono::steady_clock::now();
    const host::Time first = capture.datagrams.front().captured;
    std::uint64_t sent = 0, failed = 0;
    std::error_code failure;  // the first
    for (std::size_t i = 0; i < capture.datagrams.size(); ++i) {
        const host::Capture::Datagram& datagram = capture.datagrams[i];
        const std::chrono::duration<double, std::nano> since = (datagram.captured - first) / options.speed;
        const auto due =
            start + std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::min(since, kEver));
        while (!stop_requested() && std::chrono::steady_clock::now() < due)
            std::this_thread::sleep_until(
                std::min(due, std::chrono::steady_clock::now() + std::chrono::milliseconds(50)));
        if (stop_requested()) break;
        for (const auto& closing : capture.closed_before(i)) sender->close(closing.source);
        const std::error_code refused = sender->send(capture.payload(datagram), datagram.source);
        ++(refused ? failed : sent);
        if (!failure) failure = refused;
        if (refused == std::errc::broken_pipe || refused == std::errc::connection_reset) break;
    }
    const std::string counts = std::to_string(sent) + " sent, " + std::to_string(failed) + " not";
    if (failure) throw std::runtime_error(counts + ": " + options.to->text + ": " + failure.message());
    std::cerr << "quadrig: " << counts << '\n';
}

constexpr const char* kSendNotes =
    "Whatever the recording's host sent, byte for byte, at its own pace: a host for those who have none. What comes\n"
    "back is not looked at. Exit status 1 where something could not be sent, such as to a port at which nobody\n"
    "listens; the rest is sent all the same, but over a connection that is lost.\n\n"
    "Examples:\n"
    "  quadrig send config/traces/netfdm-c172-takeoff.pcap --to fdm://127.0.0.1:5500\n"
    "  quadrig send config/traces/canaerospace-c172-takeoff.log --to can://vcan0 --speed 2";

}  // namespace

void add_send(CLI::App& program, Action& action) {
    CLI::App& command = *program.add_subcommand("send", "Play a recording to a live link, as its host did");
    const auto options = std::make_shared<SendOptions>();
    command.add_option("recording", options->recording, "The recording")->required()->option_text("RECORDING");
    add_option(
        command, "--to", options->to, read_live_link,
        "Where to: cigi://ADDRESS:PORT, fdm://ADDRESS:PORT,\ncan://INTERFACE or modbus://ADDRESS:PORT (required)",
        "URL");
    add_option(command, "--speed", options->speed, read_speed, "Times as fast as it was recorded (default 1)", "X");
    command.footer(kSendNotes);
    command.callback([options, &action] { action = [options] { send(*options); }; });
}

}  // namespace quadrig::appliance
