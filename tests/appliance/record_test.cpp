// Recordings that the program writes: read by tshark, played again bit for bit, whole after a kill.
#include <signal.h>
#include <vector>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <set>
#include <thread>

#include "host_link/modbus_pose.h"
#include "host_link/recording.h"
#include "tests/appliance/files.h"
#include "tests/appliance/flights.h"
#include "tests/appliance/program.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::tests;
using namespace std::chrono_literals;

namespace {

std::string scene_to_fly() { return scratch_file("scene.toml", small_scene()); }

enum class Connections { one, each };

/// A Modbus host's flight as a capture: the climb of fdm_climb, 60 poses a second, over one connection or one for each.
std::filesystem::path modbus_climb(const std::filesystem::path& file, int count,
                                   Connections connections = Connections::one) {
    host::RecordingText text(host::Protocol::modbus, host::RecordingFormat::pcapng, {});
    std::ofstream out(file, std::ios::binary);
    out << text.begin();
    host::Heard heard;
    heard.from.ss_family = AF_INET;
    heard.to_port = 502;
    for (int i = 0; i < count; ++i) {
        const auto n = static_cast<std::uint16_t>(i);
        const host::modbus::HostPose pose{
            n, n * 16U, {{{47.26}, {11.34}, 581.0 + 14.0 + 0.05 * i}, {{0.2 * i}, {0.0}, {0.1 * i}}}};
        const auto block = host::modbus::float_block(pose, {});
        std::array<std::byte, host::modbus::kLargestFrame> frame{};
        heard.bytes = std::span(frame).first(host::modbus::write_request(n, 0, block, frame));
        const auto time = 1'700'000'000s + i * 16667us;
        out << text.piece(heard, time);
        if (connections == Connections::one) continue;
        heard.closes = true;
        out << text.piece(heard, time);
        heard.closes = false;
        ++heard.source;
    }
    return file;
}

struct TwoReports {
    nlohmann::json live, again;
};

/// A live run, driven by `quadrig send` and recorded; then its recording, played as fast as it goes.
TwoReports live_and_again(const std::string& scheme, const std::filesystem::path& flight,
                          const std::filesystem::path& recording) {
    const std::string scene_file = scene_to_fly();
    const auto out = scratch_directory();
    Program program({"run", "--scene", scene_file, "--link", scheme + "://127.0.0.1:0", "--size", "48x32", "--frames",
                     "90", "--record", recording, "--report", out / "live.json"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    const Outcome sent = quadrig_program({"send", flight, "--to", scheme + "://127.0.0.1:" + std::to_string(*port)});
    CHECK(sent.status == 0);
    INFO(sent.err);
    const Outcome live = program.wait();
    INFO(live.err);
    REQUIRE(live.status == 0);
    const Outcome again = quadrig_program(
        {"replay", recording, "--scene", scene_file, "--size", "48x32", "--fast", "--report", out / "again.json"});
    INFO(again.err);
    REQUIRE(again.status == 0);
    return {report_of(out / "live.json"), report_of(out / "again.json")};
}

void check_the_same(const TwoReports& reports) {
    CHECK(reports.live["frames"] == reports.again["frames"]);
    CHECK(reports.live["frame_hashes"] == reports.again["frame_hashes"]);
    CHECK(reports.live["links"][0]["frames"] == reports.again["links"][0]["frames"]);
    CHECK(reports.live["links"][0]["recorded"]["left_out"] == 0);
    std::set<std::string> different;
    for (const auto& hash : reports.live["frame_hashes"]) different.insert(hash);
    CHECK(different.size() > 20);
}

}  // namespace

TEST_CASE("A FlightGear host's live run is recorded, and the recording gives the same frames bit for bit") {
    const auto recording = scratch_directory() / "run.pcapng";
    check_the_same(live_and_again("fdm", fdm_climb(45), recording));
    const auto rows = host::test::tshark_fields(recording, {"ip.proto", "udp.length", "_ws.malformed"});
    CHECK(rows.size() == 45);
    CHECK(rows[0] == std::vector<std::string>{"17", "416", ""});
}

TEST_CASE("A Modbus host's live run is recorded, tshark reads it, and it gives the same frames bit for bit") {
    const auto recording = scratch_directory() / "run.pcapng";
    const auto flight = modbus_climb(scratch_directory() / "flight.pcapng", 45);
    const TwoReports reports = live_and_again("modbus", flight, recording);
    check_the_same(reports);
    CHECK(reports.live["links"][0]["replies"] == 45);
    CHECK(reports.again["links"][0]["last_pose"]["altitude"] == Approx(581.0 + 14.0 + 0.05 * 44));
    // On its registered port, for tshark to know it.
    const auto rows = host::test::tshark_fields(flight, {"tcp.flags.syn", "tcp.seq_raw", "_ws.malformed"});
    REQUIRE(rows.size() == 46);
    CHECK(rows[0][0] == "1");
    CHECK(rows[45] == std::vector<std::string>{"0", std::to_string(1 + 44 * 61), ""});
    const auto poses = host::test::tshark_fields(flight, {"modbus.func_code", "modbus.regval_uint16"});
    CHECK(poses[3][0] == "16");
    CHECK_THAT(poses[3][1], Catch::StartsWith("1,2,0,32,16455,41287,44564,31457,"));
}

TEST_CASE("A Modbus host with a connection for each request drives every frame, live and from its recording") {
    const auto out = scratch_directory();
    const TwoReports reports =
        live_and_again("modbus", modbus_climb(out / "flight.pcapng", 45, Connections::each), out / "run.pcapng");
    check_the_same(reports);
    for (const auto* report : {&reports.live, &reports.again}) {
        const auto& link = (*report)["links"][0];
        CHECK(link["frames"] == 45);
        CHECK(link["rejected"].empty());
        CHECK(link["restarts"] == 0);
        CHECK(link["lost"] == 0);
    }
    const auto ends = host::test::tshark_fields(out / "run.pcapng", {"tcp.flags.fin"});
    CHECK(std::ranges::count(ends, std::vector<std::string>{"1"}) >= 44);
}

TEST_CASE("A run with a body of another link, its quality chosen as it went, gives the same frames bit for bit") {
    const auto out = scratch_directory();
    std::ofstream(out / "scene.toml") << small_scene();
    std::ofstream(out / "run.toml") << "scene = \"scene.toml\"\nlinks = [\"cigi://127.0.0.1:0\"]\nsize = [48, 32]\n"
                                       "[[entity]]\nmodel = \"x-29\"\nposition = [-12, 6, 40]\n"
                                       "[[entity]]\nmodel = \"x-29\"\nlink = \"fdm://127.0.0.1:0\"\n";
    // From above, turning, on a body that climbs towards the eye.
    std::vector<Bytes> flight;
    for (int i = 0; i < 60; ++i)
        flight.push_back(cigi_message(static_cast<std::uint32_t>(i), {70.0, {{0.3 * i}, {-90.0}, {0.0}}}));
    Program program({"run", out / "run.toml", "--frames", "100", "--quality", "auto", "--record", out / "run.pcapng",
                     "--report", out / "live.json"});
    const auto port = program.number_after("cigi://127.0.0.1:0 listens on port ");
    const auto other_port = program.number_after("fdm://127.0.0.1:0 listens on port ");
    REQUIRE(port);
    REQUIRE(other_port);
    Program host({"send", recording(flight, 8004), "--to", "cigi://127.0.0.1:" + std::to_string(*port)}),
        other({"send", fdm_climb(60), "--to", "fdm://127.0.0.1:" + std::to_string(*other_port)});
    CHECK(host.wait().status == 0);
    CHECK(other.wait().status == 0);
    const Outcome live = program.wait();
    INFO(live.err);
    REQUIRE(live.status == 0);
    const auto again = [&](const std::string& name, Arguments more) {
        Arguments arguments{"replay", out / "run.pcapng", "--fast", "--report", out / name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return quadrig_program(arguments);
    };
    const Outcome whole = again("whole.json", {out / "run.toml", "--quality", "auto"});
    INFO(whole.err);
    REQUIRE(whole.status == 0);
    REQUIRE(again("alone.json", {"--scene", out / "scene.toml", "--size", "48x32", "--quality", "auto"}).status == 0);
    const auto was = report_of(out / "live.json"), is = report_of(out / "whole.json"),
               alone = report_of(out / "alone.json");
    CHECK(was["frame_hashes"] == is["frame_hashes"]);
    CHECK(was["quality"] == is["quality"]);
    CHECK(was["quality"].size() > 1);
    CHECK(alone["quality"] == was["quality"]);
    CHECK(alone["frame_hashes"] != was["frame_hashes"]);
    REQUIRE(was["links"].size() == 2);
    REQUIRE(is["links"].size() == 2);
    for (const char* key : {"entity", "frames", "last_pose"}) CHECK(was["links"][1][key] == is["links"][1][key]);
    CHECK(was["links"][1]["recorded"]["datagrams"] == 60);
    CHECK(host::test::tshark_fields(out / "run.entity-2.pcapng", {"udp.length"}).size() == 60);
    std::filesystem::remove(out / "run.entity-2.pcapng");
    const Outcome missing = again("none.json", {out / "run.toml"});
    CHECK(missing.status == 1);
    CHECK_THAT(missing.err, Catch::Contains("run.entity-2.pcapng"));
}

TEST_CASE("A run in which one host took the link over from another gives the same frames bit for bit") {
    const auto out = scratch_directory();
    const std::string scene_file = scene_to_fly();
    Program program({"run", "--scene", scene_file, "--link", "cigi://127.0.0.1:0?host=first&silence=100", "--size",
                     "48x32", "--frames", "150", "--record", out / "run.pcapng", "--report", out / "live.json"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    // The second one's frame numbers are a little behind those of the first: of one host they would be late messages.
    for (const std::uint32_t first : {100U, 90U}) {
        std::vector<Bytes> flight;
        for (std::uint32_t i = 0; i < 30; ++i)
            flight.push_back(cigi_message(first + i, {0.5 * (first + i), {{0.2 * i}, {-5.0}, {0.0}}}));
        const std::string to = "cigi://127.0.0.1:" + std::to_string(*port);
        CHECK(quadrig_program({"send", recording(flight, 8004), "--to", to}).status == 0);
        std::this_thread::sleep_for(300ms);
    }
    const Outcome live = program.wait();
    INFO(live.err);
    REQUIRE(live.status == 0);
    const Outcome again =
        quadrig_program({"replay", out / "run.pcapng", "--scene", scene_file, "--link", "cigi:?silence=100", "--size",
                         "48x32", "--fast", "--report", out / "again.json"});
    INFO(again.err);
    REQUIRE(again.status == 0);
    const auto was = report_of(out / "live.json"), is = report_of(out / "again.json");
    CHECK(was["frame_hashes"] == is["frame_hashes"]);
    for (const char* key : {"frames", "restarts", "reordered"}) CHECK(was["links"][0][key] == is["links"][0][key]);
    CHECK(was["links"][0]["frames"] == 60);
    CHECK(was["links"][0]["restarts"] == 1);
}

// QUADRIG_TEST_SCALE=240 makes it ten minutes.
TEST_CASE("A recording whose process was killed has all but the last second, and can be played") {
    const double seconds = 0.1 * test::trials(25);
    const auto recording = scratch_directory() / "killed.pcapng";
    Program program({"record", recording, "--link", "fdm://127.0.0.1:0"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    Program host(
        {"send", fdm_climb(static_cast<int>(60 * seconds) + 450), "--to", "fdm://127.0.0.1:" + std::to_string(*port)});
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    program.signal(SIGKILL);
    const auto killed = std::chrono::system_clock::now().time_since_epoch();
    program.wait();
    host.signal(SIGTERM);
    const std::string sent = host.wait().err;
    const auto rows = host::test::tshark_fields(recording, {"frame.time_epoch", "frame.time_relative"});
    // The recording's clock is the calendar's to half a second; a machine that was away owes the host its datagrams.
    CAPTURE(sent, rows.size());
    const auto recorded = static_cast<double>(rows.size());
    CHECK(recorded > 60 * seconds / 3);
    CHECK(recorded > std::stod(sent.substr(sent.find(": ") + 2)) - 60);
    CHECK(std::stod(rows.back()[0]) > std::chrono::duration<double>(killed).count() - 2.0);
    const Outcome check = quadrig_program({"check", recording});
    CHECK(check.status == 0);
    CHECK_THAT(check.out, Catch::Contains(std::to_string(rows.size()) + " poses"));
}

TEST_CASE("A link can be watched, and its host's oddities reported") {
    std::vector<Bytes> flight(30, fdm_message({}));
    const auto sound = recording(flight, 5500);
    std::swap(flight[20][0], flight[20][3]);
    const auto swapped = recording(flight, 5500);
    // Over TCP, and over UDP.
    Program plain({"monitor", "fdm://127.0.0.1:0?transport=tcp", "--seconds", "1.6"}),
        strict({"monitor", "fdm://127.0.0.1:0", "--seconds", "1.6", "--strict"});
    for (Program* program : {&plain, &strict}) {
        const auto port = program->number_after("listens on port ");
        REQUIRE(port);
        const std::string to = "fdm://127.0.0.1:" + std::to_string(*port) + (program == &plain ? "?transport=tcp" : "");
        CHECK(quadrig_program({"send", program == &plain ? sound : swapped, "--to", to, "--speed", "2"}).status == 0);
    }
    const Outcome seen = plain.wait(), report = strict.wait();
    CHECK(seen.status == 0);
    CHECK_THAT(seen.out, Catch::Contains("net_fdm_24") && Catch::Contains("altitude 595 m"));
    CHECK(report.status == 1);
    CHECK_THAT(report.out, Catch::Contains("message 21: byte_swapped_version: byte-swapped 24: a host of the other"));
    CHECK_THAT(report.out, Catch::Contains(" in 30 messages, 29 poses\n"));
    CHECK_THAT(report.err, Catch::Contains("does not conform"));
}

TEST_CASE("What could not be sent makes sending a failure, with its count and reason") {
    const auto flight = fdm_climb(10);
    const auto send_to = [&](const std::string& to) {
        return quadrig_program({"send", flight, "--to", to, "--speed", "10"});
    };
    int port = 0;
    {
        Program monitor({"monitor", "fdm://127.0.0.1:0"});
        port = monitor.number_after("listens on port ").value();
        const Outcome sent = send_to("fdm://127.0.0.1:" + std::to_string(port));
        CHECK(sent.status == 0);
        CHECK(sent.err == "quadrig: 10 sent, 0 not\n");
    }
    const std::string url = "fdm://127.0.0.1:" + std::to_string(port);
    const Outcome refused = send_to(url);
    CHECK(refused.status == 1);
    CHECK_THAT(refused.err, Catch::Contains(" not: " + url + ": Connection refused"));
    CHECK_FALSE(Catch::Contains(" 0 not").match(refused.err));
}

TEST_CASE("What cannot be recorded or sent is said before anything runs") {
    const auto out = scratch_directory();
    const auto fails = [&](const Arguments& arguments, int status, const std::string& reason) {
        const Outcome outcome = quadrig_program(arguments);
        INFO(outcome.err);
        CHECK(outcome.status == status);
        CHECK_THAT(outcome.err, Catch::Contains(reason));
    };
    fails({"record", out / "a.log", "--link", "fdm://127.0.0.1:0"}, 1, "only CAN can be recorded as a log");
    fails({"record", out / "no" / "a.pcapng", "--link", "fdm://127.0.0.1:0"}, 1, "a.pcapng: cannot be written");
    fails({"record", out / "a.pcapng", "--link", "fdm:"}, 2, "needs ADDRESS:PORT");
    fails({"record", out / "a.pcapng"}, 2, "--link is missing");
    fails({"monitor", "fdm:"}, 2, "needs ADDRESS:PORT");
    fails({"monitor", "fdm://127.0.0.1:0", "--strict", "--seconds", "0.05"}, 1, "nothing was heard");
    fails({"send", fdm_climb(3), "--to", "cigi://127.0.0.1:9"}, 1, "no datagram of a CIGI");
    fails({"send", fdm_climb(3), "--to", "fdm:"}, 2, "needs ADDRESS:PORT");
    fails({"run", "--scene", scene_to_fly(), "--link", "fdm://127.0.0.1:0", "--link", "cigi://127.0.0.1:0", "--record",
           out / "a.pcapng"},
          2, "--record takes one link");
    fails({"run", "--scene", scene_to_fly(), "--link", "fdm://127.0.0.1:0", "--seconds", "60", "--report",
           out / "no" / "report.json"},
          1, "report.json: cannot be written: No such file or directory");
    std::ofstream(out / "bad.pcapng.frames") << "quadrig-frames 2 rate 60/1\n5,1,0,0\n4,2,0,0\n";
    std::filesystem::copy_file(fdm_climb(3), out / "bad.pcapng");
    fails({"replay", out / "bad.pcapng", "--scene", scene_to_fly(), "--fast"}, 1, "bad.pcapng.frames:3: expected");
}
