#include "tests/house/include_rule.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <string_view>

namespace quadrig::tests {
namespace {

namespace fs = std::filesystem;

/// Paths that begin with `folder` may include paths that begin with `folder` itself or any of `allowed`. The first row
/// that fits counts.
struct Row {
    std::string_view folder;
    std::vector<std::string_view> allowed;
};

const std::vector<Row>& rows() {
    static const std::vector<Row> table{
        {"ig_core/geometry/", {}},
        {"ig_core/scene/", {"ig_core/geometry/"}},
        {"ig_core/clusters/", {"ig_core/geometry/", "ig_core/scene/"}},
        {"ig_core/view.", {"ig_core/geometry/", "ig_core/scene/", "ig_core/quality.h"}},
        {"ig_core/outline/", {"ig_core/geometry/", "ig_core/scene/", "ig_core/quality.h"}},
        {"ig_core/spans/",
         {"ig_core/outline/", "ig_core/geometry/", "ig_core/scene/", "ig_core/view.", "ig_core/quality.h"}},
        {"ig_core/shading/",
         {"ig_core/spans/", "ig_core/outline/", "ig_core/geometry/", "ig_core/scene/", "ig_core/view.",
          "ig_core/quality.h"}},
        {"ig_core/reference/", {"ig_core/geometry/", "ig_core/scene/", "ig_core/view."}},
        {"ig_core/", {"ig_core/"}},
        {"host_link/", {"ig_core/geometry/"}},
        {"frame_scheduler/",
         {"ig_core/geometry/", "ig_core/scene/", "ig_core/quality.h", "ig_core/view.h", "ig_core/image_generator.h",
          "host_link/host_state.h", "host_link/entity_motion.h", "host_link/mailbox.h"}},
        {"display/", {"ig_core/geometry/", "ig_core/view.h"}},
        {"config/", {"ig_core/", "host_link/", "frame_scheduler/"}},
        {"appliance/", {"ig_core/", "host_link/", "frame_scheduler/", "display/", "config/"}},
    };
    return table;
}

constexpr std::array<std::string_view, 6> kProductFolders{"ig_core", "host_link", "frame_scheduler",
                                                          "display", "config",    "appliance"};

/// Why a file may not include another; empty where it may. Both are relative to the root.
std::string why_wrong(const std::string& file, const std::string& included, const fs::path& root) {
    if (!fs::exists(root / included)) return "there is no such file below the repository's root";
    const auto row =
        std::find_if(rows().begin(), rows().end(), [&](const Row& r) { return file.starts_with(r.folder); });
    if (row == rows().end()) return "the include rule has no row for this folder";
    const auto reaches = [&](std::string_view prefix) { return included.starts_with(prefix); };
    if (reaches(row->folder) || std::any_of(row->allowed.begin(), row->allowed.end(), reaches)) return {};
    return std::string(row->folder) + " may not know it";
}

}  // namespace

std::vector<fs::path> product_sources(const fs::path& root) {
    std::vector<fs::path> sources;
    for (const std::string_view folder : kProductFolders) {
        if (!fs::exists(root / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path extension = entry.path().extension();
            if (extension == ".h" || extension == ".cpp") sources.push_back(fs::relative(entry.path(), root));
        }
    }
    std::sort(sources.begin(), sources.end());
    return sources;
}

std::vector<std::string> wrong_includes(const fs::path& root) {
    // Angle brackets are for other people's headers; ours in them would slip past the rule, so they are looked at as
    // well.
    static const std::regex include_line(R"rx(^\s*#\s*include(?:_next)?\s*(["<])([^">]+)[">])rx");
    std::vector<std::string> wrong;
    for (const fs::path& source : product_sources(root)) {
        std::ifstream stream(root / source);
        std::string line;
        for (int number = 1; std::getline(stream, line); ++number) {
            std::smatch match;
            if (!std::regex_search(line, match, include_line)) continue;
            const std::string included = match[2];
            if (match[1] == "<" && !fs::exists(root / included)) continue;
            const std::string reason = why_wrong(source.generic_string(), included, root);
            if (reason.empty()) continue;
            wrong.push_back(source.generic_string() + ":" + std::to_string(number) + " includes \"" + included +
                            "\": " + reason);
        }
    }
    return wrong;
}

}  // namespace quadrig::tests
