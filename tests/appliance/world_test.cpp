#include <catch2/catch.hpp>

#include "display/png_file.h"
#include "tests/appliance/files.h"
#include "tests/appliance/program.h"

using namespace quadrig;
using namespace quadrig::tests;
using Catch::Contains;

TEST_CASE("Generate writes a scene that renders as the one with clusters does") {
    const std::string scene = shipped("config/scenes/bench/trees.toml");
    const Outcome printed = quadrig_program({"generate", scene});
    INFO(printed.err);
    REQUIRE(printed.status == 0);
    CHECK_THAT(printed.out, Contains("name = \"tree-200\"") && !Contains("cluster"));
    const auto expanded = scratch_directory() / "expanded.toml";
    REQUIRE(quadrig_program({"generate", scene, "-o", expanded.string()}).status == 0);
    CHECK(text_of(expanded) == printed.out);
    std::vector<display::Picture> pictures;
    for (const std::string& each : {scene, expanded.string()}) {
        const auto png = scratch_directory() / "picture.png";
        REQUIRE(quadrig_program({"render", each, "--eye", "0,0,9", "--attitude", "0,0,0", "--size", "160x90", "--fov",
                                 "60", "-o", png.string()})
                    .status == 0);
        pictures.push_back(display::read_png(png));
    }
    CHECK(difference(pictures[0], pictures[1]).largest == 0);
    CHECK(quadrig_program({"generate", scene, "-o", "/nowhere/x.toml"}).status == 1);
}

TEST_CASE("Patterns names them all and draws a row of nine for each") {
    const auto png = scratch_directory() / "sheet.png";
    const Outcome outcome = quadrig_program({"patterns", "-o", png.string()});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("foliage\n") && Contains("smoke\n"));
    const auto rows = std::count(outcome.out.begin(), outcome.out.end(), '\n');
    display::Picture sheet = display::read_png(png);
    CHECK(sheet.width == 9 * 164 + 4);
    CHECK(sheet.height == rows * 124 + 4);
    // On the nearest plane and the nearest hill every pattern shows light and dark.
    for (int row = 0; row < rows; ++row)
        for (const int column : {0, 3}) {
            int darkest = 255, lightest = 0;
            for (int y = 70; y < 100; ++y)
                for (int x = 40; x < 120; ++x) {
                    const int red = *display::pixel(sheet.image(), 4 + 124 * row + y, 4 + 164 * column + x);
                    darkest = std::min(darkest, red);
                    lightest = std::max(lightest, red);
                }
            CAPTURE(row, column);
            CHECK(lightest - darkest > 40);
        }
}

TEST_CASE("Gallery draws every scene that travels along, and a page of them") {
    const auto directory = scratch_directory() / "gallery";
    const Outcome outcome =
        quadrig_program({"gallery", "-o", directory.string(), "--size", "160x90", "--quality", "draft"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    int pictures = 0;
    for (const char* figure :
         {"05_sphere_with_six_planes", "06_texture_on_the_ground", "07_cloud_layer", "08a_mountains_without_texture",
          "08b_mountains_with_texture", "09_trees_clouds_and_hills", "10_hills_and_trees", "11_hills_trees_and_clouds",
          "12_x29_above_clouds", "13_coast_at_dawn", "14_mountains_above_the_clouds", "15_approach_in_mist"}) {
        INFO(figure);
        const display::Picture picture = display::read_png(directory / (std::string(figure) + ".png"));
        ++pictures;
        CHECK(picture.width == 160);
        CHECK(picture.height == 90);
        int darkest = 255, lightest = 0;
        for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
            darkest = std::min<int>(darkest, picture.pixels[i]);
            lightest = std::max<int>(lightest, picture.pixels[i]);
        }
        CHECK(lightest - darkest > 60);
    }
    CHECK(std::distance(std::filesystem::directory_iterator(directory), {}) == pictures + 1);
    const display::Picture sheet = display::read_png(directory / "contact_sheet.png");
    CHECK(sheet.width == 3 * 164 + 4);
    CHECK(sheet.height == 4 * 94 + 4);
}

TEST_CASE("Gallery wants a camera for every scene") {
    const auto scenes = scratch_directory();
    std::filesystem::copy(scratch_file("scene.toml", small_scene()), scenes / "scene.toml");
    const Outcome without = quadrig_program({"gallery", "--scenes", scenes.string(), "-o", (scenes / "out").string()});
    CHECK(without.status == 1);
    CHECK_THAT(without.err, Contains("scene.json"));
    const Outcome empty = quadrig_program({"gallery", "--scenes", scratch_directory().string(), "-o", scenes.string()});
    CHECK(empty.status == 1);
    CHECK_THAT(empty.err, Contains("there are no scenes"));
}
