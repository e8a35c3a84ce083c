#include "config/scene_file.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <sstream>

#include "config/scene_summary.h"
#include "tests/config/example_scene.h"
#include "tests/config/temporary_file.h"

using namespace quadrig;
using config::read_scene;
using tests::scene_of;

namespace {

std::string written(const Scene& scene) {
    std::ostringstream out;
    config::write_scene(scene, out);
    return out.str();
}

}  // namespace

TEST_CASE("every key of the documented example is read to the value it has in the file") {
    const Scene scene = scene_of(tests::kExampleScene);
    CHECK(scene.name == "one-tree");
    CHECK(scene.origin.latitude.value == 47.2602);
    CHECK(scene.origin.longitude.value == 11.3439);
    CHECK(scene.origin.altitude == 581.0);
    CHECK(scene.sun.azimuth.value == 140.0);
    CHECK(scene.sun.elevation.value == 40.0);
    CHECK(scene.sun.ambient == 0.3);
    CHECK(scene.sky.horizon == Colour(0.62, 0.72, 0.82));
    CHECK(scene.sky.zenith == Colour(0.18, 0.34, 0.62));
    REQUIRE(scene.haze);
    CHECK(scene.haze->visibility == 20000.0);
    CHECK(scene.haze->colour == Colour(0.62, 0.72, 0.82));
    REQUIRE(scene.ground);
    CHECK(scene.ground->paint.colour == Colour(0.25, 0.33, 0.14));
    CHECK(scene.ground->paint.texture == 0U);
    CHECK(scene.ground->paint.texture_weight == 0.6);
    CHECK_FALSE(scene.ground->paint.translucence);
    REQUIRE(scene.cloud_decks.size() == 1);
    CHECK(scene.cloud_decks[0].altitude == 2000.0);
    CHECK(scene.cloud_decks[0].paint.texture == 1U);
    REQUIRE(scene.cloud_decks[0].paint.translucence);
    CHECK(scene.cloud_decks[0].paint.translucence->softness == 0.2);

    REQUIRE(scene.textures.size() == 3);
    const Texture& grass = scene.textures[0];
    REQUIRE(grass.terms.size() == 3);
    CHECK(grass.terms[1].coefficient == 0.707);
    CHECK(grass.terms[1].frequency == 0.11);
    CHECK(grass.terms[1].phase == 1.9);
    CHECK(scene.textures[1].drift == glm::dvec2(3.0, -4.0));
    CHECK(scene.textures[2].vertical == 0.75);

    REQUIRE(scene.objects.size() == 3);
    const auto& tree = std::get<Ellipsoid>(scene.objects[0].shape);
    CHECK(tree.centre.metres == glm::dvec3(0.0, 100.0, 6.0));
    CHECK(tree.semi_axes == glm::dvec3(4.0, 4.0, 6.0));
    CHECK(tree.attitude.heading.value == 0.0);
    REQUIRE(scene.objects[0].planes.size() == 1);
    CHECK(scene.objects[0].planes[0].coefficients == std::array{0.0, 0.0, 1.0, -1.0});
    CHECK(scene.objects[0].paint.texture == 2U);
    REQUIRE(scene.objects[0].paint.translucence);
    CHECK(scene.objects[0].paint.translucence->threshold == 0.12);
    CHECK(scene.objects[0].paint.translucence->limb_threshold == 0.45);
    const auto& hill = std::get<Hill>(scene.objects[1].shape);
    CHECK(hill.apex.metres == glm::dvec3(500.0, 900.0, 120.0));
    CHECK(hill.radius_of_curvature == 200.0);
    CHECK(hill.slope == 0.5);
    const auto& quadric = std::get<GeneralQuadric>(scene.objects[2].shape);
    CHECK(quadric.coefficients == std::array{1.0, 1.0, 1.0, 0.0, 0.0, 0.0, -2.0, 0.0, 0.0, -3.0});
    CHECK(scene.objects[2].paint.texture_weight == 0.0);
}

TEST_CASE("an empty file is an empty scene under the default sky") {
    const Scene scene = scene_of("");
    CHECK(scene.objects.empty());
    CHECK_FALSE(scene.ground);
    CHECK_FALSE(scene.haze);
    CHECK(scene.sky.zenith == Sky{}.zenith);
    CHECK(scene.sun.ambient == Sun{}.ambient);
}

TEST_CASE("an ellipsoid's attitude is heading, pitch and roll") {
    const Scene scene =
        scene_of("[[object]]\nellipsoid = { centre = [0, 0, 0], semi_axes = [1, 2, 3], attitude = [350, -5, 12.5] }\n");
    const auto& ellipsoid = std::get<Ellipsoid>(scene.objects.at(0).shape);
    CHECK(ellipsoid.attitude.heading.value == 350.0);
    CHECK(ellipsoid.attitude.pitch.value == -5.0);
    CHECK(ellipsoid.attitude.roll.value == 12.5);
    CHECK(ellipsoid.semi_axes == glm::dvec3(1.0, 2.0, 3.0));
}

TEST_CASE("a texture may stand after the object that wears it, and haze without a colour takes the horizon's") {
    const Scene scene = scene_of(R"(
object = [ { ellipsoid = { centre = [0, 0, 0], semi_axes = [1, 1, 1] }, texture = "bark" } ]
haze = { visibility = 5000 }
sky = { horizon = [0.1, 0.2, 0.3] }
texture = [ { name = "bark", coefficients = [1], frequencies = [2], phases = [0] } ]
)");
    CHECK(scene.objects.at(0).paint.texture == 0U);
    CHECK(scene.haze.value().colour == Colour(0.1, 0.2, 0.3));
}

TEST_CASE("haze without a visibility is no haze, and keeps its colour when written and read again") {
    const Scene scene = scene_of("[haze]\ncolour = [0.1, 0.2, 0.3]\n");
    CHECK(scene.haze.value().visibility == std::numeric_limits<double>::infinity());
    CHECK(scene.haze->colour == Colour(0.1, 0.2, 0.3));
    CHECK_THAT(config::summary(scene), Catch::Contains("haze:        none"));
    std::ostringstream text;
    config::write_scene(scene, text);
    const Scene again = scene_of(text.str());
    CHECK(again.haze.value().visibility == scene.haze->visibility);
    CHECK(again.haze->colour == scene.haze->colour);
}

TEST_CASE("a scene that is written and read again is the same, bit for bit") {
    const auto seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-1e5, 1e5), positive(1e-3, 1e3), fraction(0.0, 1.0), turn(-360.0, 360.0);
    const auto vector = [&](auto& distribution) {
        return glm::dvec3(distribution(random), distribution(random), distribution(random));
    };
    Scene scene = scene_of(tests::kExampleScene);
    scene.name = "quotes \" and \\, a tab\t, a line\nand \x7f";
    scene.haze->visibility = positive(random);
    for (int i = 0; i < 100; ++i) {
        Object object = scene.objects[static_cast<std::size_t>(i) % 3];
        object.name = "copy " + std::to_string(i);
        object.paint.colour = vector(fraction);
        object.planes.push_back({{any(random), any(random), any(random), any(random)}});
        if (auto* ellipsoid = std::get_if<Ellipsoid>(&object.shape)) {
            *ellipsoid = {{vector(any)}, vector(positive), {{turn(random)}, {turn(random)}, {turn(random)}}};
        } else if (auto* hill = std::get_if<Hill>(&object.shape)) {
            *hill = {{vector(any)}, positive(random), positive(random)};
        } else {
            std::get<GeneralQuadric>(object.shape).coefficients[9] = any(random);
        }
        scene.objects.push_back(object);
    }
    const std::string text = written(scene);
    const Scene again = scene_of(text);
    CHECK(written(again) == text);
    CHECK(again.name == scene.name);
    REQUIRE(again.objects.size() == scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object &a = scene.objects[i], &b = again.objects[i];
        CHECK(a.name == b.name);
        CHECK(a.paint.colour == b.paint.colour);
        REQUIRE(a.planes.size() == b.planes.size());
        for (std::size_t j = 0; j < a.planes.size(); ++j) CHECK(a.planes[j].coefficients == b.planes[j].coefficients);
        REQUIRE(a.shape.index() == b.shape.index());
        if (const auto* ellipsoid = std::get_if<Ellipsoid>(&a.shape)) {
            CHECK(ellipsoid->semi_axes == std::get<Ellipsoid>(b.shape).semi_axes);
            CHECK(ellipsoid->attitude.roll == std::get<Ellipsoid>(b.shape).attitude.roll);
        }
    }
}

TEST_CASE("a scene's summary counts its objects by kind and gives their extents") {
    const std::string text = config::summary(scene_of(tests::kExampleScene));
    INFO(text);
    CHECK_THAT(text, Catch::Contains("3 (1 ellipsoid, 1 hill, 1 general quadric); 1 textured, 1 translucent"));
    CHECK_THAT(text, Catch::Contains("2, at most 1 on one object"));
    CHECK_THAT(text, Catch::Contains("east -4.0 to 500.0 m, north 96.0 to 900.0 m, up 0.0 to 120.0 m"));
    CHECK_THAT(text, Catch::Contains("grass 3 terms, overcast 2 terms, leaves 1 term"));
    CHECK_THAT(config::summary(scene_of("")), Catch::Contains("objects:     0"));
}

TEST_CASE("a turned ellipsoid's extents are those of its turned box") {
    // Turned by 90 degrees, what was 5 m to the right reaches 5 m north and south.
    const std::string text = config::summary(
        scene_of("[[object]]\nellipsoid = { centre = [10, 20, 30], semi_axes = [5, 1, 2], heading = 90 }\n"));
    CHECK_THAT(text, Catch::Contains("east 9.0 to 11.0 m, north 15.0 to 25.0 m, up 28.0 to 32.0 m"));
}

TEST_CASE("ten thousand objects are read") {
    std::ostringstream text;
    for (int i = 0; i < 10'000; ++i) {
        text << "[[object]]\nname = \"tree " << i << "\"\nellipsoid = { centre = [" << i
             << ", 0, 5], semi_axes = [2, 2, 5] }\n";
    }
    CHECK(scene_of(text.str()).objects.size() == 10'000);
}

TEST_CASE("whole numbers beyond 2^53 and beyond 64 bits are written, and read, as the doubles they are") {
    const std::string object = "[[object]]\nquadric = [1, 1, 1, 0, 0, 0, 0, 0, 0, ";
    const auto last_of = [](const Scene& scene) {
        return std::get<GeneralQuadric>(scene.objects[0].shape).coefficients[9];
    };
    CHECK(last_of(scene_of(object + "-32780845704879416]\n")) == -32780845704879416.0);
    for (const double number : {-32780845704879416.0, -35887218674741891072.0, -7.0, 0.0, -1e50}) {
        Scene scene = scene_of(object + "-1]\n");
        std::get<GeneralQuadric>(scene.objects[0].shape).coefficients[9] = number;
        CHECK(last_of(scene_of(written(scene))) == number);
    }
}
