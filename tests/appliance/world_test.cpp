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
