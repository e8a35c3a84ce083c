#include <catch2/catch.hpp>
#include <set>

#include "display/png_file.h"
#include "tests/appliance/files.h"
#include "tests/appliance/flights.h"
#include "tests/appliance/program.h"

using namespace quadrig;
using namespace quadrig::tests;
using Catch::Contains;

namespace {

nlohmann::json replayed(Arguments arguments) {
    const std::string report = scratch_directory() / "report.json";
    arguments.insert(arguments.begin(), "replay");
    arguments.insert(arguments.end(), {"--report", report});
    const Outcome outcome = quadrig_program(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return report_of(report);
}

std::string scene() {
    static const std::string file = scratch_file("scene.toml", small_scene());
    return file;
}

}  // namespace

TEST_CASE("A recording gives the same frames whatever the number of threads, time after time") {
    for (const auto& [flight, landscape] :
         {std::pair{"config/traces/netfdm-c172-takeoff.pcap", "config/scenes/takeoff.toml"},
          {"config/traces/cigi33-737-turn.pcapng", "config/scenes/turn.toml"}}) {
        std::set<std::string> hashes;
        std::set<std::vector<std::string>> frame_hashes;
        for (const char* threads : {"1", "2", "4", "2"}) {
            const auto report = replayed({shipped(flight), "--scene", shipped(landscape), "--size", "160x90", "--rate",
                                          "2", "--seconds", "8", "--fast", "--threads", threads});
            CHECK(report["machine"]["threads"] == std::stoi(threads));
            CHECK(report["frames"] == 16);
            hashes.insert(report["hash"].get<std::string>());
            frame_hashes.insert(report["frame_hashes"].get<std::vector<std::string>>());
        }
        CHECK(hashes.size() == 1);
        REQUIRE(frame_hashes.size() == 1);
        // Every frame looks different, or the hash would be of nothing.
        CHECK(std::set<std::string>(frame_hashes.begin()->begin(), frame_hashes.begin()->end()).size() == 16);
    }
}

TEST_CASE("In real time a frame is the same picture as with --fast, unless it was left out for being late") {
    const std::string flight = fdm_climb(90);
    const Arguments settings{flight, "--scene", scene(), "--size", "64x48", "--rate", "30"};
    Arguments fast = settings;
    fast.emplace_back("--fast");
    const auto all = replayed(fast)["frame_hashes"].get<std::vector<std::string>>();
    REQUIRE(all.size() == 45);
    const auto begin = std::chrono::steady_clock::now();
    const auto report = replayed(settings);
    const auto took = std::chrono::steady_clock::now() - begin;
    CHECK(took > std::chrono::milliseconds(1400));
    CHECK(report["real_time"] == true);
    CHECK(report["granted"].contains("timer_slack"));
    CHECK(report["timer_late_ms"]["max"] > 0.0);
    CHECK(report["frames"].get<std::size_t>() + report["repeated_frames"].get<std::size_t>() == all.size());
    const auto drawn = report["frame_hashes"].get<std::vector<std::string>>();
    REQUIRE(drawn.size() == report["frames"]);
    std::size_t next = 0;
    for (const std::string& hash : drawn) {
        while (next < all.size() && all[next] != hash) ++next;
        CHECK(next < all.size());
    }
}

TEST_CASE("The report tells what came over the link and what became of every frame") {
    const auto out = scratch_directory();
    const auto report =
        replayed({fdm_climb(60), "--scene", scene(), "--size", "48x32", "--rate", "20", "--fast", "--sink",
                  "png:" + (out / "p").string(), "--sink", "y4m:" + (out / "v.y4m").string(), "--sink", "none:"});
    CHECK(report["quadrig"] == "0.1.0");
    CHECK(report["schema"] == 1);
    for (const char* key : {"cpu", "cores", "simd", "threads", "build"}) CHECK(report["machine"].contains(key));
    CHECK_FALSE(report["machine"]["simd"].get<std::string>().empty());
    CHECK(report["image"] == nlohmann::json({{"width", 48}, {"height", 32}}));
    CHECK(report["rate_hz"] == 20.0);
    // 59 intervals of 16.667 ms and the first frame: 0, 50, ... 950 ms.
    CHECK(report["frames"] == 20);
    CHECK(report["deadline_misses"] == 0);
    CHECK(report["repeated_frames"] == 0);
    for (const char* stage : {"select", "outline", "sweep", "shade", "present"})
        for (const char* key : {"min", "p50", "p90", "p99", "p999", "max"}) {
            CHECK(report["stage_ms"][stage].contains(key));
            CHECK(report["frame_ms"].contains(key));
        }
    CHECK(report["frame_ms"]["min"] > 0.0);
    CHECK(report["quality"] == nlohmann::json({{"default", 20}}));
    const auto& link = report["links"].at(0);
    CHECK(link["url"] == "fdm:");
    CHECK(link["datagrams"] == 60);
    CHECK(link["bytes"] == 60 * 408);
    CHECK(link["frames"] == 60);
    CHECK(link["packets"] == nlohmann::json({{"net_fdm_24", 60}}));
    CHECK(link["rejected"].empty());
    CHECK(link["first_pose"]["altitude"] == Approx(595.0));
    CHECK(link["last_pose"]["altitude"] == Approx(600.9));
    CHECK(link["last_pose"]["latitude"] == Approx(47.26));
    CHECK(link["last_pose"]["heading"] == Approx(342.3));
    CHECK(link["last_pose"]["roll"] == Approx(-11.8));
    // A sample is up to its period old when its frame is drawn, which then takes its time.
    CHECK(report["latency_ms"]["max"] >= report["frame_ms"]["min"]);
    CHECK(report["latency_ms"]["max"] <= 16.668 + report["frame_ms"]["max"].get<double>());
    CHECK(report["frame_hashes"].size() == 20);
    REQUIRE(report["sinks"].size() == 3);
    for (const auto& sink : report["sinks"]) {
        CHECK(sink["frames"] == 20);
        CHECK(sink["dropped"] == 0);
    }
    CHECK(std::distance(std::filesystem::directory_iterator(out / "p"), {}) == 20);
    CHECK(read_y4m(text_of(out / "v.y4m")).frames == 20);
}

TEST_CASE("Standard output carries the video and nothing else") {
    const Outcome outcome = quadrig_program({"replay", fdm_climb(30), "--scene", scene(), "--size", "50x30", "--rate",
                                             "59.94", "--fast", "--sink", "y4m:-"});
    REQUIRE(outcome.status == 0);
    const Y4mStream video = read_y4m(outcome.out);
    CHECK(video.width == 50);
    CHECK(video.height == 30);
    CHECK(video.frames == 29);
    CHECK_THAT(video.header, Contains("F60000:1001") && Contains("C444"));
    CHECK_THAT(outcome.err, Contains("29 frames of 50x30") && Contains("net_fdm_24 30"));
}

TEST_CASE("A run ends where --frames or --seconds says, or with the recording") {
    const std::string flight = fdm_climb(60);
    const auto frames = [&](const Arguments& more) {
        Arguments arguments{flight, "--scene", scene(), "--size", "16x12", "--rate", "60", "--fast"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return replayed(arguments);
    };
    CHECK(frames({})["frames"] == 60);
    CHECK(frames({"--frames", "7"})["frames"] == 7);
    // The seventh datagram was captured 2 us after the seventh frame's time.
    CHECK(frames({"--frames", "7"})["links"][0]["datagrams"] == 6);
    CHECK(frames({"--seconds", "0.5"})["frames"] == 30);
    CHECK(frames({"--frames", "1000000"})["frames"] == 60);
    // What comes after the last frame is of the recording too.
    for (const Arguments& more : {Arguments{}, {"--frames", "1000000"}, {"--seconds", "1000"}})
        CHECK(frames(more)["links"][0]["datagrams"] == 60);
    const auto all = frames({})["frame_hashes"].get<std::vector<std::string>>();
    const auto some = frames({"--frames", "7"})["frame_hashes"].get<std::vector<std::string>>();
    CHECK(some == std::vector<std::string>(all.begin(), all.begin() + 7));
}

TEST_CASE("The overlay marks the middle of every picture") {
    const std::string flight = fdm_climb(3);
    const auto picture = [&](const Arguments& more) {
        const auto out = scratch_directory();
        Arguments arguments{flight, "--scene", scene(), "--size", "320x240", "--fast", "--sink", "png:" + out.string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        replayed(arguments);
        return display::read_png(out / "frame-000001.png");
    };
    const auto plain = picture({}), marked = picture({"--overlay"});
    const auto pixel = [](const display::Picture& p, int row, int column) {
        return p.pixels.at(static_cast<std::size_t>(4 * (row * p.width + column)));
    };
    CHECK(pixel(marked, 120, 160) == 255);
    CHECK(pixel(plain, 120, 160) < 255);
    CHECK(pixel(marked, 60, 250) == pixel(plain, 60, 250));
    CHECK(difference(plain, marked).mean > 0.0);
}

TEST_CASE("A contact sheet shows up to 36 frames of the run, evenly spaced") {
    // 60 frames: every second one; 5 frames: all.
    for (const auto& [frames, pictures, columns, rows] : {std::tuple{60, 30, 6, 5}, {5, 5, 5, 1}}) {
        const auto file = scratch_directory() / "sheet.png";
        const auto report =
            replayed({fdm_climb(frames), "--scene", scene(), "--size", "160x90", "--fast", "--contact-sheet", file});
        CHECK(report["sinks"][0]["frames"] == frames);
        const auto sheet = display::read_png(file);
        CHECK(sheet.width == columns * 164 + 4);
        CHECK(sheet.height == rows * 94 + 4);
        const auto blue = [&sheet, columns = columns](int i) {
            const int row = 4 + i / columns * 94 + 10, column = 4 + i % columns * 164 + 80;
            return sheet.pixels.at(static_cast<std::size_t>(4 * (row * sheet.width + column)) + 2);
        };
        CHECK(blue(0) > 60);  // the sky; the page itself is darker
        CHECK(blue(pictures - 1) > 60);
    }
}

TEST_CASE("A capture cut in the middle is played up to there, and that is said") {
    const std::string whole = text_of(fdm_climb(60));
    const std::string cut = scratch_file("cut.pcap", std::string_view(whole).substr(0, whole.size() / 2));
    const std::string report = scratch_directory() / "r.json";
    const Outcome outcome =
        quadrig_program({"replay", cut, "--scene", scene(), "--size", "16x12", "--fast", "--report", report});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.err, Contains(cut) && Contains("ends early"));
    const auto told = report_of(report);
    CHECK(told["links"][0]["datagrams"] == 29);
    CHECK(told["links"][0].contains("truncated"));
    CHECK(told["frames"] == 29);
}

TEST_CASE("Garbled datagrams are counted by reason and change nothing") {
    std::vector<Bytes> sound, garbled;
    for (int i = 0; i < 20; ++i) {
        sound.push_back(cigi_message(static_cast<std::uint32_t>(i), {14.0 + i, {}}));
        garbled.push_back(sound.back());
        Bytes cut = sound.back();
        cut.resize(cut.size() - 5);
        if (i % 5 == 2) garbled.insert(garbled.end(), {cut, Bytes(40, std::byte{0xFF})});
    }
    // Spread out so that the sound ones keep their times: half a period is free for the others.
    std::vector<Bytes> paired;
    for (const Bytes& datagram : sound) paired.insert(paired.end(), {datagram, Bytes(40, std::byte{0xFF})});
    const auto hash = [&](const std::vector<Bytes>& datagrams, int period) {
        return replayed({recording(datagrams, 8004, std::chrono::microseconds(period)), "--scene", scene(), "--size",
                         "32x24", "--fast", "--frames", "19"});
    };
    const auto clean = hash(sound, 16666), dirty = hash(paired, 8333);
    CHECK(clean["hash"] == dirty["hash"]);
    CHECK(dirty["links"][0]["rejected"].size() == 1);
    const auto mixed = hash(garbled, 16666);
    CHECK(mixed["links"][0]["rejected"]["truncated"] >= 3);
}

TEST_CASE("A recording without a single pose is a failure that says why") {
    const std::string flight = recording({host::test::message(host::ByteOrder::big, host::test::ig_control(1))}, 8004);
    const Outcome outcome = quadrig_program({"replay", flight, "--scene", scene(), "--fast"});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Contains("no pose of the ownship in 1 datagrams"));
}

TEST_CASE("A recording whose clock runs for days needs a limit") {
    const std::string flight =
        recording({fdm_message({}), fdm_message({}), fdm_message({})}, 5500, std::chrono::hours(20));
    Arguments arguments{"replay", flight, "--scene", scene(), "--fast", "--size", "8x8"};
    const Outcome refused = quadrig_program(arguments);
    CHECK(refused.status == 1);
    CHECK_THAT(refused.err, Contains("40 hours") && Contains("--seconds"));
    arguments.insert(arguments.end(), {"--seconds", "1"});
    CHECK(quadrig_program(arguments).status == 0);
}

TEST_CASE("A sink that fails ends a replay with a failure, its report made") {
    const std::string report = scratch_directory() / "r.json";
    const Outcome outcome = quadrig_program({"replay", fdm_climb(60), "--scene", scene(), "--size", "320x240", "--fast",
                                             "--sink", "y4m:/dev/full", "--report", report});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Contains("/dev/full"));
    CHECK(report_of(report)["sinks"][0]["failed"] > 0);
}

TEST_CASE("Of a recording with several flows the one is played whose protocol --link names, else the fullest") {
    constexpr std::uint32_t kRawIp = 101;
    host::test::PcapWriter writer(kRawIp);
    const auto add = [&](int i, const Bytes& message, std::uint16_t port, std::uint32_t host) {
        writer.packet(host::test::ipv4_udp(message, {.source = host, .destination_port = port}),
                      std::chrono::milliseconds(1'700'000'000'000 + 16 * i));
    };
    for (int i = 0; i < 30; ++i) {
        const auto frame = static_cast<std::uint32_t>(i);
        add(i, fdm_message({100.0, {}}), 5500, 1);
        if (i < 20) add(i, cigi_message(frame, {200.0, {}}), 8004, 2);
        if (i < 10) add(i, cigi_message(frame, {300.0, {}}), 8005, 3);
    }
    const auto file = scratch_directory() / "flows.pcap";
    host::test::write_file(file, writer.bytes());
    const auto link = [&](const Arguments& more) {
        Arguments arguments{file, "--scene", scene(), "--size", "16x12", "--fast"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return replayed(arguments)["links"][0];
    };
    for (const auto& fullest : {link({}), link({"--link", "fdm:"})}) {
        CHECK(fullest["frames"] == 30);
        CHECK(fullest["last_pose"]["altitude"] == Approx(681.0));
        CHECK(fullest["flow"] == "0.0.0.1 -> 127.0.0.1:5500");
    }
    const auto named = link({"--link", "cigi:"});
    CHECK(named["frames"] == 20);
    CHECK(named["lost"] == 0);
    CHECK(named["last_pose"]["altitude"] == Approx(781.0));
    CHECK(named["flow"] == "0.0.0.2 -> 127.0.0.1:8004");
    const Outcome none = quadrig_program({"replay", file, "--scene", scene(), "--fast", "--link", "can:"});
    CHECK(none.status == 1);
    CHECK_THAT(none.err, Contains("no datagram of a CANaerospace host in 60 packets"));
}
