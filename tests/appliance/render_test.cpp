#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "display/png_file.h"
#include "ig_core/scene/scene.h"
#include "tests/appliance/files.h"
#include "tests/appliance/program.h"

using namespace quadrig;
using namespace quadrig::tests;

namespace {

struct Still {
    display::Picture picture;
    Plane<std::int32_t> objects, surfaces;
    Plane<double> depth;
};

Still still(const std::string& scene, Arguments more) {
    const auto out = scratch_directory();
    Arguments arguments{"render",      scene,           "-o",          out / "p.png", "--object-ids",
                        out / "o.npy", "--surface-ids", out / "s.npy", "--depth",     out / "d.npy"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = quadrig_program(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    return {display::read_png(out / "p.png"), read_int32_plane(out / "o.npy"), read_int32_plane(out / "s.npy"),
            read_float64_plane(out / "d.npy")};
}

}  // namespace

TEST_CASE("A still picture and its planes are those of the reference, by every option of render") {
    const std::string scene = scratch_file("scene.toml", small_scene());
    const Arguments view{"--eye",  "-12.5,-.5,14", "--attitude=-3,-2.5,8", "--size", "160x120", "--fov", "65",
                         "--time", "7.5"};
    Arguments exact = view;
    exact.insert(exact.end(), {"--reference", "--samples", "3"});
    const Still fast = still(scene, view), reference = still(scene, exact);

    CHECK(fast.objects.rows == 120);
    CHECK(fast.objects.columns == 160);
    CHECK(fast.objects.values == reference.objects.values);
    CHECK(fast.surfaces.values == reference.surfaces.values);
    REQUIRE(fast.depth.values.size() == reference.depth.values.size());
    int depths = 0;
    for (std::size_t i = 0; i < fast.depth.values.size(); ++i) {
        const double exact_depth = reference.depth.values[i];
        if (std::isinf(exact_depth)) {
            CHECK(fast.depth.values[i] == exact_depth);
            continue;
        }
        ++depths;
        if (std::abs(fast.depth.values[i] / exact_depth - 1.0) > 1e-5) CHECK(fast.depth.values[i] == exact_depth);
    }
    CHECK(depths > 1000);
    for (const std::int32_t id : {kSkyId, kGroundId, 0, 1, 2, 3})
        CHECK(std::count(fast.objects.values.begin(), fast.objects.values.end(), id) > 20);
    const Difference apart = difference(fast.picture, reference.picture);
    CHECK(apart.mean < 1.0);
    CHECK(apart.mean > 0.0);  // or --reference would do nothing
}

TEST_CASE("A sphere straight ahead is where it is said to be") {
    const std::string scene =
        scratch_file("sphere.toml", "[[object]]\nellipsoid = { centre = [40, -30, 5], semi_axes = [10, 10, 10] }\n");
    // From (0, -30, 5) it lies due east, 40 m away.
    const Still seen = still(scene, {"--eye", "0,-30,5", "--attitude", "90,0,0", "--size", "101x51", "--fov", "60"});
    CHECK(seen.objects.rows == 51);
    CHECK(seen.objects.columns == 101);
    CHECK(seen.depth.at(25, 50) == Approx(30.0).epsilon(1e-12));
    // The limb is asin(10 / 40) off the axis.
    const double radius = std::tan(std::asin(0.25)) / std::tan(30.0 * M_PI / 180.0) * 50.5;
    for (int row = 0; row < 51; ++row)
        for (int column = 0; column < 101; ++column)
            CHECK(seen.objects.at(row, column) == (std::hypot(column - 50, row - 25) < radius ? 0 : kSkyId));
    CHECK(std::isinf(seen.depth.at(0, 0)));
}

TEST_CASE("An empty file is a picture of the sky") {
    const Still seen = still(scratch_file("empty.toml", ""),
                             {"--eye", "0,0,2", "--attitude", "0,0,0", "--size", "32x24", "--fov", "60"});
    for (const std::int32_t id : seen.objects.values) CHECK(id == kSkyId);
    // At the top of the picture the sky is the darker zenith's.
    CHECK(seen.picture.pixels[0] < seen.picture.pixels[seen.picture.pixels.size() - 4]);
}

TEST_CASE("Ten thousand objects are drawn, each one where it stands") {
    std::ostringstream text;
    for (int i = 0; i < 10000; ++i)
        text << "[[object]]\nellipsoid = { centre = [" << 10 * (i % 100) << ", " << 10 * (i / 100)
             << ", 0], semi_axes = [3, 3, 3] }\n";
    // Straight down, as a map: object i is at column, row of its place.
    const Still seen =
        still(scratch_file("many.toml", text.str()), {"--eye", "495,495,5000", "--attitude", "0,-90,0", "--size",
                                                      "300x300", "--fov", "11.421186274999286"});  // 2 atan(500 / 5000)
    int found = 0;
    for (int i = 0; i < 10000; ++i) found += seen.objects.at(298 - 3 * (i / 100), 1 + 3 * (i % 100)) == i;
    CHECK(found == 10000);
}

TEST_CASE("Each output can be asked for alone") {
    const std::string scene = scratch_file("scene.toml", small_scene());
    for (const char* option : {"-o", "--output", "--object-ids", "--surface-ids", "--depth"}) {
        for (const bool reference : {false, true}) {
            const auto out = scratch_directory();
            Arguments arguments{"render", scene,   "--eye", "0,0,8", "--attitude", "0,0,0",
                                "--size", "16x12", "--fov", "60",    option,       out / "file"};
            if (reference) arguments.emplace_back("--reference");
            CHECK(quadrig_program(arguments).status == 0);
            CHECK(std::distance(std::filesystem::directory_iterator(out), {}) == 1);
            CHECK(std::filesystem::file_size(out / "file") > 100);
        }
    }
}

TEST_CASE("A better quality comes closer to the reference") {
    const std::string scene = scratch_file("scene.toml", small_scene());
    const auto picture = [&](const Arguments& more) {
        Arguments arguments{"--eye", "0,0,14", "--attitude", "0,0,11", "--size", "160x120", "--fov", "60"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return still(scene, arguments).picture;
    };
    const auto exact = picture({"--reference", "--samples", "8"});
    const double draft = difference(picture({"--quality", "draft"}), exact).mean;
    const double usual = difference(picture({}), exact).mean;
    CHECK(difference(picture({"--quality", "default"}), exact).mean == usual);
    CHECK(usual < draft);
}
