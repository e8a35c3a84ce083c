#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

namespace fs = std::filesystem;

bool is_text(const fs::path& path) {
    constexpr std::array<std::string_view, 9> kExtensions{".h",  ".cpp",  ".md",    ".toml", ".txt",
                                                          ".py", ".json", ".cmake", ".csv"};
    const std::string extension = path.extension().string();
    return extension.empty() || std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

std::string contents(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("no file depends on a place outside the repository") {
    // In two pieces each, or this file would find itself.
    const std::array<std::string, 4> places{std::string("/work") + "/", std::string("../") + "shared",
                                            std::string(".lib") + "rary/", std::string("/home") + "/"};
    const fs::path root = QUADRIG_SOURCE_DIR;
    int files = 0;
    for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry) {
        const std::string name = entry->path().filename().string();
        if (name == ".git" || name == "build" || name == "demo-output" || name == ".cache") {
            entry.disable_recursion_pending();
            continue;  // a worktree's .git is a file, and says where the repository is
        }
        if (!entry->is_regular_file() || !is_text(entry->path())) continue;
        ++files;
        const std::string text = contents(entry->path());
        for (const std::string& place : places) {
            INFO(entry->path() << " mentions " << place);
            CHECK(text.find(place) == std::string::npos);
        }
    }
    CHECK(files > 20);
}
