#include "tests/house/lone_headers.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <future>
#include <string>
#include <thread>

#include "tests/house/include_rule.h"

namespace quadrig::tests {
namespace {

namespace fs = std::filesystem;

bool compiles_alone(const fs::path& root, const fs::path& header) {
    // -include instead of a generated file; the header must not count on macros of its target either, except toml++'s
    // library mode, which only saves time.
    const std::string command = std::string(QUADRIG_CXX_COMPILER) +
                                " -std=c++20 -fsyntax-only -DTOML_HEADER_ONLY=0 -DTOML_SHARED_LIB=1 -x c++ -I'" +
                                root.string() + "' -include '" + (root / header).string() + "' /dev/null 2>/dev/null";
    return std::system(command.c_str()) == 0;
}

bool first_in_its_source(const fs::path& root, const fs::path& header) {
    std::ifstream source(root / fs::path(header).replace_extension(".cpp"));
    const std::string wanted = "#include \"" + header.generic_string() + '"';
    for (std::string line; std::getline(source, line);)
        if (line.starts_with("#include")) return line == wanted;
    return false;
}

}  // namespace

std::vector<fs::path> headers_that_need_others(const fs::path& root) {
    std::vector<fs::path> headers = product_sources(root);
    std::erase_if(headers, [&](const fs::path& source) {
        return source.extension() != ".h" || first_in_its_source(root, source);
    });
    std::vector<char> good(headers.size(), 0);
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < headers.size(); i = next++) good[i] = compiles_alone(root, headers[i]) ? 1 : 0;
    };
    std::vector<std::future<void>> workers;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
        workers.push_back(std::async(std::launch::async, work));
    }
    for (auto& worker : workers) worker.get();
    std::vector<fs::path> bad;
    for (std::size_t i = 0; i < headers.size(); ++i) {
        if (good[i] == 0) bad.push_back(headers[i]);
    }
    return bad;
}

}  // namespace quadrig::tests
