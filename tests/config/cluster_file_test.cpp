#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <sstream>

#include "config/scene_file.h"
#include "tests/config/temporary_file.h"

using namespace quadrig;
using tests::TemporaryFile;

namespace {

const std::string kClusters = R"([[texture]]
name = "leaves"
coefficients = [1.0]
frequencies = [0.9]
phases = [0.3]
[[object]]
name = "stone-1"
ellipsoid = { centre = [0, 0, 0], semi_axes = [1, 1, 1] }
[[cluster]]
name = "hill"
seed = 3
terrain = true
region = { ellipse = { centre = [0.0, 900.0], semi_axes = [800.0, 500.0] } }
spacing = 300.0
abutting = 4
variation = { position = 0.3, size = 0.25 }
[[cluster.template]]
hill = { apex = [0.0, 0.0, 90.0], radius_of_curvature = 300.0, slope = 0.5 }
planes = [[0.0, 0.0, 1.0, 0.0]]
[[cluster]]
name = "copse"
region = { polygon = [[-20, -20], [20, -20], [0, 25]] }
spacing = 9.0
variation = { position = 0.4, size = 0.3, shape = 0.2, colour = 0.3, altitude = 0.1, attitude = [180, 5, 5] }
[[cluster.template]]
ellipsoid = { centre = [0.0, 0.0, 4.8], semi_axes = [4.2, 4.2, 6.0] }
colour = [0.13, 0.27, 0.07]
texture = "leaves"
translucence = { threshold = 0.08 }
[[cluster]]
name = "wood"
region = { path = [[-300, 100], [0, 300], [500, 200]], width = 150 }
spacing = 120
count = 9
elevation = [0, 60]
[[cluster.template]]
cluster = "copse"
weight = 2.5
[[cluster]]
name = "cloud"
region = { rectangle = [-500, 0, 500, 2000] }
spacing = 400
altitude = 900
[[cluster.template]]
ellipsoid = { centre = [0, 0, 0], semi_axes = [90, 60, 30] }
)";

struct ClusterMistake {
    std::string original, replacement, key, complaint;
};
const std::vector<ClusterMistake> kClusterMistakes{
    {"seed = 3", "sed = 3", "cluster[0].sed", "unknown key"},
    {"seed = 3", "seed = 0.5", "cluster[0].seed", "expected a whole number in 0..9007199254740991, found 0.5"},
    {"terrain = true", "terrain = 1", "cluster[0].terrain", "expected true or false, found 1"},
    {"name = \"wood\"", "# none", "cluster[2].name", "expected this key"},
    {"name = \"wood\"", "name = \"hill\"", "cluster[2].name", "\"hill\", which cluster[0] has"},
    {"name = \"wood\"", "name = \"stone\"", "", ""},
    {"name = \"cloud\"", "name = \"stone\"", "", "found \"stone-1\", which object[0] has"},
    {"{ polygon = [[-20, -20], [20, -20], [0, 25]] }", "{ polygon = [[-20, -20], [20, -20]] }",
     "cluster[1].region.polygon", "at least 3 points"},
    {"rectangle = [-500, 0, 500, 2000]", "rectangle = [500, 0, -500, 2000]", "cluster[3].region.rectangle",
     "west beyond east"},
    {"rectangle = [-500, 0, 500, 2000]", "circle = 5", "cluster[3].region.circle", "unknown key"},
    {"{ rectangle = [-500, 0, 500, 2000] }", "{}", "cluster[3].region", "found none"},
    {"{ rectangle = [", "{ width = 3, rectangle = [", "cluster[3].region.width", "a path beside it"},
    {"{ rectangle = [", "{ path = [[0, 0], [1, 1]], rectangle = [", "cluster[3].region", "found more"},
    {"spacing = 120", "spacing = 0", "cluster[2].spacing", "expected metres in 1e-3..1e9, found 0"},
    {"spacing = 120", "# none", "cluster[2].spacing", "expected this key"},
    {"count = 9", "count = 0", "cluster[2].count", "expected a whole number in 1..1000000, found 0"},
    {"elevation = [0, 60]", "elevation = [60, 0]", "cluster[2].elevation", "the lowest above the highest"},
    {"size = 0.25", "size = 1.0", "cluster[0].variation.size", "expected a share in 0..0.9, found 1"},
    {"size = 0.25", "shape = 0.25", "cluster[0].abutting", "no variation of shape"},
    {"altitude = 900", "altitude = 900\nabutting = 3\nvariation = { attitude = [0, 0, 1] }", "cluster[3].abutting",
     "no variation of attitude"},
    {"altitude = 900", "terrain = true", "cluster[3].terrain", "hills as templates, found an ellipsoid"},
    {"weight = 2.5", "weight = 0", "cluster[2].template[0].weight", "expected a number above 0"},
    {"weight = 2.5", "colour = [1, 1, 1]", "cluster[2].template[0].colour", "a shape or a cluster, found both"},
    {"cluster = \"copse\"", "cluster = \"cloud\"", "cluster[2].template[0].cluster", "a cluster before this one"},
    {"cluster = \"copse\"", "cluster = \"wood\"", "cluster[2].template[0].cluster", "a cluster before this one"},
    {"texture = \"leaves\"", "texture = \"no-such\"", "cluster[1].template[0].texture", "found \"no-such\""},
    {"planes = [[0.0, 0.0, 1.0, 0.0]]", "planes = [[0, 0, 1, 0], [0, 0, 1e20, 0]]", "cluster[0].template[0].planes[1]",
     "B1..B3 of 1e-9..1e9"},
    {"ellipsoid = { centre = [0, 0, 0], semi_axes = [90, 60, 30] }\n", "quadric = [1, 1, 1, 0, 0, 0, 0, 0, 0, -1]\n",
     "cluster[3].template[0].quadric", "unknown key"},
    {"[[cluster.template]]\nellipsoid = { centre = [0, 0, 0], semi_axes = [90, 60, 30] }\n", "", "cluster[3]",
     "at least one [[cluster.template]]"},
    {"spacing = 400", "spacing = 0.1", "cluster[3]", "more than 16000000 places to try"},
};

/// Where an original text occurs more than once, the last place counts.
std::string with(const ClusterMistake& mistake) {
    std::string text = kClusters;
    const std::size_t position = text.rfind(mistake.original);
    REQUIRE(position != std::string::npos);
    return text.replace(position, mistake.original.size(), mistake.replacement);
}

std::string written(const Scene& scene) {
    std::ostringstream out;
    config::write_scene(scene, out);
    return out.str();
}

Scene bench_scene(const std::string& name) {
    return config::read_scene(QUADRIG_SOURCE_DIR "/config/scenes/bench/" + name + ".toml");
}

/// FNV-1a, 64 bits.
std::uint64_t hash_of(const std::string& text) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    return hash;
}

struct Kind {
    std::size_t objects = 0, fewest_planes = 99, most_planes = 0, translucent = 0, textured = 0;
};
Kind kind_of(const Scene& scene, const std::string& name) {
    Kind kind;
    for (const Object& object : scene.objects) {
        if (!object.name.starts_with(name + "-")) continue;
        ++kind.objects;
        kind.fewest_planes = std::min(kind.fewest_planes, object.planes.size());
        kind.most_planes = std::max(kind.most_planes, object.planes.size());
        kind.translucent += object.paint.translucence ? 1 : 0;
        kind.textured += object.paint.texture && scene.textures[*object.paint.texture].terms.size() == 7 ? 1 : 0;
    }
    return kind;
}

}  // namespace

TEST_CASE("every mistake in a cluster is refused with file, line, key, what was expected and what was found") {
    for (const ClusterMistake& mistake : kClusterMistakes) {
        const TemporaryFile file(with(mistake));
        CAPTURE(mistake.original, mistake.replacement);
        if (mistake.complaint.empty()) {
            CHECK_NOTHROW(config::read_scene(file.path()));
            continue;
        }
        std::string message, key;
        std::size_t line = 0;
        try {
            config::read_scene(file.path());
        } catch (const config::FileError& error) {
            message = error.what();
            key = error.key();
            line = error.line();
        }
        CHECK(key == mistake.key);
        CHECK(line > 0);
        CHECK_THAT(message, Catch::Contains(mistake.complaint));
    }
}

TEST_CASE("clusters eight deep are read, nine are refused") {
    std::string text =
        "[[cluster]]\nname = \"c1\"\nregion = { rectangle = [0, 0, 1, 1] }\nspacing = 9\n"
        "template = [{ ellipsoid = { centre = [0, 0, 0], semi_axes = [1, 1, 1] } }]\n";
    for (int i = 2; i <= 9; ++i) {
        text += "[[cluster]]\nname = \"c" + std::to_string(i) +
                "\"\nregion = { rectangle = [0, 0, 1, 1] }\nspacing = 9\n" + "template = [{ cluster = \"c" +
                std::to_string(i - 1) + "\" }]\n";
        const TemporaryFile file(text);
        if (i < 9)
            CHECK(config::read_scene(file.path()).objects.size() == 1);
        else
            CHECK_THROWS_WITH(config::read_scene(file.path()), Catch::Contains("at most 8 levels"));
    }
}

TEST_CASE("the expanded scene reads back as the same scene, without clusters") {
    const Scene scene = config::read_scene(TemporaryFile(kClusters).path());
    CHECK(scene.objects.size() > 100);
    CHECK(scene.objects.front().name == "stone-1");
    CHECK(scene.objects[1].name == "hill-1");
    const std::string text = written(scene);
    CHECK(text.find("[[cluster]]") == std::string::npos);
    CHECK(written(config::read_scene(TemporaryFile(text).path())) == text);
}

TEST_CASE("motion is read for objects and for all of a cluster, written back, and refused where it makes no sense") {
    const std::string moving =
        "motion = { velocity = [4, 1, 0], within = [-9, -8, 9, 8], sway = { angle = 3, period = 5 } }\n";
    const std::string egg = "ellipsoid = { centre = [0, 0, 0], semi_axes = [1, 1, 1] }\n";
    const std::string text = "[[object]]\n" + egg + moving +
                             "[[cluster]]\nname = \"c\"\nregion = { rectangle = [0, 0, 9, 9] }\nspacing = 3\n"
                             "[[cluster.template]]\n" +
                             egg + moving;
    const Scene scene = config::read_scene(TemporaryFile(text).path());
    REQUIRE(scene.objects.size() > 5);
    for (const Object& object : scene.objects) {
        REQUIRE(object.motion);
        CHECK(object.motion->velocity == glm::dvec3(4, 1, 0));
        CHECK(object.motion->within == std::array<double, 4>{-9, -8, 9, 8});
        REQUIRE(object.motion->sway);
        CHECK(object.motion->sway->angle.value == 3);
        CHECK(object.motion->sway->wavelength == 200);
    }
    const std::string expanded = written(scene);
    CHECK(written(config::read_scene(TemporaryFile(expanded).path())) == expanded);
    const auto refused = [&](const std::string& shape, const std::string& motion) {
        try {
            config::read_scene(TemporaryFile("[[object]]\n" + shape + motion).path());
        } catch (const config::FileError& error) {
            return error.key();
        }
        return std::string("accepted");
    };
    const std::string hill = "hill = { apex = [0, 0, 9], radius_of_curvature = 9, slope = 1 }\n";
    CHECK(refused(hill, "motion = { sway = { angle = 3 } }\n") == "object[0].motion.sway");
    CHECK(refused(egg, "motion = { sway = { angle = 91 } }\n") == "object[0].motion.sway.angle");
    CHECK(refused(egg, "motion = { within = [1, 0, 1, 5] }\n") == "object[0].motion.within");
    CHECK(refused(egg, "motion = { speed = 3 }\n") == "object[0].motion.speed");
    CHECK(refused("quadric = [1, 1, 1, 0, 0, 0, 0, 0, 0, -1]\n", "motion = { within = [0, 0, 1, 5] }\n") ==
          "object[0].motion.within");
}

TEST_CASE("a scene of clusters is the same world for ever: its expansion has the hash it had when it was made") {
    // A change here changes every world that somebody made with clusters. It must not happen by accident.
    CHECK(hash_of(written(config::read_scene(TemporaryFile(kClusters).path()))) == 0x621460723A80E718u);
}

TEST_CASE("the scenes for measuring hold what they say, in few lines, and load fast") {
    const Scene landscape = bench_scene("landscape");
    const Kind hills = kind_of(landscape, "hill"), trees = kind_of(landscape, "tree"),
               clouds = kind_of(landscape, "cloud");
    CHECK(hills.objects == 40);
    CHECK(hills.fewest_planes >= 4);
    CHECK(hills.most_planes <= 6);
    CHECK(hills.textured == 40);
    CHECK(trees.objects == 1500);
    CHECK(trees.translucent == 1500);
    CHECK(trees.textured == 1500);
    CHECK(clouds.objects == 40);
    CHECK(clouds.translucent == 40);
    CHECK(clouds.textured == 40);
    REQUIRE(landscape.ground);
    CHECK(landscape.ground->paint.texture);
    const std::string text = config::read_text_file(QUADRIG_SOURCE_DIR "/config/scenes/bench/landscape.toml");
    CHECK(std::count(text.begin(), text.end(), '\n') <= 60);

    const Scene small = bench_scene("trees");
    CHECK(kind_of(small, "hill").objects == 12);
    CHECK(kind_of(small, "tree").translucent == 200);
    CHECK(kind_of(small, "cloud").textured == 12);
    const Kind stones = kind_of(bench_scene("dense"), "stone");
    CHECK(stones.objects == 10000);
    CHECK(stones.textured == 10000);
    CHECK(stones.translucent == 0);
    CHECK(stones.fewest_planes == 0);
    CHECK(stones.most_planes == 6);
    const Scene wood = bench_scene("wood");
    const Kind crowns = kind_of(wood, "tree");
    CHECK(kind_of(wood, "hill").textured == 20);
    CHECK(crowns.objects == 6000);
    CHECK(crowns.translucent == 6000);
    CHECK(crowns.textured == 6000);

    auto fastest = std::chrono::duration<double>::max();
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        bench_scene("landscape");
        fastest = std::min(fastest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start));
    }
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    CHECK(fastest.count() < 6.0);
#else
    CHECK(fastest.count() < 0.3);
#endif
}
