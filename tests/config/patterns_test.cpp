#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <set>

#include "config/config_directory.h"
#include "config/scene_file.h"
#include "config/texture_section.h"
#include "tests/config/temporary_file.h"

using namespace quadrig;
using tests::scene_of;
using tests::TemporaryFile;

namespace {

const Texture& pattern(const std::string& name) {
    static const std::vector<Texture> all = config::read_patterns();
    for (const Texture& each : all)
        if (each.name == name) return each;
    throw std::runtime_error("no pattern " + name);
}

bool same_terms(const Texture& a, const Texture& b, double scale = 1.0) {
    bool same = a.terms.size() == b.terms.size();
    for (std::size_t i = 0; same && i < a.terms.size(); ++i)
        same = a.terms[i].coefficient == b.terms[i].coefficient && a.terms[i].phase == b.terms[i].phase &&
               a.terms[i].frequency == b.terms[i].frequency / scale;
    return same;
}

/// The directory of patterns is another one as long as this lives.
struct OtherDirectory {
    explicit OtherDirectory(const std::filesystem::path& path) { setenv("QUADRIG_CONFIG_DIR", path.c_str(), 1); }
    ~OtherDirectory() { unsetenv("QUADRIG_CONFIG_DIR"); }
};

}  // namespace

TEST_CASE("the patterns have 3 to 7 sines that about double in frequency and fall by about 0.7") {
    std::set<std::string> names;
    for (const Texture& each : config::read_patterns()) {
        INFO(each.name);
        names.insert(each.name);
        CHECK(each.terms.size() >= 3);
        for (std::size_t i = 1; i < each.terms.size(); ++i) {
            const TextureTerm &before = each.terms[i - 1], &term = each.terms[i];
            CHECK(term.frequency / before.frequency > 1.8);
            CHECK(term.frequency / before.frequency < 2.7);
            CHECK(term.coefficient / before.coefficient > 0.55);
            CHECK(term.coefficient / before.coefficient < 0.85);
        }
    }
    CHECK(names.size() >= 10);
    for (const char* name :
         {"foliage", "needles", "grass", "field", "rock", "snow", "water", "sand", "cumulus", "stratus", "smoke"})
        CHECK(names.count(name) == 1);
    for (const char* upright : {"foliage", "needles", "rock", "cumulus", "smoke"})
        CHECK(pattern(upright).vertical >= 0.5);
}

TEST_CASE("a scene names a pattern, and gets it once and only if it does") {
    const Scene scene = scene_of(
        "[ground]\ntexture = \"grass\"\n[[cloud_deck]]\naltitude = 9\ntexture = \"stratus\"\n"
        "[[object]]\nellipsoid = { centre = [0, 0, 0], semi_axes = [1, 1, 1] }\n"
        "texture = \"grass\"\n");
    REQUIRE(scene.textures.size() == 2);
    CHECK(same_terms(scene.textures[0], pattern("grass")));
    CHECK(scene.textures[1].drift == pattern("stratus").drift);
    CHECK(scene.ground->paint.texture == 0U);
    CHECK(scene.objects[0].paint.texture == 0U);
    CHECK(scene_of("").textures.empty());
}

TEST_CASE("a scene's own texture goes before the pattern of its name, and may be a pattern made larger") {
    const Scene own = scene_of(
        "[ground]\ntexture = \"grass\"\n[[texture]]\nname = \"grass\"\ncoefficients = [1]\n"
        "frequencies = [3]\nphases = [0]\n");
    REQUIRE(own.textures.size() == 1);
    CHECK(own.textures[0].terms[0].frequency == 3.0);
    const Scene scaled = scene_of(
        "[[texture]]\nname = \"leaves\"\npattern = \"foliage\"\nscale = 2.5\ndrift = [1, 2]\n"
        "[[texture]]\nname = \"swell\"\npattern = \"water\"\nvertical = 0.5\n");
    CHECK(same_terms(scaled.textures[0], pattern("foliage"), 2.5));
    CHECK(scaled.textures[0].vertical == pattern("foliage").vertical);
    CHECK(scaled.textures[0].drift == glm::dvec2(1, 2));
    CHECK(same_terms(scaled.textures[1], pattern("water")));
    CHECK(scaled.textures[1].vertical == 0.5);
    CHECK(scaled.textures[1].drift == pattern("water").drift);
}

TEST_CASE("mistakes about patterns are refused") {
    const auto complaint = [](const std::string& text) {
        try {
            scene_of("[[texture]]\nname = \"a\"\n" + text);
        } catch (const config::FileError& error) {
            return error.key() + ": " + error.what();
        }
        return std::string("accepted");
    };
    using Catch::Contains;
    CHECK_THAT(complaint("pattern = \"folage\"\n"), Contains("texture[0].pattern") && Contains("found \"folage\""));
    CHECK_THAT(complaint("pattern = \"foliage\"\nphases = [1]\n"),
               Contains("texture[0].phases") && Contains("found both"));
    CHECK_THAT(complaint("pattern = \"foliage\"\nscale = 0\n"), Contains("texture[0].scale"));
    CHECK_THAT(complaint("scale = 2\n"), Contains("texture[0].scale") && Contains("a pattern beside it"));
}

TEST_CASE("patterns are looked for where QUADRIG_CONFIG_DIR says; a mistake in them is theirs") {
    const TemporaryFile marker("");
    const std::filesystem::path directory = marker.path().string() + ".d";
    std::filesystem::create_directory(directory);
    {
        const OtherDirectory other(directory);
        CHECK(config::read_patterns().empty());
        CHECK_THROWS_WITH(scene_of("[ground]\ntexture = \"grass\"\n"),
                          Catch::Contains("no patterns in " + directory.string()));
        std::ofstream(directory / "patterns.toml")
            << "[[texture]]\nname = \"moss\"\ncoefficients = [1]\nfrequencies = [2]\n";
        CHECK_THROWS_WITH(scene_of("[ground]\ntexture = \"moss\"\n"),
                          Catch::Contains("patterns.toml:1: key 'texture[0].phases'"));
        std::ofstream(directory / "patterns.toml", std::ios::app) << "phases = [0]\n";
        CHECK(scene_of("[ground]\ntexture = \"moss\"\n").textures[0].terms[0].frequency == 2.0);
    }
    std::filesystem::remove_all(directory);
    CHECK(config::read_patterns().size() >= 10);
}
