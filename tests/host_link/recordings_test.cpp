// The recordings that travel with the project, through capture reader and session, against pose tables of other
// programs.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "host_link/capture.h"
#include "host_link/recorded_frames.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;

namespace {

const std::filesystem::path kTraces = std::filesystem::path(QUADRIG_SOURCE_DIR) / "config/traces";

struct Row {
    std::size_t packet = 0;
    double seconds = 0, latitude = 0, longitude = 0, altitude = 0, heading = 0, pitch = 0, roll = 0;
};

std::vector<Row> pose_table(const std::filesystem::path& path) {
    std::ifstream file(path);
    REQUIRE(file);
    std::string line;
    std::getline(file, line);
    REQUIRE(line.starts_with("packet,t_s,lat_deg,lon_deg,alt_m,heading_deg,pitch_deg,roll_deg"));
    std::vector<Row> rows;
    while (std::getline(file, line)) {
        std::ranges::replace(line, ',', ' ');
        std::istringstream cells(line);
        Row r;
        cells >> r.packet >> r.seconds >> r.latitude >> r.longitude >> r.altitude >> r.heading >> r.pitch >> r.roll;
        REQUIRE(cells);
        rows.push_back(r);
    }
    return rows;
}

struct Played {
    Capture capture;
    std::vector<HostState> states;  ///< after each datagram
    LinkStatistics statistics;
};

Played play(const std::string& name, const GeodeticPosition& origin) {
    Played played{read_capture(kTraces / name), {}, {}};
    SessionOptions options;
    options.protocol = played.capture.protocol;
    options.scene_origin = origin;
    Session session(options);
    for (const auto& datagram : played.capture.datagrams) {
        session.accept(played.capture.payload(datagram), datagram.captured);
        played.states.push_back(session.state());
    }
    played.statistics = session.statistics();
    return played;
}

void check_poses(const Played& played, const std::vector<Row>& rows, double attitude_error) {
    REQUIRE(rows.size() > 40);
    for (const Row& row : rows) {
        INFO("packet " << row.packet);
        REQUIRE(row.packet < played.states.size());
        const PoseSample& pose = played.states[row.packet].pose.value();
        CHECK(pose.sequence == row.packet + 1);
        CHECK(std::abs(pose.position.latitude.value - row.latitude) <= 1e-11);
        CHECK(std::abs(pose.position.longitude.value - row.longitude) <= 1e-11);
        CHECK(std::abs(pose.position.altitude - row.altitude) <= 1e-5);
        CHECK(std::abs(std::remainder(pose.attitude.heading.value - row.heading, 360.0)) <= attitude_error);
        CHECK(std::abs(pose.attitude.pitch.value - row.pitch) <= attitude_error);
        CHECK(std::abs(std::remainder(pose.attitude.roll.value - row.roll, 360.0)) <= attitude_error);
        const Time first = played.capture.datagrams.front().captured;
        CHECK(std::abs(std::chrono::duration<double>(pose.arrival - first).count() - row.seconds) < 1e-6);
    }
    CHECK(rows.back().packet + 1 == played.states.size());
}

}  // namespace

TEST_CASE("Every pose of the recorded net_fdm flight agrees with the simulator's own log") {
    const Played played = play("netfdm-c172-takeoff.pcap", {{29.76}, {-95.16}, 0.0});
    CHECK(played.capture.protocol == Protocol::flightgear_fdm);
    CHECK(text(played.capture.flow) == "127.0.0.1 -> 127.0.0.1:5511");
    CHECK_FALSE(played.capture.truncated.has_value());
    check_poses(played, pose_table(kTraces / "netfdm-c172-takeoff.csv"), 5e-5);
    CHECK(played.statistics.frames == 2880);
    CHECK(played.statistics.bytes == 2880 * 408);
    CHECK(packets_by_name(played.statistics) == NamedCounts{{"net_fdm_24", 2880}});
    CHECK(rejected_by_reason(played.statistics).empty());
    // cur_time is a constant in this flight.
    for (const auto& state : played.states) REQUIRE_FALSE(state.pose->source_time.has_value());
}

TEST_CASE(
    "Every pose of the recorded CIGI flight agrees with tshark's reading, and so does all the rest of its state") {
    const Played played = play("cigi33-737-turn.pcapng", {{47.2}, {122.0}, 0.0});
    CHECK(played.capture.protocol == Protocol::cigi);
    CHECK(text(played.capture.flow) == "127.0.0.1 -> 127.0.0.1:8004");
    check_poses(played, pose_table(kTraces / "cigi33-737-turn.csv"), 6e-4);
    CHECK(packets_by_name(played.statistics) == NamedCounts{{"ig_control", 3600},
                                                            {"entity_control", 3600},
                                                            {"celestial_sphere_control", 60},
                                                            {"atmosphere_control", 60},
                                                            {"view_control", 3600},
                                                            {"view_definition", 1}});
    CHECK(rejected_by_reason(played.statistics).empty());
    CHECK(played.statistics.frames == 3600);
    CHECK(played.statistics.lost + played.statistics.duplicate + played.statistics.reordered +
              played.statistics.restarts ==
          0);

    const HostState& first = played.states.front();
    CHECK(first.mode == Mode::operate);
    CHECK_FALSE(first.smoothing);
    CHECK(first.visibility == 20000.0);
    CHECK(first.utc->year == 2024);
    CHECK(first.utc->month == 6);
    CHECK(first.utc->day == 21);
    CHECK(first.utc->hour == 12);
    CHECK(first.utc->minute == 30);
    CHECK(first.window->left.value == -30.0);
    CHECK(first.window->right.value == 30.0);
    CHECK(first.window->top.value == 22.5);
    CHECK(first.window->bottom.value == -22.5);
    CHECK(glm::dvec3(first.mount->offset) == glm::dvec3(0.0));
    CHECK(played.states.back().host_frame == 3599);
}

TEST_CASE("Every pose of the recorded CIGI 4.0 flight agrees with the class library's reading") {
    const Played played = play("cigi40-f16-climb.pcap", {{47.1}, {122.0}, 0.0});
    CHECK(played.capture.protocol == Protocol::cigi);
    check_poses(played, pose_table(kTraces / "cigi40-f16-climb.csv"), 5e-5);
    CHECK(packets_by_name(played.statistics) == NamedCounts{{"ig_control", 2500},
                                                            {"entity_control", 42},
                                                            {"celestial_sphere_control", 42},
                                                            {"atmosphere_control", 42},
                                                            {"view_control", 2500},
                                                            {"view_definition", 1},
                                                            {"entity_position", 2500}});
    CHECK(rejected_by_reason(played.statistics).empty());
    CHECK(played.statistics.lost + played.statistics.duplicate + played.statistics.reordered +
              played.statistics.restarts ==
          0);
}

TEST_CASE("The host's time stamps of the recorded CIGI flight rise with every pose and keep pace with the capture") {
    const Played played = play("cigi33-737-turn.pcapng", {{47.2}, {122.0}, 0.0});
    const auto& first = played.states.front().pose.value();
    std::optional<Time> last;
    for (const auto& state : played.states) {
        const Time now = state.pose->source_time.value();
        if (last) REQUIRE(now > *last);
        last = now;
        const Time drift = (now - first.source_time.value()) - (state.pose->arrival - first.arrival);
        REQUIRE(std::chrono::abs(drift) < std::chrono::milliseconds(100));
    }
    CHECK(played.states.back().earlier->source_time < played.states.back().pose->source_time);
}

TEST_CASE("tshark and we read the same numbers in every packet of the recorded CIGI flight") {
    const Played played = play("cigi33-737-turn.pcapng", {{47.2}, {122.0}, 0.0});
    const auto rows =
        tshark_fields(kTraces / "cigi33-737-turn.pcapng",
                      {"cigi.ig_control.host_frame_number", "cigi.ig_control.timestamp", "cigi.entity_control.lat_xoff",
                       "cigi.entity_control.lon_yoff", "cigi.entity_control.alt_zoff", "cigi.entity_control.yaw"});
    REQUIRE(rows.size() == played.states.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const PoseSample& pose = played.states[i].pose.value();
        REQUIRE(std::stoul(rows[i][0]) == played.states[i].host_frame.value());
        REQUIRE(Time(std::stoll(rows[i][1]) * 10000) == pose.source_time.value());
        REQUIRE(std::stod(rows[i][2]) == Approx(pose.position.latitude.value).epsilon(1e-14));
        REQUIRE(std::stod(rows[i][3]) == Approx(pose.position.longitude.value).epsilon(1e-14));
        REQUIRE(std::stod(rows[i][4]) == Approx(pose.position.altitude).epsilon(1e-14));
        REQUIRE(std::stod(rows[i][5]) == Approx(pose.attitude.heading.value).epsilon(1e-5));
    }
}

TEST_CASE("The recordings of one run's links stand beside one another, a log only where it can be one") {
    CHECK(recording_of_entity("a/flight.pcapng", 2, Protocol::flightgear_fdm) == "a/flight.entity-2.pcapng");
    CHECK(recording_of_entity("flight.log", 1, Protocol::canaerospace) == "flight.entity-1.log");
    CHECK(recording_of_entity("flight.log", 1, Protocol::cigi) == "flight.entity-1.pcapng");
    CHECK(recording_of_entity("flight", 3, Protocol::modbus) == "flight.entity-3");
}
