/// The built program as a user has it: a process with a command line, two streams and an exit status.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace quadrig::tests {

using Arguments = std::vector<std::string>;

struct Outcome {
    int status = -1;  ///< exit status; minus the signal where one ended it
    std::string out, err;
};

/// Runs in the background; killed where a test forgets it.
class Program {
  public:
    explicit Program(const Arguments& arguments);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    [[nodiscard]] std::string err() const;
    /// The number that follows `text` on standard error, waited for; absent where the program ended without it.
    std::optional<int> number_after(const std::string& text);
    void signal(int number) const;
    Outcome wait();

  private:
    bool ended();
    std::filesystem::path directory_;
    pid_t process_ = -1;
    std::optional<int> status_;
};

/// Runs to its end.
Outcome quadrig_program(const Arguments& arguments);

/// What --report wrote.
nlohmann::json report_of(const std::filesystem::path& file);

}  // namespace quadrig::tests
