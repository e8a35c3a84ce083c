#include <catch2/catch.hpp>
#include <sstream>

#include "config/scene_file.h"
#include "tests/config/temporary_file.h"

using namespace quadrig;
using tests::replaced;
using tests::TemporaryFile;

namespace {

constexpr const char* kGround =
    "[[runway]]\nthreshold = [10, 20]\nheading = 90\nlength = 1500\nwidth = 30\nlights = { approach = 300, intensity = "
    "7 }\n"
    "[[ground_polygon]]\ncorners = [[0, 0], [10, 0], [10, 10], [0, 10]]\ncolour = [0.5, 0.25, 0.125]\n"
    "[[light]]\npositions = [[1, 2, 3], [4, 5, 6]]\ncolour = [0, 0.5, 1]\nbeam = { heading = 45, width = 30 }\n";

}  // namespace

TEST_CASE("runways, polygons and lights are read, polygons of the file over those of runways") {
    const Scene scene = config::read_scene(TemporaryFile(kGround).path());
    REQUIRE(scene.ground_polygons.size() > 20);
    CHECK(scene.ground_polygons.back().paint.colour == Colour(0.5, 0.25, 0.125));
    CHECK(scene.ground_polygons.back().corners.size() == 4);
    CHECK(scene.ground_polygons.front().corners[1].x == Approx(10));  // the threshold's right corner, heading east
    CHECK(scene.ground_polygons.front().corners[1].y == Approx(5));
    REQUIRE(scene.lights.size() > 100);
    const LightPoint& last = scene.lights.back();
    CHECK(last.position.metres == glm::dvec3(4, 5, 6));
    CHECK(last.colour == Colour(0, 0.5, 1));
    CHECK(last.intensity == 20);
    REQUIRE(last.beam);
    CHECK(last.beam->heading.value == 45);
    CHECK(last.beam->width.value == 30);
    CHECK(scene.lights.front().intensity == 7);
}

TEST_CASE("polygons and lights are written as they were read") {
    const Scene scene = config::read_scene(TemporaryFile(kGround).path());
    std::ostringstream text;
    config::write_scene(scene, text);
    const Scene again = config::read_scene(TemporaryFile(text.str()).path());
    REQUIRE(again.ground_polygons.size() == scene.ground_polygons.size());
    REQUIRE(again.lights.size() == scene.lights.size());
    for (std::size_t i = 0; i < scene.ground_polygons.size(); ++i)
        CHECK(again.ground_polygons[i].corners == scene.ground_polygons[i].corners);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        CHECK(again.lights[i].position.metres == scene.lights[i].position.metres);
        CHECK(again.lights[i].beam.has_value() == scene.lights[i].beam.has_value());
    }
}

TEST_CASE("mistakes on the ground are refused with their key and what was expected") {
    for (const auto& [what, by, complaint] : std::vector<std::array<const char*, 3>>{
             {"[10, 10], [0, 10]", "[0, 10], [10, 10]",
              "key 'ground_polygon[0].corners': expected the corners of a convex"},
             {"[[0, 0], [10, 0], [10, 10], [0, 10]]", "[[0, 0], [10, 0]]", "expected 3 to 16 corners"},
             {"length = 1500", "length = 50", "key 'runway[0].length': expected metres in 100..20000"},
             {"approach = 300", "aproach = 300", "key 'runway[0].lights.aproach'"},
             {"positions = [[1, 2, 3], [4, 5, 6]]", "positions = []", "key 'light[0].positions'"},
             {"width = 30 }", "width = 0 }", "key 'light[0].beam.width'"},
             {"[0, 0.5, 1]", "[0, 0.5, 2]", "key 'light[0].colour[2]'"}}) {
        const TemporaryFile file(replaced(kGround, what, by));
        CHECK_THROWS_WITH(config::read_scene(file.path()), Catch::Contains(complaint));
    }
}
