// Models that the appliance places itself, for hosts that have no words for other bodies than their own.
#include <catch2/catch.hpp>
#include <csignal>
#include <thread>

#include "display/png_file.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/geodesy.h"
#include "tests/appliance/files.h"
#include "tests/appliance/host_socket.h"
#include "tests/appliance/program.h"

using namespace quadrig;
using namespace quadrig::tests;
using namespace std::chrono_literals;

namespace {

constexpr const char* kModel = "[[model]]\nmodel = \"x-29\"\nposition = [0, 60, 16]\nattitude = [70, 0, 20]\n";
constexpr glm::dvec3 kPlace(0, 60, 16);
constexpr Attitude kAttitude{{70.0}, {0.0}, {20.0}};

/// Where kPlace is on the earth; small_scene()'s origin is where the flights are.
GeodeticPosition geodetic_place() { return host::SceneFrame({{47.26}, {11.34}, 581.0}).geodetic({kPlace}); }

display::Picture rendered(const std::string& scene_text, const std::string& eye) {
    const auto out = scratch_directory() / "still.png";
    const Outcome outcome = quadrig_program({"render", scratch_file("s.toml", scene_text), "--eye", eye, "--attitude",
                                             "0,0,0", "--size", "160x120", "--fov", "60", "-o", out});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return display::read_png(out);
}

/// An appliance file beside a scene without drift.
std::filesystem::path appliance(const std::string& settings) {
    const auto file = scratch_file("appliance.toml", "scene = \"s.toml\"\nsize = [160, 120]\n" + settings);
    std::filesystem::copy(scratch_file("s.toml", still_scene()), file.parent_path() / "s.toml");
    return file;
}

/// What is seen until a host is there.
display::Picture waiting(const std::string& entity) {
    const auto out = scratch_directory();
    const Outcome outcome = quadrig_program({"run", appliance("links = [\"fdm://127.0.0.1:0\"]\n" + entity), "--frames",
                                             "20", "--sink", "png:" + out.string()});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    for (int frame = 19;; --frame) {
        const auto file = out / ("frame-0000" + std::string(frame < 10 ? "0" : "") + std::to_string(frame) + ".png");
        if (frame == 0 || std::filesystem::exists(file)) return display::read_png(file);
    }
}

Bytes fdm_there() {
    const GeodeticPosition there = geodetic_place();
    host::flightgear::NetFdm packet;
    packet.latitude = there.latitude.radians(), packet.longitude = there.longitude.radians();
    packet.altitude = there.altitude;
    packet.psi = static_cast<float>(kAttitude.heading.radians());
    packet.phi = static_cast<float>(kAttitude.roll.radians());
    Bytes bytes(host::flightgear::kSize24);
    host::flightgear::encode(packet, bytes);
    return bytes;
}

}  // namespace

TEST_CASE("A model stands where the appliance file puts it, in the scene or on the earth") {
    const auto expected = rendered(still_scene() + kModel, "0,0,2");
    REQUIRE(difference(expected, rendered(still_scene(), "0,0,2")).mean > 0.3);
    const auto in_scene = waiting("[[entity]]\nmodel = \"x-29\"\nposition = [0, 60, 16]\nattitude = [70, 0, 20]\n");
    CHECK(difference(in_scene, expected).largest == 0);
    const GeodeticPosition there = geodetic_place();
    std::ostringstream place;
    place.precision(17);
    place << "{ latitude = " << there.latitude.value << ", longitude = " << there.longitude.value
          << ", altitude = " << there.altitude << " }";
    const auto on_earth =
        waiting("[[entity]]\nmodel = \"x-29\"\nplace = " + place.str() + "\nattitude = [70, 0, 20]\n");
    CHECK(difference(on_earth, expected).mean < 0.01);
}

TEST_CASE("A model flies as a link of its own says, beside the host that carries the eye") {
    const auto out = scratch_directory();
    Program program({"run",
                     appliance("links = [\"cigi://127.0.0.1:0\"]\n[[entity]]\nmodel = \"x-29\"\n"
                               "link = \"fdm://127.0.0.1:0\"\n"),
                     "--sink", "png:" + (out / "p").string(), "--report", out / "r.json"});
    const auto host_port = program.number_after("cigi://127.0.0.1:0 listens on port ");
    const auto entity_port = program.number_after("fdm://127.0.0.1:0 listens on port ");
    REQUIRE(host_port);
    REQUIRE(entity_port);
    const HostSocket host(*host_port), other(*entity_port);
    const auto last_picture = [&] {
        std::filesystem::path last;
        for (const auto& entry : std::filesystem::directory_iterator(out / "p"))
            if (entry.path().extension() == ".png") last = std::max(last, entry.path());
        return display::read_png(last);
    };
    std::uint32_t frame = 0;
    const auto fly = [&](int count, bool both) {
        for (int i = 0; i < count; ++i) {
            host.send(cigi_message(++frame, {14.0, {}}));
            if (both) other.send(fdm_there());
            std::this_thread::sleep_for(16ms);
        }
    };
    fly(40, false);
    const auto alone = last_picture();
    fly(60, true);
    program.signal(SIGTERM);
    const Outcome outcome = program.wait();
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(difference(alone, rendered(still_scene(), "0,0,14")).mean < 0.02);
    CHECK(difference(last_picture(), rendered(still_scene() + kModel, "0,0,14")).mean < 0.02);
    CHECK(difference(last_picture(), alone).mean > 0.3);
    const auto links = report_of(out / "r.json")["links"];
    REQUIRE(links.size() == 2);
    CHECK(links[1]["entity"] == "x-29");
    CHECK(links[1]["frames"] == 60);
    CHECK(links[0]["packets"]["ig_control"] == 100);
}
