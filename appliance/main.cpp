#include <fcntl.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>

#include "appliance/commands.h"
#include "host_link/link_url.h"

namespace {

using namespace quadrig::appliance;

enum ExitStatus { kDone = 0, kFailed = 1, kWrongUse = 2 };

int complain(const std::string& what, ExitStatus status) {
    std::cerr << "quadrig: " << what << '\n';
    return status;
}

int wrong_use(const CLI::App& program, const std::string& what) {
    const auto chosen = program.get_subcommands();
    const std::string command = chosen.empty() ? "quadrig" : "quadrig " + chosen.front()->get_name();
    return complain(what + "\nSee '" + command + " --help'.", kWrongUse);
}

/// What a command printed has arrived, or it has not done what it was asked to.
int done() {
    std::cout.flush();
    return std::cout ? kDone : complain("standard output cannot be written to", kFailed);
}

/// A standard stream that the caller closed would be the first file opened, and diagnostics would go into a recording.
/// Its place is taken by what refuses every use of it.
void keep_standard_streams_apart() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0)
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

/// CLI11 complains of what is missing before what is unknown, which is more often the reason.
std::string reason(const CLI::App& program, const CLI::ParseError& error) {
    const auto unknown = program.remaining(true);
    return unknown.empty() ? error.what() : "unknown option or argument: " + unknown.front();
}

}  // namespace

int main(int argc, char** argv) {
    keep_standard_streams_apart();
    // A reader that goes away, or a file too large for `ulimit -f`, is an error of the write, not the end of the
    // program.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);

    CLI::App program("Quadrig: an image generator that a flight simulator's host drives over the network.", "quadrig");
    program.set_version_flag("--version", "quadrig " QUADRIG_VERSION, "Say which version this is, and stop");
    program.set_help_flag("-h,--help", "Say what there is to ask for, and stop");
    program.footer(
        "'quadrig COMMAND --help' explains a command and gives examples; appliance/README.md tells all of them.\n"
        "Exit status: 0 done, 1 failed, 2 wrong use. Diagnostics and reports go to standard error.\n\n"
        "To begin with:\n"
        "  quadrig render config/scenes/one_tree.toml --eye 0,0,8 --attitude 0,0,0 --size 640x480 --fov 60 -o "
        "tree.png");
    program.require_subcommand(1);
    program.get_formatter()->column_width(34);

    Action action;
    add_render(program, action);
    add_replay(program, action);
    add_run(program, action);
    add_monitor(program, action);
    add_record(program, action);
    add_send(program, action);
    add_bench(program, action);
    add_check(program, action);
    add_outline(program, action);
    add_accuracy(program, action);
    add_generate(program, action);
    add_patterns(program, action);
    add_gallery(program, action);
    try {
        program.parse(argc, argv);
        action();
        return done();
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) return wrong_use(program, reason(program, error));
        program.exit(error);  // --help, --version
        return done();
    } catch (const WrongUse& error) {
        return wrong_use(program, error.what());
    } catch (const quadrig::host::LinkUrlError& error) {
        return wrong_use(program, error.what());
    } catch (const std::bad_alloc&) {
        return complain("there is not enough memory for this", kFailed);
    } catch (const std::exception& error) {
        return complain(error.what(), kFailed);
    }
}
