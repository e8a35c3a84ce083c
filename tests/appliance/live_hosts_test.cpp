// Hosts in processes of their own, as they are in the field: FlightGear's over TCP, and CIGI's two ways to run.
#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <set>

#include "tests/appliance/files.h"
#include "tests/appliance/host_socket.h"
#include "tests/appliance/program.h"

using namespace quadrig;
using namespace quadrig::tests;
using namespace std::chrono_literals;
namespace cigi = host::cigi;

namespace {

/// Poses too far from one another for any motion: each is shown as it came. Each leans differently.
Pose pose(int k) { return {k % 2 == 0 ? 14.0 : 4000.0, {{12.0 * k}, {0.0}, {7.0 * k}}}; }

/// The pictures of a flight, one for each message.
std::vector<std::string> expected(const std::string& scene, const std::vector<Bytes>& messages) {
    const auto report = scratch_directory() / "r.json";
    const Outcome outcome = quadrig_program({"replay", recording(messages, 5500, 50ms), "--scene", scene, "--size",
                                             "48x32", "--rate", "20", "--fast", "--report", report});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto hashes = report_of(report)["frame_hashes"].get<std::vector<std::string>>();
    REQUIRE(hashes.size() == messages.size());
    REQUIRE(std::set(hashes.begin(), hashes.end()).size() == messages.size());
    return hashes;
}

/// Of the pictures of a run, one after the other, those that are in `poses`: they come in their order, and at most
/// `missing` of them are not there.
void check_drawn_in_order(const nlohmann::json& report, const std::vector<std::string>& poses, int missing) {
    std::vector<std::ptrdiff_t> drawn;
    for (const std::string hash : report["frame_hashes"]) {
        const auto at = std::ranges::find(poses, hash) - poses.begin();
        if (at == std::ssize(poses)) {
            // Before the first there is the picture without a host.
            CHECK(drawn.empty());
        } else if (drawn.empty() || drawn.back() != at) {
            drawn.push_back(at);
        }
    }
    CAPTURE(drawn, report["deadline_misses"]);
    CHECK(std::ranges::is_sorted(drawn));
    REQUIRE_FALSE(drawn.empty());
    CHECK(drawn.back() == std::ssize(poses) - 1);
    // The first may have come before the first frame did.
    CHECK(std::ssize(drawn) >= std::ssize(poses) - drawn.front() - missing);
}

/// A host as JSBSim's <output type="FLIGHTGEAR" protocol="TCP"> is one: connects, and sends bare packets in network
/// byte order. Packed by nothing of ours.
constexpr const char* kTcpHosts = R"(
import math, socket, struct, sys, time
port = int(sys.argv[1])
poses = [tuple(float(x) for x in line.split()) for line in sys.stdin]
sent = open(sys.argv[2], 'wb')

def packet(version, pose):
    height, heading, pitch, roll = pose
    size = {24: 408, 25: 552}[version]
    head = struct.pack('>II3df3f', version, 0, math.radians(11.34), math.radians(47.26), 581.0 + height, 0.0,
                       math.radians(roll), math.radians(pitch), math.radians(heading))
    clock = {24: 356, 25: 500}[version]
    whole = bytearray(head.ljust(size, b'\0'))
    struct.pack_into('>I', whole, clock, 1234567890)
    return bytes(whole)

def host():
    return socket.create_connection(('127.0.0.1', port), timeout=30)

def fly(s, version, flight, cut=False):
    for pose in flight:
        bytes = packet(version, pose)
        sent.write(bytes)
        if cut:  # in pieces that have nothing to do with packets
            s.sendall(bytes[:100])
            time.sleep(0.005)
            bytes = bytes[100:]
        s.sendall(bytes)
        time.sleep(0.07)

third = len(poses) // 3
first = host()
fly(first, 24, poses[:1])
time.sleep(0.3)
fly(first, 24, poses[1:third])
other = host()  # a second one at the same time is let go, whatever it says
try:
    other.sendall(packet(24, (5000.0, 0.0, 0.0, 0.0)))
    assert other.recv(1) == b'', 'the second host is let go'
except ConnectionError:
    pass
fly(first, 24, poses[third:2 * third], cut=True)
first.sendall(packet(24, (7000.0, 0.0, 0.0, 0.0))[:200])  # dies in the middle of a packet
first.close()
time.sleep(0.05)
again = host()  # and comes back, as another version
fly(again, 25, poses[2 * third:])
again.close()
print('well')
)";

}  // namespace

TEST_CASE("FlightGear hosts over TCP are drawn pose by pose, in pieces, after a death and as another version") {
    constexpr int kPoses = 12;
    const std::string scene = scratch_file("still.toml", still_scene());
    const auto out = scratch_directory();
    Program program({"run", "--scene", scene, "--link", "fdm://127.0.0.1:0?transport=tcp", "--size", "48x32", "--rate",
                     "100", "--frames", "100000", "--report", out / "r.json"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    {
        std::ofstream poses(out / "poses");
        poses.precision(17);
        for (int k = 0; k < kPoses; ++k)
            poses << pose(k).height << ' ' << pose(k).attitude.heading.value << ' ' << pose(k).attitude.pitch.value
                  << ' ' << pose(k).attitude.roll.value << '\n';
    }
    const auto script = scratch_file("hosts.py", kTcpHosts);
    const std::string command = "/usr/bin/python3 " + script.string() + " " + std::to_string(*port) + " " +
                                (out / "sent").string() + " < " + (out / "poses").string() + " > " +
                                (out / "said").string() + " 2>&1";
    const int status = std::system(command.c_str());
    INFO(text_of(out / "said"));
    CHECK(status == 0);
    CHECK_THAT(text_of(out / "said"), Catch::EndsWith("well\n"));
    program.signal(SIGTERM);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto report = report_of(out / "r.json");
    const auto& link = report["links"][0];
    CHECK(link["frames"] == kPoses);
    CHECK(link["packets"] == nlohmann::json({{"net_fdm_24", 8}, {"net_fdm_25", 4}}));
    CHECK(link["rejected"] == nlohmann::json({{"too_many_clients", 1}}));
    CHECK(link["restarts"] == 1);
    std::vector<Bytes> sent;
    const Bytes stream = host::test::read_file(out / "sent");
    for (std::size_t at = 0; at < stream.size(); at += sent.back().size()) {
        const std::size_t size = stream.at(at + 3) == std::byte{24} ? 408 : 552;
        sent.emplace_back(stream.begin() + static_cast<std::ptrdiff_t>(at),
                          stream.begin() + static_cast<std::ptrdiff_t>(at + size));
    }
    REQUIRE(sent.size() == kPoses);
    // Where the machine was not away, two poses may still have waited for the link's thread together.
    check_drawn_in_order(report, expected(scene, sent), report["repeated_frames"] == 0 ? 1 : kPoses);
}

namespace {

constexpr host::cigi::Format kFormat{host::ByteOrder::big, cigi::Version::four};

/// What a CIGI 4.0 host says in one frame.
Bytes message_of(std::uint32_t host_frame, std::uint32_t ig_frame, cigi::IgMode mode, int database, const Pose& at) {
    cigi::IgControl ig = host::test::ig_control(host_frame);
    ig.mode = mode;
    ig.database = static_cast<std::int8_t>(database);
    ig.last_ig_frame = ig_frame;
    Bytes bytes = cigi_message(host_frame, at, {}, kFormat);
    return host::test::operator+(host::test::message(kFormat, ig),
                                 Bytes(bytes.begin() + cigi::IgControl::kSize4, bytes.end()));
}

cigi::StartOfFrame start_of_frame_from(const HostSocket& host) {
    const Bytes bytes = host.receive(20s);
    REQUIRE(bytes.size() == cigi::StartOfFrame::kSize4);
    return cigi::decode<cigi::StartOfFrame>(bytes, kFormat);
}

}  // namespace

TEST_CASE("In synchronous operation Start Of Frame paces the host, and each frame shows the answer to the one before") {
    constexpr int kPoses = 24;
    const std::string scene = scratch_file("still.toml", still_scene());
    const auto out = scratch_directory();
    Program program({"run", "--scene", scene, "--link", "cigi://127.0.0.1:0?operation=synchronous", "--size", "48x32",
                     "--rate", "50", "--frames", "100000", "--report", out / "r.json"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    const HostSocket host(*port);
    // The database's handshake, in standby: asked for, taken notice of, there.
    std::uint32_t frame = 0;
    int wanted = 4;
    cigi::StartOfFrame told;
    const auto until = [&](int database) {
        for (int i = 0; i < 1000 && (told.database != database || i == 0); ++i) {
            host.send(message_of(++frame, told.ig_frame, cigi::IgMode::standby, wanted, pose(0)));
            told = start_of_frame_from(host);
            CHECK(told.mode == cigi::IgMode::standby);
            if (told.database == -wanted) wanted = 0;
        }
        CHECK(int{told.database} == database);
    };
    until(4);
    CHECK(wanted == 0);
    int at_once = 0;
    const std::uint32_t begun = frame;
    for (int k = 0; k < kPoses; ++k) {
        // Debug is drawn as operate is.
        const auto mode = k % 8 == 7 ? cigi::IgMode::debug : cigi::IgMode::operate;
        host.send(message_of(++frame, told.ig_frame, mode, 0, pose(k)));
        const auto before = told;
        told = start_of_frame_from(host);
        CHECK(told.ig_frame > before.ig_frame);
        CHECK(*told.last_host_frame <= frame);
        CHECK(int{told.database} == 4);
        at_once += *told.last_host_frame == frame && told.ig_frame == before.ig_frame + 1 ? 1 : 0;
        if (*told.last_host_frame == frame) CHECK(told.mode == mode);
    }
    CHECK(frame - begun == kPoses);
    // The host falls silent.
    for (int i = 0; i < 6; ++i) start_of_frame_from(host);
    program.signal(SIGTERM);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto report = report_of(out / "r.json");
    const auto& link = report["links"][0];
    CHECK(link["lost"] == 0);
    CHECK(link["frames"] == frame);
    CAPTURE(at_once, report["repeated_frames"]);
    // All of them, but where the machine was away.
    CHECK(at_once > kPoses / 2);
    CHECK(link["unanswered"].get<int>() >= 5);
    if (at_once == kPoses) CHECK(link["unanswered"].get<int>() < 12);
    std::vector<Bytes> sent;
    for (int k = 0; k < kPoses; ++k)
        sent.push_back(message_of(static_cast<std::uint32_t>(k), 0, cigi::IgMode::operate, 0, pose(k)));
    check_drawn_in_order(report, expected(scene, sent), kPoses - at_once);
}

TEST_CASE("In asynchronous operation a host at its own rate gets Start Of Frame at ours, which tell missed deadlines") {
    const std::string scene = scratch_file("still.toml", still_scene());
    for (const bool too_slow : {false, true}) {
        // A thousand pictures of that size in a second are more than any machine draws.
        const auto out = scratch_directory();
        Arguments arguments{"run",
                            "--scene",
                            scene,
                            "--link",
                            "cigi://127.0.0.1:0",
                            "--report",
                            out / "r.json",
                            "--size",
                            too_slow ? "1920x1080" : "48x32",
                            "--rate",
                            too_slow ? "1000" : "100"};
        Program program(arguments);
        const auto port = program.number_after("listens on port ");
        REQUIRE(port);
        const HostSocket host(*port);
        std::uint32_t frame = 0, newest = 0, overframing = 0, told = 0;
        const auto begun = std::chrono::steady_clock::now();
        while (frame < 12 || told < 3) {
            host.send(message_of(++frame, newest, cigi::IgMode::operate, 0, pose(0)));
            const auto next = begun + frame * 40ms;
            while (std::chrono::steady_clock::now() < next) {
                const Bytes bytes =
                    host.receive(std::chrono::ceil<std::chrono::milliseconds>(next - std::chrono::steady_clock::now()));
                if (bytes.empty()) continue;
                const auto sof = cigi::decode<cigi::StartOfFrame>(bytes, kFormat);
                ++told;
                CHECK((told == 1 || sof.ig_frame > newest));
                newest = sof.ig_frame;
                CHECK(*sof.last_host_frame <= frame);
                overframing += (sof.conditions & cigi::StartOfFrame::kOverframing) != 0 ? 1 : 0;
            }
        }
        program.signal(SIGTERM);
        const Outcome outcome = program.wait();
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        const auto report = report_of(out / "r.json");
        CAPTURE(told, overframing, report["deadline_misses"]);
        CHECK(report["links"][0]["frames"] == frame);
        CHECK_FALSE(report["links"][0].contains("unanswered"));
        if (too_slow) {
            CHECK(told > 1);
            CHECK(overframing + 1 >= told);
        } else {
            CHECK(told > frame);
            CHECK(overframing <= report["deadline_misses"]);
        }
    }
}
