#include <catch2/catch.hpp>

#include "tests/appliance/files.h"
#include "tests/appliance/program.h"

using namespace quadrig::tests;

namespace {

nlohmann::json benched(const std::string& cameras, Arguments arguments) {
    const std::string scene = scratch_file("scene.toml", small_scene());
    const std::string report = scratch_directory() / "report.json";
    arguments.insert(arguments.begin(),
                     {"bench", scene, "--path", scratch_file("cameras.json", cameras), "--report", report});
    const Outcome outcome = quadrig_program(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::Contains("frame"));
    return report_of(report);
}

constexpr const char* kThree = R"([{"eye": [0, 0, 8], "attitude": [0, 0, 0], "fov": 60},
 {"eye": [0, 5, 9], "attitude": [3, 0, 0], "fov": 60}, {"eye": [0, 9, 9.5], "attitude": [6, 0, 10], "fov": 50}])";

}  // namespace

TEST_CASE("A benchmark goes round its camera path and reports every frame") {
    const auto report =
        benched(kThree, {"--frames", "7", "--size", "96x64", "--threads", "2", "--quality", "draft", "--rate", "1000"});
    CHECK(report["frames"] == 7);
    CHECK(report["real_time"] == false);
    CHECK(report["image"]["width"] == 96);
    CHECK(report["quality"] == nlohmann::json({{"draft", 7}}));
    CHECK(report["frame_ms"]["min"] > 0.0);
    CHECK(report["frame_ms"]["max"] >= report["frame_ms"]["p50"]);
    CHECK(report["frame_hashes"].size() == 7);
    CHECK(report["frame_hashes"][0] != report["frame_hashes"][1]);
    CHECK(benched(kThree, {"--size", "96x64"})["frames"] == 3);
}

TEST_CASE("A benchmark draws the same frames for any number of threads") {
    const auto hash = [](const char* threads) {
        return benched(kThree, {"--size", "200x150", "--threads", threads})["hash"];
    };
    const auto one = hash("1");
    CHECK(hash("2") == one);
    CHECK(hash("4") == one);
}
