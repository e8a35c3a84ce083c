#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "tests/appliance/files.h"
#include "tests/appliance/program.h"

using namespace quadrig::tests;
using Catch::Contains;

namespace {

const Arguments kStill{"--eye", "0,0,8", "--attitude", "0,0,0", "--size", "64x48", "--fov", "60"};

Arguments operator+(Arguments left, const Arguments& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

std::string joined(const Arguments& words) {
    std::string line;
    for (const std::string& word : words) line += " " + word;
    return line;
}

}  // namespace

TEST_CASE("Help goes to standard output, names every command and option, and is a success") {
    const Outcome program = quadrig_program({"--help"});
    CHECK(program.status == 0);
    CHECK(program.err.empty());
    for (const char* command : {"render", "replay", "run", "bench", "check"})
        CHECK_THAT(program.out, Contains(command));
    const std::vector<std::pair<std::string, std::vector<std::string>>> commands{
        {"render",
         {"--eye", "--attitude", "--size", "--fov", "--time", "--output", "--object-ids", "--surface-ids", "--depth",
          "--reference", "--samples", "--threads", "--quality"}},
        {"replay",
         {"--scene", "--link", "--sink", "--size", "--fov", "--rate", "--frames", "--seconds", "--threads", "--quality",
          "--report", "--fast", "--overlay", "--contact-sheet", "--ignore-host-window"}},
        {"run",
         {"--scene", "--link", "--sink", "--size", "--fov", "--rate", "--frames", "--seconds", "--threads", "--quality",
          "--report", "--overlay", "APPLIANCE.toml", "SIGTERM"}},
        {"bench", {"--path", "--frames", "--size", "--threads", "--quality", "--report"}},
        {"check", {"FILE"}}};
    for (const auto& [command, options] : commands) {
        const Outcome help = quadrig_program({command, "--help"});
        CHECK(help.status == 0);
        CHECK_THAT(help.out, Contains("Example"));
        for (const std::string& option : options) CHECK_THAT(help.out, Contains(option));
    }
}

TEST_CASE("Every command that help names, and every option of it, is told in the README") {
    const std::string readme = text_of(shipped("appliance/README.md"));
    const std::string help = quadrig_program({"--help"}).out;
    const auto words_like = [](const std::string& text, const char* pattern) {
        std::set<std::string> words;
        const std::regex like(pattern);
        for (std::sregex_iterator at(text.begin(), text.end(), like), end; at != end; ++at) words.insert((*at)[1]);
        return words;
    };
    const auto commands = words_like(help.substr(help.find("Subcommands:")), "\n  ([a-z]+)  ");
    CHECK(commands.size() == 13);
    for (const std::string& command : commands) {
        CHECK_THAT(readme, Contains("\n    quadrig " + command + " "));
        for (const std::string& option : words_like(quadrig_program({command, "--help"}).out, "(--[a-z-]+)"))
            CHECK_THAT(readme, Contains(option));
    }
}

TEST_CASE("Every file that the examples in help take from config is there") {
    const std::regex file("config/[a-z0-9_./-]*[a-z0-9]");
    std::string help;
    for (const char* command : {"render", "replay", "run", "send", "bench", "check", "outline", "accuracy", "generate"})
        help += quadrig_program({command, "--help"}).out;
    int named = 0;
    for (std::sregex_iterator at(help.begin(), help.end(), file), end; at != end; ++at, ++named) {
        INFO(at->str());
        CHECK(std::filesystem::exists(shipped(at->str())));
    }
    CHECK(named > 15);
}

TEST_CASE("The version is told on standard output") {
    const Outcome version = quadrig_program({"--version"});
    CHECK(version.status == 0);
    CHECK(version.out == "quadrig 0.1.0\n");
}

TEST_CASE("Wrong use is exit status 2, with the reason on standard error and nothing on standard output") {
    const std::string scene = scratch_file("scene.toml", small_scene());
    const std::string flight = shipped("config/traces/cigi33-737-turn.pcapng");
    const std::string cameras = scratch_file("cameras.json", R"([{"eye":[0,0,8],"attitude":[0,0,0],"fov":60}])");
    const std::string picture = scratch_directory() / "never.png";
    const Arguments render{"render", scene, "-o", picture};
    const std::string nobody(64, 'x');  // longer than names are: no name server is asked
    struct Case {
        Arguments arguments;
        std::string reason;
    };
    const std::vector<Case> cases{
        {{}, "subcommand"},
        {{"fly"}, "fly"},
        {{"--frobnicate"}, "--frobnicate"},
        {{"render"}, "required"},
        {render, "--eye"},
        {{"render", scene, "--eye", "0,0,8", "--attitude", "0,0,0", "--size", "64x48", "-o", picture}, "--fov"},
        {Arguments{"render", scene} + kStill, "nothing to make"},
        {render + kStill + Arguments{"--frobnicate"}, "--frobnicate"},
        {render + kStill + Arguments{"second.toml"}, "second.toml"},
        {render + kStill + Arguments{"--depth", picture}, picture + " is given twice"},
        {render + kStill + Arguments{"--depth", "/." + picture},
         "/." + picture + " is given twice (as " + picture + ")"},
        {{"run", "--scene", scene, "--link", "fdm://127.0.0.1:0", "--sink", "y4m:x.y4m", "--report", "./x.y4m"},
         "./x.y4m is given twice (as y4m:x.y4m)"},
        {{"run", "--scene", scene, "--link", "fdm://127.0.0.1:0", "--sink", "png:x", "--sink", "png:./x"}, "png:./x"},
        {{"run", "--scene", scene, "--link", "fdm://127.0.0.1:0", "--record", "x", "--report", "x"},
         "x is given twice"},
        {Arguments{"render", scene} + kStill + Arguments{"--depth", "/." + scene},
         "/." + scene + " would write over " + scene + ", which is read"},
        {{"replay", flight, "--scene", scene, "--fast", "--sink", "y4m:" + flight}, "would write over " + flight},
        {{"run", "--scene", scene, "--link", "fdm://127.0.0.1:0", "--record", scene}, "would write over " + scene},
        {{"bench", scene, "--path", cameras, "--report", cameras}, "would write over " + cameras},
        {render + kStill + Arguments{"--samples", "2"}, "--reference"},
        {render + kStill + Arguments{"--reference", "--samples", "0"}, "--samples"},
        {render + kStill + Arguments{"--reference", "--quality", "best"}, "--quality"},
        {render + kStill + Arguments{"--quality", "nice"}, "nice"},
        {render + kStill + Arguments{"--threads", "0"}, "--threads"},
        {render + kStill + Arguments{"--threads", "two"}, "two"},
        {render + kStill + Arguments{"--time", "nan"}, "nan"},
        {render + kStill + Arguments{"--time", "1e10"}, "expected seconds in -1e9..1e9"},
        {render + kStill + Arguments{"--time"}, "--time"},
        {render + Arguments{"--eye", "0,0", "--attitude", "0,0,0", "--size", "64x48", "--fov", "60"}, "0,0"},
        {render + Arguments{"--eye", "0,0,8,1", "--attitude", "0,0,0", "--size", "64x48", "--fov", "60"}, "0,0,8,1"},
        {render + Arguments{"--eye", "0,inf,8", "--attitude", "0,0,0", "--size", "64x48", "--fov", "60"}, "inf"},
        {render + Arguments{"--eye", "0,0,8", "--attitude", "a,0,0", "--size", "64x48", "--fov", "60"}, "a,0,0"},
        {render + Arguments{"--eye", "0,0,8", "--attitude", "0,0,0", "--size", "64", "--fov", "60"}, "'64'"},
        {render + Arguments{"--eye", "0,0,8", "--attitude", "0,0,0", "--size", "0x48", "--fov", "60"}, "0x48"},
        {render + Arguments{"--eye", "0,0,8", "--attitude", "0,0,0", "--size", "64x16385", "--fov", "60"}, "16384"},
        {render + Arguments{"--eye", "0,0,8", "--attitude", "0,0,0", "--size", "64x48x", "--fov", "60"}, "64x48x"},
        {render + Arguments{"--eye", "0,0,8", "--attitude", "0,0,0", "--size", "64x48", "--fov", "180"}, "180"},
        {render + Arguments{"--eye", "0,0,8", "--attitude", "0,0,0", "--size", "64x48", "--fov", "0"}, "below 180"},
        {{"send", flight, "--to", "cigi://127.0.0.1:0"}, "nobody listens at port 0"},
        {{"send", flight, "--to", "cigi://127.0.0.1:1", "--speed", "1e-300"}, "expected a factor in 1e-3..1e6"},
        {{"replay", flight}, "--scene"},
        {{"replay", "--scene", scene}, "recording"},
        {{"replay", flight, "--scene", scene, "--link", "can://vcan0"}, "without an address"},
        {{"replay", flight, "--scene", scene, "--link", "cigi://127.0.0.1:8004"}, "without an address"},
        {{"replay", flight, "--scene", scene, "--sink", "mpeg:x"}, "mpeg:x"},
        {{"replay", flight, "--scene", scene, "--sink", "png:"}, "png:"},
        {{"replay", flight, "--scene", scene, "--rate", "0.5"}, "hertz"},
        {{"replay", flight, "--scene", scene, "--frames", "0"}, "'0': expected a whole number of at least 1"},
        {{"replay", flight, "--scene", scene, "--frames", "5", "--seconds", "1"}, "--frames"},
        {{"replay", flight, "--scene", scene, "--seconds", "-1"}, "-1"},
        {{"replay", flight, "--scene", scene, "--sink", "y4m:-", "--sink", "none:", "--sink", "y4m:-"},
         "y4m:- is given twice"},
        {{"run", "--scene", scene, "--link", "fdm://127.0.0.1:0", "--sink", "png:x", "--sink", "png:x"}, "png:x"},
        {{"run", "--link", "fdm://127.0.0.1:0"}, "--scene"},
        {{"run", "--scene", scene}, "--link"},
        {{"run", "--scene", scene, "--link", "fdm:"}, "ADDRESS:PORT"},
        {{"run", "--scene", scene, "--link", "fdm://localhost:99999"}, "99999"},
        {{"run", "--scene", scene, "--link", "fdm://127.0.0.300:5500"}, "bad address '127.0.0.300'"},
        {{"run", "--scene", scene, "--link", "fdm://" + nobody + ":5500"}, "host '" + nobody + "'"},
        {{"run", "--scene", scene, "--link", "cigi://127.0.0.1:0?version=5"}, "version"},
        {{"run", "--scene", scene, "--link", "modbus://127.0.0.1:0?word_order=up"}, "word_order"},
        {{"bench", scene}, "--path"},
        {{"bench", scene, "--path", cameras, "--frames", "-3"}, "'-3': expected a whole number of at least 1"},
        {{"render", scene, "--eye", "0,2e9,8"}, "'0,2e9,8': expected three numbers in -1e9..1e9"},
        {render + kStill + Arguments{"--depth", ""}, "--depth: '': expected a file's name"},
        {Arguments{"render", scene} + kStill + Arguments{"--output", ""}, "--output: '': expected a file's name"},
        {{"run", "", "--scene", scene, "--link", "fdm://127.0.0.1:0", "--frames", "1"},
         "appliance: '': expected a file"},
        {{"replay", flight, "--scene", scene, "--report", "--fast"}, "--report: '--fast': expected a file's name"},
        {{"replay", flight, "--scene", scene, "--rate", "2000"}, "--rate: '2000': expected hertz in 1..1000"},
        {{"replay", flight, "--scene", scene, "--sink", "tv:"}, "--sink: 'tv:': expected a sink"},
        {{"send", flight, "--to", "nowhere"}, "--to: link 'nowhere'"},
        {{"check"}, "required"},
        {{"check", scene, scene}, scene},
    };
    for (const Case& wrong : cases) {
        INFO("quadrig" << joined(wrong.arguments));
        const Outcome outcome = quadrig_program(wrong.arguments);
        INFO(outcome.err);
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, Contains(wrong.reason));
        CHECK_THAT(outcome.err, Contains("--help"));
    }
    CHECK_FALSE(std::filesystem::exists(picture));
}

TEST_CASE("What cannot be done is exit status 1, with the reason on standard error") {
    const std::string scene = scratch_file("scene.toml", small_scene());
    const std::string flight = shipped("config/traces/cigi33-737-turn.pcapng");
    const std::string empty = scratch_file("empty.pcap", "");
    const std::string bad_scene = scratch_file(
        "bad.toml", "[sun]\nazimuth = 10\n[[object]]\nellipsoid = { centre = [0, 0], semi_axes = [1, 1, 1] }\n");
    const std::string bad_settings = scratch_file("bad-appliance.toml", "size = [0, 48]\n");
    const std::string bad_cameras = scratch_file("cameras.json", "[{\"eye\": [0, 0]}]");
    const std::string nowhere = scratch_directory() / "missing" / "x.png";
    struct Case {
        Arguments arguments;
        std::string reason;
    };
    const std::vector<Case> cases{
        {Arguments{"render", "no-such.toml"} + kStill + Arguments{"-o", "x.png"}, "no-such.toml"},
        {Arguments{"render", bad_scene} + kStill + Arguments{"-o", "x.png"},
         bad_scene + ":4: key 'object[0].ellipsoid"},
        {Arguments{"render", scene} + kStill + Arguments{"-o", nowhere}, nowhere},
        {{"replay", "no-such.pcap", "--scene", scene}, "no-such.pcap"},
        {{"replay", empty, "--scene", scene}, empty},
        {{"replay", scene, "--scene", scene}, scene},
        {{"replay", flight, "--scene", bad_scene}, bad_scene + ":4:"},
        {{"replay", flight, "--scene", scene, "--link", "fdm:", "--fast"}, flight},
        {{"replay", flight, "--scene", scene, "--fast", "--frames", "1", "--sink", "png:/proc/none"}, "/proc/none"},
        {{"replay", flight, "--scene", scene, "--fast", "--frames", "1", "--size", "8x8", "--report", "/proc/none/r"},
         "/proc/none/r"},
        {{"run", bad_settings}, bad_settings + ":1: key 'size[0]'"},
        {{"run", "--scene", bad_scene, "--link", "fdm://127.0.0.1:0"}, bad_scene + ":4:"},
        {{"bench", scene, "--path", bad_cameras}, "[0].eye"},
        {{"check", bad_scene}, bad_scene + ":4:"},
        {{"check", bad_settings}, bad_settings + ":1: key 'size[0]'"},
        {{"check", bad_cameras}, "[0].eye"},
        {{"check", empty}, empty},
        {{"gallery", "-o", scratch_directory(), "--scenes", nowhere}, nowhere + ": cannot be read"},
    };
    for (const Case& impossible : cases) {
        INFO("quadrig" << joined(impossible.arguments));
        const Outcome outcome = quadrig_program(impossible.arguments);
        INFO(outcome.err);
        CHECK(outcome.status == 1);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, Contains(impossible.reason));
    }
}

TEST_CASE("A file larger than the system allows is a failure, with the reason, and is not left behind") {
    const std::string out = scratch_directory(), scene = scratch_file("scene.toml", small_scene());
    const std::string draw = "ulimit -f 1; " + std::string(QUADRIG_PROGRAM) + " render '" + scene + "'" +
                             joined(kStill) + " --depth '" + out + "/k.npy' 2>'" + out + "/err'";
    CHECK(WEXITSTATUS(std::system(draw.c_str())) == 1);
    CHECK_THAT(text_of(out + "/err"), Contains("k.npy: cannot be written: File too large"));
    CHECK_FALSE(std::filesystem::exists(out + "/k.npy"));
}

TEST_CASE("Standard output that cannot be written to is a failure") {
    const std::string scene = scratch_file("scene.toml", small_scene());
    for (const std::string& asked : std::vector<std::string>{"check '" + scene + "'", "generate '" + scene + "'",
                                                             "--help", "run --help", "--version"}) {
        INFO(asked);
        const std::string command = std::string(QUADRIG_PROGRAM) + " " + asked + " 2>/dev/null >/dev/full";
        CHECK(WEXITSTATUS(std::system(command.c_str())) == 1);
    }
}

TEST_CASE("Nothing else goes where the video on standard output goes, but two files may go to a device") {
    const std::string out = scratch_directory(), scene = scratch_file("scene.toml", small_scene());
    const std::string flight = shipped("config/traces/canaerospace-c172-takeoff.log");
    const std::string play = std::string(QUADRIG_PROGRAM) + " replay '" + flight +
                             "' --fast --frames 2 --size 8x8 --scene '" + scene + "' --sink y4m:- --report ";
    const auto status = [&](const std::string& rest) {
        return WEXITSTATUS(std::system(("cd '" + out + "'; { " + play + rest).c_str()));
    };
    for (const std::string& rest :
         std::vector<std::string>{"/dev/stdout 2>err >video; }", "video 2>err >video; }",
                                  "/dev/stdout 2>err; echo $? >code; } | cat >video; exit $(cat code)"}) {
        INFO(rest);
        CHECK(status(rest) == 2);
        CHECK_THAT(text_of(out + "/err"), Contains("is given twice (as y4m:-)"));
    }
    CHECK(status("/dev/null 2>err >/dev/null; }") == 0);
    CHECK(status("report.json 2>err >video; }") == 0);
    CHECK(read_y4m(text_of(out + "/video")).frames == 2);
}

TEST_CASE("A standard stream that was closed is no output file: nothing but its own goes into one") {
    const std::string out = scratch_directory(), scene = scratch_file("scene.toml", small_scene());
    const std::string program = QUADRIG_PROGRAM, flight = shipped("config/traces/canaerospace-c172-takeoff.log");
    const std::string record = program + " record NAME --link fdm://127.0.0.1:0 --seconds 0.05";
    const auto status = [](const std::string& command) { return WEXITSTATUS(std::system(command.c_str())); };
    CHECK(status("cd " + out + "; " + record + " 2>err && mv NAME open") == 0);
    CHECK(status("cd " + out + "; " + record + " <&- >&- 2>&- && mv NAME closed") == 0);
    CHECK(std::filesystem::file_size(out + "/open") == std::filesystem::file_size(out + "/closed"));
    CHECK(status(program + " check '" + scene + "' >&- 2>'" + out + "/err'") == 1);
    CHECK(status(program + " replay '" + flight + "' --fast --frames 2 --size 8x8 --sink y4m:- --scene '" + scene +
                 "' <&- >&- 2>'" + out + "/err'") == 1);
    CHECK_THAT(text_of(out + "/err"), Contains("y4m:-: cannot be written: Bad file descriptor"));
}

TEST_CASE(
    "A file that is read twice, to tell what it is, is refused where it is a pipe, and nothing of it is lost unseen") {
    const std::string scene = scratch_file("scene.toml", small_scene());
    const std::string log = shipped("config/traces/canaerospace-c172-takeoff.log");
    const std::string program = QUADRIG_PROGRAM, err = scratch_directory() / "err";
    for (const std::string& command : std::vector<std::string>{
             "cat '" + scene + "' | " + program + " check /dev/stdin",
             "head -100 '" + log + "' | " + program + " replay /dev/stdin --fast --size 8x8 --scene '" + scene + "'"}) {
        INFO(command);
        CHECK(WEXITSTATUS(std::system((command + " 2>'" + err + "'").c_str())) == 1);
        CHECK_THAT(text_of(err), Contains("/dev/stdin: expected a regular file"));
    }
}
