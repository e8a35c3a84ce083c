#include "tests/appliance/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <thread>

#include "tests/appliance/files.h"

namespace quadrig::tests {

Program::Program(const Arguments& arguments) : directory_(scratch_directory()) {
    std::vector<std::string> words{QUADRIG_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = directory_ / "out", err = directory_ / "err";
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ == 0) {
        dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
        dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        execv(argv[0], argv.data());
        _exit(127);
    }
}

Program::~Program() {
    if (ended()) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

bool Program::ended() {
    if (status_) return true;
    int raw = 0;
    if (waitpid(process_, &raw, WNOHANG) != process_) return false;
    status_ = WIFEXITED(raw) ? WEXITSTATUS(raw) : -WTERMSIG(raw);
    return true;
}

std::string Program::err() const { return text_of(directory_ / "err"); }

std::optional<int> Program::number_after(const std::string& text) {
    while (true) {
        const bool last_look = ended();
        const std::string said = err();
        const std::size_t at = said.find(text);
        if (at != std::string::npos && said.find('\n', at) != std::string::npos)
            return std::stoi(said.substr(at + text.size()));
        if (last_look) return std::nullopt;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

void Program::signal(int number) const { kill(process_, number); }

Outcome Program::wait() {
    while (!ended()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return {*status_, text_of(directory_ / "out"), err()};
}

Outcome quadrig_program(const Arguments& arguments) { return Program(arguments).wait(); }

nlohmann::json report_of(const std::filesystem::path& file) { return nlohmann::json::parse(text_of(file)); }

}  // namespace quadrig::tests
