#include <algorithm>
#include <catch2/catch.hpp>

#include "config/scene_file.h"
#include "tests/config/example_scene.h"
#include "tests/config/temporary_file.h"

using namespace quadrig;
using tests::TemporaryFile;

namespace {

/// The example with one text replaced by another, and what the reader has to say about it.
struct Mistake {
    std::string what;
    std::string original;  ///< must occur; the first place counts
    std::string replacement;
    std::string key;
    std::string complaint;     ///< part of the message
    std::size_t lines_on = 0;  ///< the complaint's line, counted from the one where the replacement begins
};

const std::vector<Mistake> kMistakes{
    {"an unknown key at the top", "[sun]", "[sum]", "sum", "unknown key"},
    {"an unknown key in a section", "elevation = 40.0", "elevatoin = 40.0", "sun.elevatoin",
     "expected one of azimuth, elevation, ambient"},
    {"an unknown key in an inline table", "heading = 0.0", "headng = 0.0", "object[0].ellipsoid.headng", "unknown key"},
    {"a translucent ground", "texture_weight = 0.6", "translucence = { threshold = 0 }", "ground.translucence",
     "unknown key"},
    {"a string for a number", "azimuth = 140.0", "azimuth = \"south\"", "sun.azimuth",
     "expected degrees in -360..360, found the string \"south\""},
    {"a boolean for a number", "ambient = 0.3", "ambient = true", "sun.ambient", "found true"},
    {"a date for a number", "ambient = 0.3", "ambient = 2020-01-02", "sun.ambient", "found a date or time"},
    {"a number for a string", "name = \"one-tree\"", "name = 3", "scene.name",
     "expected a string of at least one character, found 3"},
    {"a number for a table", "origin = {", "origin = 1 #", "scene.origin", "expected a table, found 1"},
    {"a number for an array", "[0.62, 0.72, 0.82]", "0.62", "sky.horizon",
     "expected an array of 3 numbers, found 0.62"},
    {"a table for an array of tables", "[[cloud_deck]]", "[cloud_deck]", "cloud_deck", "expected an array of tables"},
    {"a string in an array", "[0.62, 0.72, 0.82]", "[0.62, \"x\", 0.82]", "sky.horizon[1]", "found the string \"x\""},
    {"an array of the wrong length", "[0.62, 0.72, 0.82]", "[0.62, 0.72]", "sky.horizon", "found an array of 2"},
    {"a nan", "elevation = 40.0", "elevation = nan", "sun.elevation", "found nan"},
    {"an infinity", "altitude = 581.0", "altitude = inf", "scene.origin.altitude", "found inf"},
    {"a negative infinity in an array", "[0.0, 100.0, 6.0]", "[0.0, -inf, 6.0]", "object[0].ellipsoid.centre[1]",
     "found -inf"},
    {"a latitude beyond the pole", "47.2602", "90.5", "scene.origin.latitude",
     "expected degrees in -90..90, found 90.5"},
    {"a longitude out of range", "11.3439", "-180.25", "scene.origin.longitude", "expected degrees in -180..360"},
    {"a sun above the zenith", "elevation = 40.0", "elevation = 91", "sun.elevation", "found 91"},
    {"ambient light above 1", "ambient = 0.3", "ambient = 1.5", "sun.ambient", "expected a number in 0..1, found 1.5"},
    {"a colour below 0", "zenith  = [0.18", "zenith  = [-0.18", "sky.zenith[0]",
     "expected linear light in 0..1, found -0.18"},
    {"no visibility", "visibility = 20000.0", "visibility = 0", "haze.visibility",
     "expected a number above 0, found 0"},
    {"a ground texture that is not there", "texture = \"grass\"", "texture = \"gras\"", "ground.texture",
     "expected the name of a [[texture]] or of a pattern, found \"gras\""},
    {"an object texture that is not there", "texture = \"leaves\"", "texture = \"leafs\"", "object[0].texture",
     "found \"leafs\""},
    {"a texture weight above 1", "texture_weight = 0.6", "texture_weight = 1.01", "ground.texture_weight",
     "found 1.01"},
    {"a texture weight without texture", "colour = [0.3, 0.35, 0.2]", "texture_weight = 0.5",
     "object[1].texture_weight", "expected a texture beside it"},
    {"translucence without texture", "colour = [0.3, 0.35, 0.2]", "translucence = { threshold = 0 }",
     "object[1].translucence", "expected a texture beside it"},
    {"a cloud deck without altitude", "altitude = 2000.0", "# none", "cloud_deck[0].altitude",
     "expected this key, found none", std::size_t(-1)},
    {"a limb threshold below the threshold", "limb_threshold = 0.45", "limb_threshold = 0.11",
     "object[0].translucence.limb_threshold", "expected at least the threshold"},
    {"no softness", "softness = 0.2 ", "softness = 0.0 ", "cloud_deck[0].translucence.softness",
     "expected a number above 0, found 0"},
    {"translucence without threshold", "{ threshold = 0.12, ", "{ ", "object[0].translucence.threshold",
     "expected this key, found none"},
    {"a texture without a name", "name = \"grass\"", "# none", "texture[0].name", "expected this key, found none",
     std::size_t(-1)},
    {"a texture of empty name", "name = \"grass\"", "name = \"\"", "texture[0].name", "found the string \"\""},
    {"two textures of one name", "name = \"leaves\"", "name = \"grass\"", "texture[2].name",
     "\"grass\", which texture[0] has"},
    {"a missing array", "phases       = [0.3, 1.9, 4.0]", "# none", "texture[0].phases",
     "expected this key, found none", std::size_t(-4)},
    {"fewer frequencies than coefficients", "[0.05, 0.11, 0.21]", "[0.05, 0.11]", "texture[0].frequencies",
     "expected as many as the 3 coefficients, found an array of 2"},
    {"more phases than coefficients", "[0.3, 1.9]", "[0.3, 1.9, 2.0]", "texture[1].phases",
     "expected as many as the 2 coefficients, found an array of 3"},
    {"no coefficients", "coefficients = [1.0, 0.5]", "coefficients = []", "texture[1].coefficients",
     "expected an array of 1..7 numbers, found an array of 0"},
    {"eight coefficients", "coefficients = [1.0, 0.5]", "coefficients = [1, 1, 1, 1, 1, 1, 1, 1]",
     "texture[1].coefficients", "found an array of 8"},
    {"coefficients that add up to 0", "coefficients = [1.0, 0.5]", "coefficients = [0, 0]", "texture[1].coefficients",
     "expected a sum of at least 1e-60"},
    {"a negative coefficient", "coefficients = [1.0, 0.5]", "coefficients = [1.0, -0.5]", "texture[1].coefficients[1]",
     "expected a number in 0..1e60, found -0.5"},
    {"a frequency of 0", "[0.001, 0.0022]", "[0.001, 0]", "texture[1].frequencies[1]",
     "expected a number above 0 and at most 1e60, found 0"},
    {"a frequency whose products overflow", "[0.001, 0.0022]", "[0.001, 1e61]", "texture[1].frequencies[1]",
     "expected a number above 0 and at most 1e60, found 1e+61"},
    {"a drift whose products overflow", "[3.0, -4.0]", "[3.0, -1e61]", "texture[1].drift[1]",
     "expected a number in -1e60..1e60, found -1e+61"},
    {"a negative vertical variation", "vertical = 0.75", "vertical = -0.75", "texture[2].vertical", "found -0.75"},
    {"a drift of three numbers", "[3.0, -4.0]", "[3.0, -4.0, 0.0]", "texture[1].drift",
     "expected an array of 2 numbers"},
    {"two objects of one name", "\"hill-1\"", "\"tree-1\"", "object[1].name", "\"tree-1\", which object[0] has"},
    {"a semi-axis of 0", "semi_axes = [4.0, 4.0, 6.0]", "semi_axes = [4.0, 0.0, 6.0]",
     "object[0].ellipsoid.semi_axes[1]", "expected metres in 1e-6..1e9, found 0"},
    {"a negative semi-axis", "semi_axes = [4.0, 4.0, 6.0]", "semi_axes = [4.0, 4.0, -6.0]",
     "object[0].ellipsoid.semi_axes[2]", "found -6"},
    {"an ellipsoid without centre", "centre = [0.0, 100.0, 6.0], ", "", "object[0].ellipsoid.centre",
     "expected this key, found none"},
    {"heading and attitude", "heading = 0.0", "heading = 0.0, attitude = [0, 0, 0]", "object[0].ellipsoid.heading",
     "either heading or attitude, found both"},
    {"a level hill", "slope = 0.5", "slope = 0.0", "object[1].hill.slope", "expected a slope in 1e-6..1e6, found 0"},
    {"a hill without curvature", "radius_of_curvature = 200.0, ", "", "object[1].hill.radius_of_curvature",
     "expected this key, found none"},
    {"a quadric of nine numbers", "-2.0, 0.0, 0.0, -3.0]", "-2.0, 0.0, 0.0]", "object[2].quadric",
     "expected an array of 10 numbers, found an array of 9"},
    {"a plane of three numbers", "[[0.0, 0.0, 1.0, -1.0]]", "[[0.0, 0.0, 1.0]]", "object[0].planes[0]",
     "expected an array of 4 numbers, found an array of 3"},
    {"a plane without normal", "[[0.0, 0.0, 1.0, -1.0]]", "[[0, 0, 1, 0],\n [0, 0, 0, 1]]", "object[0].planes[1]",
     "B1, B2 or B3 of at least 1e-60", 1},
    {"planes that are numbers", "[[0.0, 0.0, 1.0, -1.0]]", "[0, 0, 1, -1]", "object[0].planes[0]",
     "expected an array of 4 numbers, found 0"},
    {"a nan in a plane", "[[0.0, 0.0, 1.0, -1.0]]", "[[0, 0, 1, 0],\n [0, 0,\n nan, 1]]", "object[0].planes[1][2]",
     "found nan", 2},
    {"no shape", "hill = {", "# hill = {", "object[1]", "expected one of ellipsoid, hill, quadric, found none",
     std::size_t(-2)},
    {"two shapes", "hill = {", "quadric = [1, 1, 1, 0, 0, 0, 0, 0, 0, -1]\nhill = {", "object[1]",
     "expected one of ellipsoid, hill, quadric, found more", std::size_t(-2)},
    {"a saddle", "quadric = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0, -2.0, 0.0, 0.0, -3.0]",
     "quadric = [1, -1, 0, 0, 0, 0, 0, 0, 1, 0]", "object[2].quadric", "one convex piece"},
};

std::size_t line_of(std::string_view text, std::size_t position) {
    return 1 + static_cast<std::size_t>(
                   std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

/// What the reader says about a text; fails where it says nothing.
config::FileError complaint_about(const std::filesystem::path& path) {
    try {
        config::read_scene(path);
    } catch (const config::FileError& error) {
        return error;
    }
    FAIL("the file was accepted");
    throw std::logic_error("unreachable");
}

}  // namespace

TEST_CASE("every mistake in a scene file is refused with file, line, key, what was expected and what was found") {
    for (const Mistake& mistake : kMistakes) {
        INFO(mistake.what);
        std::string text(tests::kExampleScene);
        const std::size_t position = text.find(mistake.original);
        REQUIRE(position != std::string::npos);
        const std::size_t line = line_of(text, position) + mistake.lines_on;
        text.replace(position, mistake.original.size(), mistake.replacement);
        const TemporaryFile file(text);
        const config::FileError error = complaint_about(file.path());
        const std::string message = error.what();
        INFO(message);
        CHECK(error.key() == mistake.key);
        CHECK(error.line() == line);
        CHECK_THAT(message, Catch::StartsWith(file.path().string() + ":" + std::to_string(line) + ": key '" +
                                              mistake.key + "': "));
        CHECK_THAT(message, Catch::Contains(mistake.complaint));
    }
}

TEST_CASE("more than the greatest number of planes is refused") {
    std::string text = "[[object]]\nellipsoid = { centre = [0, 0, 0], semi_axes = [1, 1, 1] }\nplanes = [";
    for (int i = 0; i < kMaxPlanes; ++i) text += "[0, 0, 1, 1], ";
    CHECK(config::read_scene(TemporaryFile(text + "]\n").path()).objects[0].planes.size() == std::size_t{kMaxPlanes});
    const config::FileError error = complaint_about(TemporaryFile(text + "[0, 0, 1, 1]]\n").path());
    CHECK(error.key() == "object[0].planes");
    CHECK(error.line() == 3);
    CHECK_THAT(error.what(), Catch::Contains("at most 16"));
}

TEST_CASE("a text that is not TOML is refused with its line") {
    struct Broken {
        std::string text;
        std::size_t line;
    };
    for (const auto& [text, line] : std::vector<Broken>{{"[scene\n", 1},
                                                        {"[scene]\nname = \"a\"\nname = \"b\"\n", 3},
                                                        {"[sun]\n\nazimuth = = 3\n", 3},
                                                        {"[sun]\n[sun]\n", 2},
                                                        {std::string("a = \"\0\"", 7), 1},
                                                        {std::string(100'000, '['), 1}}) {
        INFO(text.substr(0, 40));
        const config::FileError error = complaint_about(TemporaryFile(text).path());
        CHECK(error.line() == line);
        CHECK_THAT(error.what(), Catch::Contains(":" + std::to_string(line) + ": not TOML: "));
    }
}

TEST_CASE("a number beyond a double's range, which TOML has no value for, is refused with the line that it stands on") {
    const config::FileError error = complaint_about(TemporaryFile("[haze]\r\n  visibility = 1e400 \r\n").path());
    CHECK(error.line() == 2);
    CHECK_THAT(error.what(), Catch::EndsWith(", in: visibility = 1e400"));
}

TEST_CASE("whatever a file holds, the complaint about it is one line of UTF-8") {
    const auto complaint = [](const std::string& value) {
        return std::string(complaint_about(TemporaryFile("[sun]\nambient = \"" + value + "\"\n").path()).what());
    };
    CHECK_THAT(complaint("a\\nb\\u001b[31mc\\u007f"), Catch::EndsWith(R"(found the string "a\x0Ab\x1B[31mc\x7F")"));
    CHECK_THAT(complaint("\u20AC \u00B5 \U0001F333"), Catch::EndsWith("found the string \"\u20AC \u00B5 \U0001F333\""));
    // Cut between characters, wherever 40 bytes end.
    for (const std::string before : {"", "a", "ab", "abc"}) {
        std::string many = before, shown = before;
        for (int i = 0; i < 20; ++i) many += "\U0001F333";
        while (shown.size() + 4 <= 40) shown += "\U0001F333";
        CHECK_THAT(complaint(many), Catch::EndsWith("found the string \"" + shown + "...\""));
    }
    const config::FileError error = complaint_about(TemporaryFile("[sun]\n\"a\\nb\" = 1\n").path());
    CHECK(error.key() == "sun.a\nb");
    CHECK_THAT(error.what(), Catch::Contains(R"(key 'sun.a\x0Ab')"));
}

TEST_CASE("a key of very many parts is refused with its line, dots elsewhere are not counted") {
    std::string key = "a";
    for (int part = 1; part < 100'000; ++part) key += part % 2 ? ".b" : ".\"c d\"";
    for (const std::string& text :
         {key + " = 1\n", "[" + key + "]\n", "[[" + key + "]]\n", "a = { " + key + " = 1 }\n"}) {
        const config::FileError error = complaint_about(TemporaryFile("# a comment\n\n" + text).path());
        CHECK(error.line() == 3);
        CHECK_THAT(error.what(), Catch::Contains("expected keys of at most 32 parts"));
    }
    const std::string dots(1000, '.');
    CHECK_NOTHROW(
        config::read_scene(TemporaryFile("# " + dots + "\n[scene]\nname = \"\"\"\\\"" + dots + "\n\"" + dots +
                                         "\"\"\"\"\n[[object]]\nname = '" + dots +
                                         "'\nellipsoid = { centre = [0.5, 1.5, 2.5], semi_axes = [1.0, 1.0, 1.0] }\n")
                               .path()));
}

TEST_CASE("a file that cannot be read is refused by its name") {
    CHECK_THAT(complaint_about("/nowhere/scene.toml").what(),
               Catch::StartsWith("/nowhere/scene.toml: cannot be read: No such file"));
    CHECK_THAT(complaint_about(std::filesystem::temp_directory_path()).what(),
               Catch::Contains("cannot be read: Is a directory"));
    CHECK_THAT(complaint_about("/dev/zero").what(), Catch::Contains("expected at most 256 MiB"));
}
