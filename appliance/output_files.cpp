#include "appliance/output_files.h"

#include <map>
#include <system_error>

#include "appliance/commands.h"
#include "display/atomic_file.h"

namespace quadrig::appliance {

void expect_outputs(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& sinks) {
    std::map<std::filesystem::path, std::string> given;
    const auto expect_new = [&given](const std::filesystem::path& written, const std::string& name) {
        const auto [place, is_new] = given.try_emplace(written, name);
        if (is_new) return;
        const std::string also = place->second == name ? "" : " (as " + place->second + ")";
        throw WrongUse(name + " is given twice" + also + ": each output would write over the other");
    };
    for (const std::string& sink : sinks) {
        const std::string target = sink.substr(sink.find(':') + 1);
        if (target == "-")
            expect_new(target, sink);
        else if (!target.empty())
            expect_new(display::written_to(target), sink);
    }
    std::error_code none;
    for (const auto& file : files)
        if (!file.empty() && !std::filesystem::is_other(file, none))
            expect_new(display::written_to(file), file.string());
    for (const auto& file : files)
        if (!file.empty()) display::expect_writable(file);
}

}  // namespace quadrig::appliance
