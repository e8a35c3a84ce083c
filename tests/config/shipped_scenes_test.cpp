#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "config/scene_file.h"

using namespace quadrig;

TEST_CASE("every scene that ships is in order") {
    int scenes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(QUADRIG_SOURCE_DIR "/config/scenes")) {
        if (entry.path().extension() != ".toml") continue;
#if defined(__SANITIZE_ADDRESS__)
        if (entry.path().stem() == "out_of_view") continue;  // a hundred thousand objects take most of a minute
#endif
        INFO(entry.path());
        ++scenes;
        CHECK_NOTHROW(config::read_scene(entry.path()));
    }
    CHECK(scenes >= 7);
}

TEST_CASE("the landscapes of the recorded flights have hills, translucent trees and clouds over a textured ground") {
    for (const char* name : {"takeoff.toml", "turn.toml"}) {
        INFO(name);
        const Scene scene = config::read_scene(std::filesystem::path(QUADRIG_SOURCE_DIR "/config/scenes") / name);
        const auto hills = std::count_if(scene.objects.begin(), scene.objects.end(),
                                         [](const Object& o) { return std::holds_alternative<Hill>(o.shape); });
        const auto translucent = std::count_if(scene.objects.begin(), scene.objects.end(),
                                               [](const Object& o) { return o.paint.translucence.has_value(); });
        CHECK(hills >= 20);
        CHECK(translucent >= 60);
        REQUIRE(scene.ground);
        CHECK(scene.ground->paint.texture);
        CHECK_FALSE(scene.cloud_decks.empty());
    }
}
