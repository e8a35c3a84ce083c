#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "config/quality_ladder.h"
#include "tests/appliance/files.h"
#include "tests/appliance/program.h"

using namespace quadrig;
using namespace quadrig::tests;
using Catch::Contains;

namespace {

constexpr const char* kCameras =
    R"([{"eye": [0, 0, 14], "attitude": [0, 0, 11], "fov": 60}, {"eye": [0, 5, 9], "attitude": [3, 0, 0], "fov": 60}])";

/// Without a horizon, where exact pictures converge slowly.
constexpr const char* kScene =
    "[[texture]]\nname = \"leaves\"\ncoefficients = [1.0, 0.7]\nfrequencies = [0.9, 1.9]\nphases = [0.3, 2.0]\n"
    "[[object]]\nellipsoid = { centre = [0.0, 40.0, 12.0], semi_axes = [6.0, 4.0, 5.0] }\nplanes = [[0.0, 0.0, 1.0, "
    "-8.0]]\n"
    "colour = [0.2, 0.5, 0.1]\ntexture = \"leaves\"\ntexture_weight = 0.7\n"
    "[[object]]\nellipsoid = { centre = [5.0, 45.0, 13.0], semi_axes = [6.0, 6.0, 3.0] }\ncolour = [0.7, 0.2, 0.1]\n";

}  // namespace

TEST_CASE("Speed and error of every setting come as table, JSON, plot and ladder, and the ladder can be used") {
    const auto out = scratch_directory();
    const std::string scene = scratch_file("scene.toml", kScene), cameras = scratch_file("cameras.json", kCameras);
    const Outcome outcome =
        quadrig_program({"accuracy", scene, "--path", cameras, "--size", "48x36", "--runs", "3", "--json",
                         out / "a.json", "--plot", out / "a.svg", "--ladder", out / "ladder.toml"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);

    const auto json = nlohmann::json::parse(text_of(out / "a.json"));
    const auto& settings = json["settings"];
    REQUIRE(settings.size() > 20);
    CHECK(settings[0]["setting"] == "2 sub-scan lines");
    CHECK(settings[0]["cost"] == 1.0);
    double best_on_front = 0;
    for (const auto& a : settings) {
        CAPTURE(a["setting"].get<std::string>());
        CHECK(a["frame_ms"] > 0.0);
        CHECK(a["cameras"].size() == 2);
        CHECK(a["identity"]["pixels"] == 2 * 48 * 36);
        CHECK(a["picture"]["psnr_db"] > 20.0);
        CHECK(a["picture"]["worst_step"] >= a["picture"]["mean_step"]);
        CHECK_THAT(outcome.out, Contains(a["setting"].get<std::string>()));
        if (a["on_front"] == true) best_on_front = std::max(best_on_front, a["picture"]["psnr_db"].get<double>());
        // What is on the front is beaten by nothing: at least as fast and a tenth of a decibel better.
        for (const auto& b : settings)
            if (a["on_front"] == true && b["cost"] <= a["cost"])
                CHECK(b["picture"]["psnr_db"].get<double>() < a["picture"]["psnr_db"].get<double>() + 0.1);
    }
    for (const auto& a : settings) CHECK(a["picture"]["psnr_db"].get<double>() < best_on_front + 0.1);
    const auto exact = std::find_if(settings.begin(), settings.end(),
                                    [](const auto& s) { return s["setting"] == "8 sub-scan lines"; });
    CHECK((*exact)["identity"]["wrong"] == 0);

    const std::string svg = text_of(out / "a.svg");
    CHECK_THAT(svg, Contains("<svg") && Contains("</svg>") && Contains("class=\"front\""));
    std::size_t circles = 0;
    for (std::size_t at = 0; (at = svg.find("<circle ", at)) != std::string::npos; ++at) ++circles;
    CHECK(circles == settings.size());

    const config::QualityLadder ladder = config::read_quality_ladder(out / "ladder.toml");
    CHECK(ladder[config::default_step(ladder)].quality == Quality{});
    for (const config::QualityStep& step : ladder) {
        CHECK((step.psnr >= 38.0 || step.name == "default"));
        CHECK(step.cost == std::round(100 * step.cost) / 100);  // no more digits than a measurement is worth
    }
    const Outcome bench =
        quadrig_program({"bench", scene, "--path", cameras, "--size", "48x36", "--ladder", out / "ladder.toml",
                         "--quality", ladder.front().name, "--report", out / "report.json"});
    INFO(bench.err);
    CHECK(bench.status == 0);
    CHECK(report_of(out / "report.json")["quality"] == nlohmann::json({{ladder.front().name, 2}}));
}

TEST_CASE("Errors of large pictures can be told against the finest setting, which is then not measured itself") {
    const std::string scene = scratch_file("scene.toml", kScene), cameras = scratch_file("cameras.json", kCameras),
                      file = scratch_directory() / "a.json";
    Arguments arguments{"accuracy", scene, "--path", cameras, "--size",          "64x48",
                        "--runs",   "1",   "--json", file,    "--against-finest"};
    const Outcome outcome = quadrig_program(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("errors against 8 sub-scan lines, drawn twice as fine"));
    std::map<std::string, nlohmann::json> settings;
    const auto json = nlohmann::json::parse(text_of(file));
    for (const auto& setting : json["settings"]) settings[setting["setting"]] = setting;
    CHECK_FALSE(settings.contains("8 sub-scan lines, drawn twice as fine"));
    CHECK(settings["2 sub-scan lines"]["identity"]["wrong"] == 0);
    CHECK(settings["2 sub-scan lines"]["depth"] == 0.0);
    const auto psnr = [&](const char* name) { return settings[name]["picture"]["psnr_db"].get<double>(); };
    CHECK(psnr("2 sub-scan lines, drawn twice as fine") > psnr("2 sub-scan lines"));
    CHECK(psnr("2 sub-scan lines") > psnr("no antialiasing"));
    CHECK(psnr("no antialiasing") > psnr("no antialiasing, drawn half as fine"));
    arguments.insert(arguments.end(), {"--ladder", file});
    CHECK(quadrig_program(arguments).status == 2);
}

TEST_CASE("Automatic quality goes up where frames are easily done, and down where they cannot be done in time") {
    const std::string scene = scratch_file("scene.toml", small_scene()),
                      cameras = scratch_file("cameras.json", kCameras);
    const auto qualities = [&](const Arguments& more) {
        const std::string report = scratch_directory() / "report.json";
        Arguments arguments{"bench", scene,      "--path", cameras,     "--quality",
                            "auto",  "--report", report,   "--threads", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = quadrig_program(arguments);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return report_of(report)["quality"];
    };
    CHECK(qualities({"--size", "16x12", "--rate", "1", "--frames", "120"}).value("best", 0) > 20);
    CHECK(qualities({"--size", "2000x1500", "--rate", "1000", "--frames", "6"})
              .value(config::shipped_ladder().front().name, 0) == 5);
    CHECK(quadrig_program({"bench", scene, "--path", cameras, "--quality", "nice"}).status == 2);
}
