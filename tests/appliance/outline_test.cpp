#include <catch2/catch.hpp>

#include "tests/appliance/files.h"
#include "tests/appliance/program.h"

using namespace quadrig::tests;
using Catch::Contains;

namespace {

const std::string kSphere = shipped("config/scenes/sphere_with_six_planes.toml");

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
    return found;
}

}  // namespace

TEST_CASE("Outline draws the figure that is shown in the README") {
    const auto figure = scratch_directory() / "figure.svg";
    const Outcome outcome = quadrig_program({"outline", kSphere, "--object", "sphere", "-o", figure.string()});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const std::string svg = text_of(figure);
    CHECK_THAT(
        svg, Contains("6 intersection curves") && Contains("6 visibility lines") && Contains("13 intersection lines"));
    CHECK_THAT(svg, Contains("4 contact points") && Contains("2 triplet points") && Contains("17 z-bands"));
    CHECK(count(svg, "<svg") == 1);
    CHECK(count(svg, "data:image/png;base64,") == 1);
    CHECK(svg.substr(svg.size() - 7) == "</svg>\n");
}

TEST_CASE("Outline names the objects there are where one is asked for that is not") {
    const auto figure = scratch_directory() / "figure.svg";
    const Outcome outcome = quadrig_program({"outline", kSphere, "--object", "cube", "-o", figure.string()});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Contains("no object is named 'cube'") && Contains("sphere"));
    CHECK_FALSE(std::filesystem::exists(figure));
}
