#include "tests/house/include_rule.h"

#include <catch2/catch.hpp>

#include "tests/house/planted_tree.h"

using namespace quadrig::tests;

TEST_CASE("every include points the way the layers allow") {
    const auto wrong = wrong_includes(QUADRIG_SOURCE_DIR);
    for (const std::string& include : wrong) UNSCOPED_INFO(include);
    CHECK(wrong.empty());
    CHECK(product_sources(QUADRIG_SOURCE_DIR).size() > 20);
}

TEST_CASE("an include that points the wrong way is found") {
    struct Planted {
        std::string file, include;
        bool allowed;
    };
    const std::vector<Planted> cases{
        {"ig_core/geometry/a.h", "\"ig_core/scene/scene.h\"", false},
        {"ig_core/scene/a.h", "\"ig_core/geometry/space.h\"", true},
        {"ig_core/scene/a.h", "\"ig_core/outline/outline.h\"", false},
        {"ig_core/outline/a.h", "\"ig_core/scene/scene.h\"", true},
        {"ig_core/outline/a.cpp", "\"ig_core/spans/span.h\"", false},
        {"ig_core/spans/a.h", "\"ig_core/outline/outline.h\"", true},
        {"ig_core/spans/a.h", "\"ig_core/shading/shade.h\"", false},
        {"ig_core/shading/a.h", "\"ig_core/view.h\"", true},
        {"ig_core/reference/a.cpp", "\"ig_core/view.h\"", true},
        {"ig_core/reference/a.cpp", "\"ig_core/outline/outline.h\"", false},
        {"ig_core/reference/a.cpp", "\"ig_core/image_generator.h\"", false},
        {"ig_core/view.h", "\"ig_core/image_generator.h\"", false},
        {"ig_core/image_generator.cpp", "\"ig_core/shading/shade.h\"", true},
        {"ig_core/image_generator.cpp", "\"host_link/host_state.h\"", false},
        {"host_link/a.h", "\"ig_core/geometry/space.h\"", true},
        {"host_link/a.h", "\"ig_core/view.h\"", false},
        {"frame_scheduler/a.h", "\"host_link/host_state.h\"", true},
        {"frame_scheduler/a.h", "\"host_link/cigi/decoder.h\"", false},
        {"frame_scheduler/a.h", "\"display/sink.h\"", false},
        {"display/a.h", "\"ig_core/view.h\"", true},
        {"display/a.h", "\"host_link/host_state.h\"", false},
        {"config/a.h", "\"ig_core/scene/scene.h\"", true},
        {"config/a.h", "\"appliance/main.h\"", false},
        {"appliance/a.h", "\"display/sink.h\"", true},
        {"appliance/a.h", "\"tests/house/x.h\"", false},
        {"display/a.h", "\"no/such/file.h\"", false},
        {"display/a.h", "\"sink.h\"", false},
        {"display/a.h", "<vector>", true},
        {"display/a.h", "<host_link/host_state.h>", false},
    };
    for (const auto& [file, include, allowed] : cases) {
        INFO(file << " includes " << include);
        const PlantedTree tree;
        for (const char* there :
             {"ig_core/geometry/space.h", "ig_core/scene/scene.h", "ig_core/outline/outline.h", "ig_core/spans/span.h",
              "ig_core/shading/shade.h", "ig_core/view.h", "ig_core/image_generator.h", "host_link/host_state.h",
              "host_link/cigi/decoder.h", "display/sink.h", "appliance/main.h", "tests/house/x.h"}) {
            tree.plant(there, "#pragma once\n");
        }
        tree.plant(file, "#pragma once\n\n#include " + include + "\n");
        const auto wrong = wrong_includes(tree.root());
        if (allowed) {
            CHECK(wrong.empty());
        } else {
            REQUIRE(wrong.size() == 1);
            CHECK_THAT(wrong[0], Catch::StartsWith(file + ":3 includes "));
        }
    }
}
