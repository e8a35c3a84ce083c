#include <catch2/catch.hpp>

#include "config/quality_ladder.h"
#include "tests/appliance/files.h"
#include "tests/appliance/flights.h"
#include "tests/appliance/program.h"

using namespace quadrig::tests;
using Catch::Contains;

namespace {

std::string said_of(const std::string& file) {
    const Outcome outcome = quadrig_program({"check", file});
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    return outcome.out;
}

}  // namespace

TEST_CASE("Check says what is in a scene") {
    CHECK_THAT(said_of(scratch_file("scene.toml", small_scene())),
               Contains("small") && Contains("4 (3 ellipsoids, 1 hill") && Contains("grass"));
    CHECK_THAT(said_of(scratch_file("empty.toml", "")), Contains("objects:     0"));
}

TEST_CASE("Check says what is in a recording, by its contents") {
    const auto flight = fdm_climb(60);
    const std::string said = said_of(flight);
    CHECK_THAT(said, Contains("FlightGear FDM") && Contains("60 poses in 0.983 s") && Contains("127.0.0.1:5500"));
    CHECK_THAT(said, Contains("latitude 47.260000, longitude 11.340000, altitude 595.00 m"));
    CHECK_THAT(said, Contains("net_fdm_24 60") && Contains("rejected:    none"));
    CHECK(said_of(scratch_file("any-name", text_of(flight))) == said);
    CHECK_THAT(said_of(shipped("config/traces/cigi33-737-turn.pcapng")), Contains("CIGI") && Contains("3600 poses"));
}

TEST_CASE("Check says what a cut recording holds, and that it is cut") {
    const std::string whole = text_of(fdm_climb(60));
    const std::string cut = scratch_file("cut.pcap", std::string_view(whole).substr(0, whole.size() / 2));
    const Outcome outcome = quadrig_program({"check", cut});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("29 poses"));
    CHECK_THAT(outcome.err, Contains(cut) && Contains("ends early"));
}

TEST_CASE("Check says what an appliance file asks for, and looks into its scene") {
    const auto file = scratch_file("appliance.toml",
                                   "scene = \"scene.toml\"\nlinks = [\"cigi://127.0.0.1:8004\", \"fdm://:5500\"]\n"
                                   "sinks = [\"png:out\"]\nsize = [640, 480]\nfov = 75\nrate = 59.94\nthreads = 2\n"
                                   "quality = \"best\"\n"
                                   "[[entity]]\nmodel = \"x-29\"\nlink = \"modbus://:1502\"\n"
                                   "[[entity]]\nmodel = \"x-29\"\ntype = 12\n");
    const Outcome without = quadrig_program({"check", file});
    CHECK(without.status == 1);
    CHECK_THAT(without.err, Contains("scene.toml"));
    std::filesystem::copy(scratch_file("scene.toml", small_scene()), file.parent_path() / "scene.toml");
    CHECK_THAT(said_of(file), Contains("cigi://127.0.0.1:8004") && Contains("fdm://:5500") && Contains("png:out") &&
                                  Contains("640x480") && Contains("75 degrees") && Contains("59.94") &&
                                  Contains("best") && Contains("x-29, driven by modbus://:1502") &&
                                  Contains("x-29, the host's of type 12"));
}

TEST_CASE("Mistakes in an appliance file are told with file, line and key") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"links = \"fdm:\"", "key 'links': expected an array of strings"},
        {"links = [\"fdm://127.0.0.1:1\", 7]", "key 'links[1]': expected a string"},
        {"links = [\"fdm:\"]", "key 'links[0]': expected a link with ADDRESS:PORT"},
        {"links = [\"smoke://x:1\"]", "key 'links[0]'"},
        {"sinks = [\"none:\", \"tv:\"]", "key 'sinks[1]': expected png:DIRECTORY"},
        {"size = [640.5, 480]", "key 'size[0]'"},
        {"size = [640]", "key 'size'"},
        {"fov = 180", "key 'fov'"},
        {"rate = 0", "key 'rate'"},
        {"threads = 1.5", "key 'threads'"},
        {"quality = \"nice\"",
         "key 'quality': expected " + quadrig::config::quality_names(quadrig::config::shipped_ladder())},
        {"scene = \"\"", "key 'scene'"},
        {"colour = 3", "key 'colour': expected one of"},
        {"entity = [{ model = \"x-29\" }]", "key 'entity[0]': expected one of type, position, place, link, found none"},
        {"entity = [{ model = \"x-29\", type = 3, position = [0, 0, 0] }]", "link, found more"},
        {"entity = [{ model = \"x-29\", type = 3, attitude = [0, 0, 0] }]",
         "key 'entity[0].attitude': expected position"},
        {"entity = [{ model = \"x-29\", link = \"fdm:\" }]", "key 'entity[0].link': expected a link with ADDRESS:PORT"},
        {"entity = [{ model = \"x-29\", place = { latitude = 91, longitude = 0, altitude = 0 } }]",
         "key 'entity[0].place.latitude'"},
        {"entity = [{ position = [0, 0, 0] }]", "key 'entity[0].model'"},
        {"entity = [{ model = \"x-30\", type = 3 }]", "key 'entity[0].model': expected the name of a file in"},
    };
    for (const auto& [line, complaint] : cases) {
        const std::string file = scratch_file("appliance.toml", "# settings\n\n" + line + "\n[scenery]\n");
        INFO(line);
        const Outcome outcome = quadrig_program({"check", scratch_file("a.toml", "rate = 60\n" + line + "\n")});
        if (!line.starts_with("rate")) {
            CHECK(outcome.status == 1);
            INFO(outcome.err);
            CHECK_THAT(outcome.err, Contains("a.toml:2: ") && Contains(complaint));
        }
        CHECK(quadrig_program({"run", file}).status == 1);
    }
}

TEST_CASE("Check counts the cameras of a path") {
    CHECK_THAT(said_of(scratch_file("c.json", R"([{"eye":[0,0,8],"attitude":[0,0,0],"fov":60}])")),
               Contains("1 camera"));
}
