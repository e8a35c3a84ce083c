#include <catch2/catch.hpp>
#include <random>

#include "config/scene_file.h"
#include "tests/config/example_scene.h"
#include "tests/config/temporary_file.h"

using namespace quadrig;

namespace {

/// Whether the reader took the text; anything but a scene or a FileError fails the test.
bool accepts(const std::string& text) {
    const tests::TemporaryFile file(text);
    try {
        config::read_scene(file.path());
        return true;
    } catch (const config::FileError& error) {
        CHECK_THAT(error.what(), Catch::StartsWith(file.path().string() + ":"));
        return false;
    }
}

}  // namespace

TEST_CASE("a scene file cut short anywhere is read or refused, never more") {
    const std::string whole(tests::kExampleScene);
    int accepted = 0, refused = 0;
    for (std::size_t length = 0; length <= whole.size(); length += 7) {
        ++(accepts(whole.substr(0, length)) ? accepted : refused);
    }
    CHECK(accepted > 0);
    CHECK(refused > 0);
}

TEST_CASE("a garbled scene file is read or refused, never more") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const std::string whole(tests::kExampleScene);
    const std::string_view alphabet("[]{}=\"',.#-+eE0123456789nainf\n \t\\\x01\xff_xXtrue");
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    int accepted = 0, refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = whole;
        for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
            const std::size_t at = below(text.size());
            switch (below(4)) {
                case 0:
                    text[at] = alphabet[below(alphabet.size())];
                    break;
                case 1:
                    text.insert(at, 1, alphabet[below(alphabet.size())]);
                    break;
                case 2:
                    text.erase(at, 1 + below(30));
                    break;
                default:
                    text.insert(at, whole.substr(below(whole.size()), 1 + below(60)));
                    break;
            }
        }
        ++(accepts(text) ? accepted : refused);
    }
    CHECK(accepted > 0);
    CHECK(refused > 0);
}
