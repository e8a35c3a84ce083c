#include <catch2/catch.hpp>

#include "config/config_directory.h"
#include "config/model_section.h"
#include "config/scene_file.h"
#include "tests/config/temporary_file.h"

using namespace quadrig;
using tests::scene_of;
using tests::TemporaryFile;

TEST_CASE("the aircraft that travels along is about 40 quadrics, the same on both sides") {
    const auto parts = config::read_model(config::config_directory() / "models" / "x-29.toml");
    CHECK(parts.size() >= 36);
    CHECK(parts.size() <= 44);
    int pairs = 0;
    for (const Object& part : parts) {
        if (!part.name.starts_with("left-")) continue;
        for (const Object& other : parts) {
            if (other.name != "right-" + part.name.substr(5)) continue;
            ++pairs;
            const auto &left = std::get<Ellipsoid>(part.shape), &right = std::get<Ellipsoid>(other.shape);
            CHECK(left.centre.metres == right.centre.metres * glm::dvec3(-1, 1, 1));
            CHECK(left.semi_axes == right.semi_axes);
            CHECK(left.attitude.heading.value == -right.attitude.heading.value);
        }
    }
    CHECK(pairs >= 11);
}

TEST_CASE("models stand behind the file's own objects, each under its own name") {
    const Scene scene = scene_of(
        "[[object]]\nname = \"first\"\nellipsoid = { centre = [0, 0, 0], semi_axes = [1, 1, 1] }\n"
        "[[model]]\nmodel = \"x-29\"\nposition = [100, 200, 300]\n"
        "[[model]]\nname = \"lead\"\nmodel = \"x-29\"\nposition = [0, 0, 50]\nattitude = [90, 0, 0]\n");
    const std::size_t parts = (scene.objects.size() - 1) / 2;
    CHECK(scene.objects[0].name == "first");
    CHECK(scene.objects[1].name == "x-29.forebody");
    CHECK(scene.objects[1 + parts].name == "lead.forebody");
    const auto &here = std::get<Ellipsoid>(scene.objects[1].shape),
               &lead = std::get<Ellipsoid>(scene.objects[1 + parts].shape);
    CHECK(glm::length(here.centre.metres - glm::dvec3(100, 202, 299.95)) < 1e-12);
    // Heading east: what was ahead is east.
    CHECK(glm::length(lead.centre.metres - glm::dvec3(2, 0, 49.95)) < 1e-12);
    CHECK(lead.attitude.heading.value == Approx(90.0));
}

TEST_CASE("mistakes about models are refused") {
    using Catch::Contains;
    const std::string good = "[[model]]\nmodel = \"x-29\"\nposition = [0, 0, 9]\n";
    CHECK_THROWS_WITH(scene_of("[[model]]\nmodel = \"x-30\"\nposition = [0, 0, 9]\n"),
                      Contains("model[0].model") && Contains("found \"x-30\""));
    CHECK_THROWS_WITH(scene_of("[[model]]\nmodel = \"../scenes/village\"\nposition = [0, 0, 9]\n"),
                      Contains("model[0].model"));
    CHECK_THROWS_WITH(scene_of("[[model]]\nmodel = \"x-29\"\n"), Contains("model[0].position"));
    CHECK_THROWS_WITH(scene_of(good + good), Contains("model[1]") && Contains("x-29.forebody"));
    CHECK_THROWS_WITH(config::read_model(TemporaryFile("[[object]]\nname = \"a\"\nhill = { apex = [0, 0, 1], "
                                                       "radius_of_curvature = 1, slope = 1 }\n")
                                             .path()),
                      Contains("object[0].hill") && Contains("unknown key"));
}
