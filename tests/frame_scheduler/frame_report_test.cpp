#include "frame_scheduler/frame_report.h"

#include <catch2/catch.hpp>
#include <set>
#include <sstream>

using namespace quadrig;
using namespace quadrig::scheduler;
using namespace std::chrono_literals;

namespace {

FrameReport sample_report() {
    FrameRecord record;
    record.frames = 3600;
    record.deadline_misses = 2;
    record.repeated_frames = 3;
    for (int i = 1; i <= 1000; ++i) record.frame.record(std::chrono::microseconds(10 * i));
    record.stages[3].record(4ms);
    record.latency.record(12500us);
    FrameReport report;
    add_record(report, record);
    report.version = "0.1.0";
    report.machine = {"A processor", 2, "AVX3_DL", 2, "Release"};
    report.width = 1280;
    report.height = 720;
    report.rate_hz = 60.0;
    report.real_time = true;
    report.timer_late.max = 80us;
    report.quality["default"] = 3600;
    report.links.push_back({{"url", "cigi://127.0.0.1:8004"},
                            {"datagrams", 3601},
                            {"frames", 3600},
                            {"packets", {{"ig_control", 3600}}},
                            {"rejected", {{"truncated", 1}, {"bad_size", 0}}},
                            {"lost", 4},
                            {"duplicate", 0},
                            {"reordered", 0}});
    report.sinks.push_back({"png:\xff out", 3500, 100, 0, "the disk is full"});
    report.hash = "00000000000000ab";
    report.frame_hashes = {"0000000000000001", "0000000000000002"};
    return report;
}

}  // namespace

TEST_CASE("The report has the keys and values that programs rely on") {
    const auto json = nlohmann::json::parse(json_text(sample_report()));
    CHECK(json["quadrig"] == "0.1.0");
    CHECK(json["schema"] == 1);
    CHECK(json["machine"] ==
          nlohmann::json(
              {{"cpu", "A processor"}, {"cores", 2}, {"simd", "AVX3_DL"}, {"threads", 2}, {"build", "Release"}}));
    CHECK(json["image"] == nlohmann::json({{"width", 1280}, {"height", 720}}));
    CHECK(json["rate_hz"] == 60.0);
    CHECK(json["frames"] == 3600);
    CHECK(json["deadline_misses"] == 2);
    CHECK(json["repeated_frames"] == 3);
    CHECK(json["frame_ms"]["min"] == 0.01);
    CHECK(json["frame_ms"]["max"] == 10.0);
    CHECK(json["frame_ms"]["p50"].get<double>() == Approx(5.0).epsilon(1e-3));
    CHECK(json["frame_ms"]["p90"].get<double>() == Approx(9.0).epsilon(1e-3));
    CHECK(json["frame_ms"]["p99"].get<double>() == Approx(9.9).epsilon(1e-3));
    CHECK(json["frame_ms"]["p999"].get<double>() == Approx(9.99).epsilon(1e-3));
    CHECK(json["stage_ms"]["shade"]["p50"] == 4.0);
    CHECK(json["latency_ms"]["max"] == 12.5);
    CHECK(json["timer_late_ms"]["max"] == 0.08);
    CHECK(json["quality"] == nlohmann::json({{"default", 3600}}));
    CHECK(json["links"][0]["url"] == "cigi://127.0.0.1:8004");
    CHECK(json["sinks"][0]["frames"] == 3500);
    CHECK(json["sinks"][0]["dropped"] == 100);
    CHECK(json["hash"] == "00000000000000ab");
    CHECK(json["frame_hashes"].size() == 2);
    const std::set<std::string> keys{"min", "p50", "p90", "p99", "p999", "max"};
    for (const char* figure : {"frame_ms", "latency_ms", "timer_late_ms"}) {
        std::set<std::string> found;
        for (const auto& [key, value] : json[figure].items()) found.insert(key);
        CHECK(found == keys);
    }
    for (const char* stage : {"select", "outline", "sweep", "shade", "present"})
        CHECK(json["stage_ms"][stage].size() == 6);
}

TEST_CASE("A run without frames reports zeros and empty lists, not nulls") {
    const auto json = nlohmann::json::parse(json_text(FrameReport{}));
    CHECK(json["frames"] == 0);
    CHECK(json["frame_ms"]["p999"] == 0.0);
    CHECK(json["links"].is_array());
    CHECK(json["sinks"].is_array());
    CHECK(json["frame_hashes"].is_array());
    CHECK(json["quality"].is_object());
}

TEST_CASE("The summary names what went wrong, and fits a terminal") {
    FrameReport report = sample_report();
    const std::string text = summary(report);
    for (const char* part :
         {"3600 frames of 1280x720 at 60 Hz", "2 deadline misses", "3 repeated", "- shade", "timer late", "lost 4",
          "ig_control 3600", "truncated 1", "3500 frames, 100 dropped", "the disk is full", "hash 00000000000000ab"})
        CHECK_THAT(text, Catch::Contains(part));
    CHECK_THAT(text, !Catch::Contains("bad_size"));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);
    report.real_time = false;
    CHECK_THAT(summary(report), !Catch::Contains("timer late"));
}

TEST_CASE("The machine is described") {
    const Machine machine = this_machine();
    CHECK(machine.cores >= 1);
    CHECK_FALSE(machine.cpu.empty());
    CHECK_FALSE(machine.build.empty());
}
