/// The commands of the program, each in a file of its own.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <stdexcept>

namespace quadrig::appliance {

/// Options that each make sense but not together: exit status 2.
struct WrongUse : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A command's work, once its options have been read. It throws WrongUse, or any other std::exception where it failed.
using Action = std::function<void()>;

/// Each adds a command with its options to the program, and sets `action` where that command is chosen.
void add_render(CLI::App& program, Action& action);
void add_replay(CLI::App& program, Action& action);
void add_monitor(CLI::App& program, Action& action);
void add_record(CLI::App& program, Action& action);
void add_send(CLI::App& program, Action& action);
void add_run(CLI::App& program, Action& action);
void add_bench(CLI::App& program, Action& action);
void add_check(CLI::App& program, Action& action);
void add_outline(CLI::App& program, Action& action);
void add_accuracy(CLI::App& program, Action& action);
void add_generate(CLI::App& program, Action& action);
void add_patterns(CLI::App& program, Action& action);
void add_gallery(CLI::App& program, Action& action);

}  // namespace quadrig::appliance
