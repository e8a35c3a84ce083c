#include "appliance/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <map>
#include <system_error>

#include "appliance/commands.h"
#include "display/atomic_file.h"

namespace quadrig::appliance {

namespace {

/// A sink's name for it.
const std::filesystem::path kStandardOutput = "-";

/// Whether standard output goes to what `path` names: a file, or a pipe, which std::filesystem does not compare.
bool is_standard_output(const std::filesystem::path& path) {
    using Status = struct stat;
    Status named{}, standard{};
    return stat(path.c_str(), &named) == 0 && fstat(STDOUT_FILENO, &standard) == 0 && !S_ISCHR(named.st_mode) &&
           named.st_dev == standard.st_dev && named.st_ino == standard.st_ino;
}

/// Where what is written to `path` ends up.
std::filesystem::path place_of(const std::filesystem::path& path) {
    return path == kStandardOutput || is_standard_output(path) ? kStandardOutput : display::written_to(path);
}

}  // namespace

void expect_outputs(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& sinks,
                    const std::vector<std::filesystem::path>& inputs) {
    std::map<std::filesystem::path, std::string> read, written;
    for (const auto& input : inputs)
        if (!input.empty()) read.try_emplace(display::written_to(input), input.string());
    const auto expect_new = [&](const std::filesystem::path& path, const std::string& name) {
        const auto place = place_of(path);
        if (const auto input = read.find(place); input != read.end())
            throw WrongUse(name + " would write over " + input->second + ", which is read");
        const auto [other, is_new] = written.try_emplace(place, name);
        if (is_new) return;
        const std::string also = other->second == name ? "" : " (as " + other->second + ")";
        throw WrongUse(name + " is given twice" + also + ": each output would write over the other");
    };
    for (const std::string& sink : sinks)
        if (const std::string target = sink.substr(sink.find(':') + 1); !target.empty()) expect_new(target, sink);
    const bool video_on_standard_output = written.contains(kStandardOutput);
    std::error_code none;
    for (const auto& file : files) {
        const bool takes_anything =
            std::filesystem::is_other(file, none) && !(video_on_standard_output && place_of(file) == kStandardOutput);
        if (!file.empty() && !takes_anything) expect_new(file, file.string());
    }
    for (const auto& file : files)
        if (!file.empty()) display::expect_writable(file);
}

}  // namespace quadrig::appliance
