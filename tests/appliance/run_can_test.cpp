// A live CAN bus: this machine's, or a User-mode Linux kernel's. The peers are can-utils'.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/appliance/files.h"
#include "tests/appliance/program.h"

using namespace quadrig::tests;

namespace {

constexpr int kNoBus = 77;

/// What happens on the bus, in one shell: a recorded second of flight is played to the program, and its identity asked.
constexpr const char* kScript = R"(
"$QUADRIG" run --link 'can://vcan0?node=9' --scene "$SCENE" --size 16x12 --threads 1 --frames 6000 --record "$OUT/heard.log" --report "$OUT/report.json" 2> "$OUT/err" &
quadrig=$!
for i in $(seq 200); do grep -q 'listens on interface vcan0' "$OUT/err" && break; sleep 0.05; done
candump -L vcan0 > "$OUT/bus.log" & candump=$!
for i in $(seq 100); do sleep 0.1; grep -q . "$OUT/bus.log" && break; cansend vcan0 080#09000017; done
"$QUADRIG" monitor can://vcan0 > "$OUT/monitor" 2> "$OUT/monitor.err" & monitor=$!
for i in $(seq 200); do grep -q 'listens on' "$OUT/monitor.err" && break; sleep 0.05; done
canplayer -I "$OUT/second.log" vcan0=can0
sleep 0.3
kill -TERM $monitor; wait $monitor || exit 1
kill -TERM $quadrig; wait $quadrig; status=$?
kill $candump
cat "$OUT/err" >&2
exit $status
)";

}  // namespace

TEST_CASE(
    "A CANaerospace host drives the picture on a live bus, asks who is there, and its recording gives the same "
    "frames") {
    const auto out = scratch_directory();
    const std::string log = text_of(shipped("config/traces/canaerospace-c172-takeoff.log"));
    std::size_t end = 0;
    for (int line = 0; line < 480; ++line) end = log.find('\n', end) + 1;
    std::filesystem::copy_file(scratch_file("second.log", log.substr(0, end)), out / "second.log");
    setenv("QUADRIG", QUADRIG_PROGRAM, 1);
    setenv("SCENE", scratch_file("scene.toml", small_scene()).c_str(), 1);
    setenv("OUT", out.c_str(), 1);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    // Their shadow memory does not fit into User-mode Linux's address space.
    setenv("WITH_VCAN", "host", 1);
#endif
    const std::string script = scratch_file("script.sh", kScript).string();
    const std::string command =
        shipped("tests/with_vcan") + " bash " + script + " 2> " + (out / "messages").string() + " > /dev/null";
    const int status = std::system(command.c_str());
    const std::string messages = text_of(out / "messages");
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNoBus) {
        WARN("skipped: " << messages);
        return;
    }
    INFO(messages);
    REQUIRE(status == 0);
    const auto link = report_of(out / "report.json")["links"][0];
    INFO(link.dump(1));
    // A bus without hardware has no pace of its own: a player in a slow kernel may overrun a queue.
    CHECK(link["frames"].get<int>() >= 55);
    CHECK(link["frames"].get<int>() + link["lost"].get<int>() >= 60);
    CHECK(link["packets"]["body_pitch_angle"].get<int>() >= 55);
    CHECK(link["last_pose"]["latitude"].get<double>() == Approx(29.7597).margin(1e-3));
    CHECK(link["last_pose"]["longitude"].get<double>() == Approx(-95.16395).margin(1e-4));
    CHECK(link["replies"].get<int>() >= 1);
    CHECK(text_of(out / "bus.log").find("081#0910001701010000") != std::string::npos);
    const std::string monitored = text_of(out / "monitor");
    INFO(monitored);
    for (const char* row : {"body_pitch_angle 311", "body_roll_angle 312", "1038"})
        CHECK(monitored.find(row) != std::string::npos);
    const auto scene = std::string(std::getenv("SCENE"));
    const Outcome again = quadrig_program(
        {"replay", out / "heard.log", "--scene", scene, "--size", "16x12", "--fast", "--report", out / "again.json"});
    INFO(again.err);
    REQUIRE(again.status == 0);
    const auto live = report_of(out / "report.json"), replayed = report_of(out / "again.json");
    CHECK(replayed["links"][0]["frames"] == link["frames"]);
    CHECK(replayed["frames"] == live["frames"]);
    // Bit for bit holds for one instruction set: the small kernel may offer another.
    if (live["machine"]["simd"] == replayed["machine"]["simd"]) CHECK(replayed["frame_hashes"] == live["frame_hashes"]);
}
