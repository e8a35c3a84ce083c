#include <fcntl.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <thread>

#include "display/png_file.h"
#include "host_link/cigi.h"
#include "host_link/cigi_query.h"
#include "tests/appliance/files.h"
#include "tests/appliance/flights.h"
#include "tests/appliance/host_socket.h"
#include "tests/appliance/program.h"

using namespace quadrig;
using namespace quadrig::tests;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

/// A bound port that nobody listens at.
struct OccupiedPort {
    int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
    int number = 0;
    OccupiedPort() {
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof at;
        REQUIRE(bind(socket, reinterpret_cast<sockaddr*>(&at), size) == 0);
        getsockname(socket, reinterpret_cast<sockaddr*>(&at), &size);
        number = ntohs(at.sin_port);
    }
    ~OccupiedPort() { close(socket); }
    OccupiedPort(const OccupiedPort&) = delete;
    OccupiedPort& operator=(const OccupiedPort&) = delete;
};

std::string scene() {
    static const std::string file = scratch_file("scene.toml", small_scene());
    return file;
}

display::Picture last_picture(const std::filesystem::path& directory) {
    std::filesystem::path last;
    // A file in the making has another extension.
    for (const auto& entry : std::filesystem::directory_iterator(directory))
        if (entry.path().extension() == ".png") last = std::max(last, entry.path());
    return display::read_png(last);
}

display::Picture rendered(const std::string& eye, const std::string& attitude, const std::string& scene_file) {
    const auto out = scratch_directory() / "still.png";
    REQUIRE(quadrig_program({"render", scene_file, "--eye", eye, "--attitude", attitude, "--size", "96x64", "--fov",
                             "60", "-o", out})
                .status == 0);
    return display::read_png(out);
}

std::string still_scene_file() { return scratch_file("still.toml", still_scene()); }

}  // namespace

TEST_CASE("A FlightGear host drives the picture live, until SIGTERM asks for the report") {
    const auto out = scratch_directory();
    const std::string scene_file = still_scene_file();
    Program program({"run", "--scene", scene_file, "--link", "fdm://127.0.0.1:0", "--sink",
                     "png:" + (out / "p").string(), "--size", "96x64", "--report", out / "r.json"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    const HostSocket host(*port);
    const Pose pose{14.0, {{12.5}, {-3.0}, {20.0}}};
    int sent = 0;
    // Until pictures with the pose have gone out: 60 sent at 60 Hz is a second.
    for (; sent < 90; ++sent) {
        host.send(fdm_message(pose));
        std::this_thread::sleep_for(16ms);
    }
    program.signal(SIGTERM);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    CHECK(outcome.out.empty());
    const auto report = report_of(out / "r.json");
    CHECK(report["real_time"] == true);
    CHECK(report["frames"] > 20);
    CHECK(report["links"][0]["datagrams"] == sent);
    CHECK(report["links"][0]["frames"] == sent);
    CHECK(report["links"][0]["last_pose"]["roll"] == Approx(20.0));
    CHECK(report["latency_ms"]["min"] > 0.0);
    CHECK(report["latency_ms"]["p50"] < 1000.0);
    CHECK(report["sinks"][0]["frames"].get<int>() + report["sinks"][0]["dropped"].get<int>() == report["frames"]);
    const Difference apart = difference(last_picture(out / "p"), rendered("0,0,14", "12.5,-3,20", scene_file));
    CHECK(apart.mean < 0.02);
    CHECK(apart.largest < 24);
}

TEST_CASE("A CIGI host that asks how high it is gets the answer behind a Start Of Frame") {
    Program program({"run", "--scene", scene(), "--link", "cigi://127.0.0.1:0", "--size", "32x24"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    const HostSocket host(*port);
    host::cigi::HatHotRequest request{.request = 77, .entity_coordinates = true};
    host.send(cigi_message(5, {}, host::test::message(host::ByteOrder::big, request)));
    Bytes bytes;
    for (int i = 0; i < 100 && bytes.size() != 40; ++i) bytes = host.receive(5000ms);
    REQUIRE(bytes.size() == 40);
    const auto answer =
        host::cigi::decode<host::cigi::HatHotResponse>(std::span(bytes).subspan(24), host::ByteOrder::big);
    CHECK(answer.request == 77);
    CHECK(answer.valid);
    CHECK(answer.host_frame == 5);
    // 14 m above the ground's plane, over whatever the scene has at its origin.
    const auto depth = scratch_directory() / "d.npy";
    const Outcome seen = quadrig_program({"render", scene(), "--eye", "0,0,100", "--attitude", "0,-90,0", "--size",
                                          "1x1", "--fov", "1", "--reference", "--depth", depth});
    REQUIRE(seen.status == 0);
    CHECK(answer.height == Approx(14.0 - (100.0 - read_float64_plane(depth).at(0, 0))).margin(1e-6));
    program.signal(SIGTERM);
    CHECK(program.wait().status == 0);
}

TEST_CASE("A CIGI 4.0 host drives a live run, in either byte order, and is answered in 4.0") {
    const auto out = scratch_directory();
    Program program({"run", "--scene", scene(), "--link", "cigi://127.0.0.1:0", "--size", "32x24", "--rate", "60",
                     "--report", out / "r.json"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    std::uint32_t host_frame = 0;
    for (const auto order : {host::ByteOrder::big, host::ByteOrder::little}) {
        const HostSocket host(*port);
        const host::cigi::Format format{order, host::cigi::Version::four};
        const host::cigi::HatHotRequest question{.request = 9, .entity_coordinates = true};
        Bytes more;
        host::test::append(more, question, format);
        host.send(cigi_message(++host_frame, {20.0, {}}, more, format));
        Bytes reply;
        for (int i = 0; i < 100 && reply.size() != 40; ++i) reply = host.receive(5000ms);
        REQUIRE(reply.size() == 40);
        const auto sof = host::cigi::decode<host::cigi::StartOfFrame>(reply, format);
        CHECK(reply[4] == std::byte{4});
        CHECK(sof.last_host_frame == host_frame);
        CHECK((sof.conditions & ~host::cigi::StartOfFrame::kOverframing) == 0);
        const auto answer = host::cigi::decode<host::cigi::HatHotResponse>(std::span(reply).subspan(24), format);
        CHECK(answer.request == 9);
        CHECK(answer.valid);
    }
    program.signal(SIGTERM);
    CHECK(program.wait().status == 0);
    const auto link = report_of(out / "r.json")["links"][0];
    CHECK(link["packets"] ==
          nlohmann::json({{"ig_control", 2}, {"entity_control", 2}, {"entity_position", 2}, {"hat_hot_request", 2}}));
    CHECK(link["rejected"].empty());
    CHECK(link["last_pose"]["altitude"] == Approx(601.0));
}

TEST_CASE("A terminal that goes away ends a run with its report, but under nohup it runs on") {
    const std::filesystem::path report = scratch_directory() / "r.json";
    const Arguments run{"run",    "--scene", scene(),    "--link",       "fdm://127.0.0.1:0",
                        "--size", "8x8",     "--report", report.string()};
    // The tests may run under nohup themselves.
    const auto before = std::signal(SIGHUP, SIG_DFL);
    Program program(run);
    REQUIRE(program.number_after("listens on port "));
    program.signal(SIGHUP);
    CHECK(program.wait().status == 0);
    CHECK(report_of(report)["repeated_frames"].is_number());

    std::signal(SIGHUP, SIG_IGN);
    Program nohup(run);
    std::signal(SIGHUP, before);
    REQUIRE(nohup.number_after("listens on port "));
    nohup.signal(SIGHUP);
    std::this_thread::sleep_for(100ms);
    nohup.signal(SIGUSR1);
    CHECK(nohup.wait().status == -SIGUSR1);
}

TEST_CASE("A CIGI host gets Start Of Frame back, every frame, and is answered with its own frame numbers") {
    const auto out = scratch_directory();
    Program program({"run", "--scene", scene(), "--link", "cigi://127.0.0.1:0", "--size", "32x24", "--rate", "60",
                     "--report", out / "r.json"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    const HostSocket host(*port);
    std::uint32_t host_frame = 0;
    std::vector<host::cigi::StartOfFrame> replies;
    // The host that CIGI describes: every Start Of Frame is answered with the next message.
    host.send(cigi_message(host_frame, {}));
    while (replies.size() < 60) {
        const Bytes bytes = host.receive(5000ms);
        REQUIRE(bytes.size() == host::cigi::StartOfFrame::kSize);
        CHECK(bytes[0] == std::byte{101});
        replies.push_back(host::cigi::decode<host::cigi::StartOfFrame>(bytes, host::ByteOrder::big));
        ++host_frame;
        host.send(cigi_message(host_frame, {14.0 + host_frame, {}}));
    }
    program.signal(SIGINT);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    for (std::size_t i = 1; i < replies.size(); ++i) {
        CHECK(replies[i].ig_frame > replies[i - 1].ig_frame);
        CHECK(replies[i].timestamp > replies[i - 1].timestamp);
        CHECK(*replies[i].last_host_frame >= *replies[i - 1].last_host_frame);
        CHECK(*replies[i].last_host_frame <= i);
    }
    CHECK(*replies.back().last_host_frame >= 50);
    const auto report = report_of(out / "r.json");
    const auto& link = report["links"][0];
    CHECK(link["replies"] >= 60);
    CHECK(link["replies"] <= report["frames"]);
    CHECK(link["packets"]["ig_control"] == host_frame + 1);
    CHECK(link["lost"] == 0);
    // Frames that were not drawn in time are missing from the numbers, all others are there.
    CHECK(replies.back().ig_frame - replies.front().ig_frame <=
          replies.size() - 1 + report["repeated_frames"].get<std::size_t>());
}

TEST_CASE("Until a host is there the scene is seen from its origin, and a run of N frames is N frames") {
    const auto out = scratch_directory();
    const std::string scene_file = still_scene_file();
    const Outcome outcome = quadrig_program({"run", "--scene", scene_file, "--link", "cigi://127.0.0.1:0", "--sink",
                                             "y4m:-", "--sink", "png:" + (out / "p").string(), "--size", "96x64",
                                             "--frames", "12", "--rate", "20", "--report", out / "r.json"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto report = report_of(out / "r.json");
    CHECK(report["frames"] == 12);
    CHECK(report["frame_hashes"].size() == 12);
    CHECK(report["links"][0]["frames"] == 0);
    CHECK(report["links"][0]["replies"] == 0);
    CHECK(read_y4m(outcome.out).frames == report["sinks"][0]["frames"]);
    CHECK(difference(last_picture(out / "p"), rendered("0,0,2", "0,0,0", scene_file)).largest == 0);
}

TEST_CASE("Settings come from an appliance file, and options win over it") {
    const auto out = scratch_directory();
    const auto file =
        scratch_file("appliance.toml",
                     "scene = \"scene.toml\"\nlinks = [\"fdm://127.0.0.1:0\"]\nsize = [40, 30]\nfov = 75\n"
                     "rate = 50\nthreads = 1\nquality = \"draft\"\n");
    std::filesystem::copy(scene(), file.parent_path() / "scene.toml");
    const auto report = [&](const Arguments& more) {
        Arguments arguments{"run", file, "--frames", "3", "--report", out / "r.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = quadrig_program(arguments);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return report_of(out / "r.json");
    };
    const auto plain = report({});
    CHECK(plain["image"] == nlohmann::json({{"width", 40}, {"height", 30}}));
    CHECK(plain["rate_hz"] == 50.0);
    CHECK(plain["machine"]["threads"] == 1);
    CHECK(plain["quality"] == nlohmann::json({{"draft", 3}}));
    CHECK(plain["links"].size() == 1);
    const auto other =
        report({"--size", "20x10", "--quality", "best", "--link", "cigi://127.0.0.1:0", "--link", "fdm://127.0.0.1:0"});
    CHECK(other["image"]["width"] == 20);
    CHECK(other["quality"] == nlohmann::json({{"best", 3}}));
    REQUIRE(other["links"].size() == 2);
    CHECK(other["links"][0]["url"] == "cigi://127.0.0.1:0");
    CHECK(other["rate_hz"] == 50.0);
}

TEST_CASE("A port in use is a failure that names the link, before the scene is looked at") {
    const OccupiedPort occupied;
    const std::string link = "fdm://127.0.0.1:" + std::to_string(occupied.number);
    const Outcome outcome = quadrig_program({"run", "--scene", "no-such-scene.toml", "--link", link});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Contains(link) && Contains("cannot bind") && Contains("in use"));
}

TEST_CASE("Of two hosts the first in order drives, and the second where the first falls silent") {
    const auto out = scratch_directory();
    const std::string scene_file = still_scene_file();
    Program program({"run", "--scene", scene_file, "--link", "fdm://127.0.0.1:0", "--link",
                     "cigi://127.0.0.1:0?ownship=0", "--sink", "png:" + (out / "p").string(), "--size", "96x64",
                     "--report", out / "r.json"});
    const auto first_port = program.number_after("fdm://127.0.0.1:0 listens on port ");
    const auto second_port = program.number_after("ownship=0 listens on port ");
    REQUIRE(first_port);
    REQUIRE(second_port);
    const HostSocket first(*first_port), second(*second_port);
    std::uint32_t frame = 0;
    const auto feed = [&](int count, bool both) {
        for (int i = 0; i < count; ++i) {
            if (both) first.send(fdm_message({14.0, {{12.5}, {-3.0}, {20.0}}}));
            second.send(cigi_message(++frame, {40.0, {}}));
            std::this_thread::sleep_for(16ms);
        }
    };
    feed(60, true);
    const auto while_both = last_picture(out / "p");
    feed(120, false);
    program.signal(SIGTERM);
    CHECK(program.wait().status == 0);
    CHECK(difference(while_both, rendered("0,0,14", "12.5,-3,20", scene_file)).mean < 0.02);
    CHECK(difference(last_picture(out / "p"), rendered("0,0,40", "0,0,0", scene_file)).mean < 0.02);
}

TEST_CASE("Truncated, garbled and oversized datagrams never end a live run") {
    const auto out = scratch_directory();
    Program program({"run", "--scene", scene(), "--link", "cigi://127.0.0.1:0", "--link", "fdm://127.0.0.1:0", "--size",
                     "16x12", "--report", out / "r.json"});
    for (const char* text : {"cigi://127.0.0.1:0 listens on port ", "fdm://127.0.0.1:0 listens on port "}) {
        const auto port = program.number_after(text);
        REQUIRE(port);
        const HostSocket host(*port);
        Bytes message = text[0] == 'c' ? cigi_message(1, {}) : fdm_message({});
        for (std::size_t size = 0; size <= message.size(); size += 7)
            host.send({message.begin(), message.begin() + static_cast<std::ptrdiff_t>(size)});
        host.send(Bytes(65507, std::byte{0x5A}));
        message.resize(60000);
        host.send(message);
    }
    std::this_thread::sleep_for(300ms);
    program.signal(SIGTERM);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    const auto report = report_of(out / "r.json");
    for (const auto& link : report["links"]) {
        std::uint64_t rejected = 0;
        for (const auto& [reason, count] : link["rejected"].items()) rejected += count.get<std::uint64_t>();
        CHECK(rejected > 5);
        CHECK(rejected + link["frames"].get<std::uint64_t>() == link["datagrams"]);
    }
}

TEST_CASE("A sink that stands still costs a live run frames of that sink, and no more") {
    const auto out = scratch_directory();
    const std::string pipe = out / "pipe";
    REQUIRE(std::system(("mkfifo '" + pipe + "'").c_str()) == 0);
    // A reader that opens and never reads.
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    const Outcome outcome =
        quadrig_program({"run", "--scene", scene(), "--link", "fdm://127.0.0.1:0", "--sink", "y4m:" + pipe, "--size",
                         "160x120", "--frames", "40", "--report", out / "r.json"});
    close(reader);
    INFO(outcome.err);
    const auto report = report_of(out / "r.json");
    CHECK(report["frames"] == 40);
    CHECK(report["sinks"][0]["dropped"] > 20);
}
