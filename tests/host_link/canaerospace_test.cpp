// CANaerospace messages: the specification's own examples, other programs' readings, and the commit rule.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "host_link/canaerospace_pose.h"
#include "host_link/capture.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::canaerospace;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

const std::filesystem::path kTraces = std::filesystem::path(QUADRIG_SOURCE_DIR) / "config/traces";

CanFrame frame_of(const std::string& text) {
    const auto line = read_candump_line("(1.000000) can0 " + text);
    REQUIRE(line);
    return line->frame;
}

host::canaerospace::Message message_of(const std::string& text) {
    const auto decoded = canaerospace::decode(frame_of(text));
    REQUIRE(std::holds_alternative<canaerospace::Message>(decoded));
    return std::get<canaerospace::Message>(decoded);
}

SessionOptions can_options() {
    SessionOptions options;
    options.protocol = Protocol::canaerospace;
    options.scene_origin = {{47.0}, {11.0}, 0.0};
    return options;
}

/// A host that sends whole poses: eight messages each, by the recorded flight's pattern.
struct CanHost {
    std::uint8_t channel = 0;
    std::uint8_t code = 0;

    std::vector<canaerospace::Message> pose(double latitude, float height = 100.0F) {
        std::vector<canaerospace::Message> all{with_float(311, code, 2.0F), with_float(312, code, -3.0F),
                                               with_float(321, code, -90.0F)};
        const auto pair_code = static_cast<std::uint8_t>(2 * code);
        for (const auto& half : with_double(1036, pair_code, latitude)) all.push_back(half);
        for (const auto& half : with_double(1037, pair_code, 11.25)) all.push_back(half);
        all.push_back(with_float(1038, code, height));
        ++code;
        for (auto& message : all) message.channel = channel;
        return all;
    }
};

Verdict give(Session& session, const canaerospace::Message& message, Time arrival) {
    return session.accept(can_record(canaerospace::encode(message)), arrival);
}
Verdict give(Session& session, const std::vector<canaerospace::Message>& messages, Time arrival) {
    Verdict last = Verdict::rejected;
    for (const auto& message : messages) last = give(session, message, arrival);
    return last;
}

}  // namespace

TEST_CASE("CANaerospace messages read as the specification's examples mean them") {
    CHECK(message_of("141#0102000742B40000").id == 321);
    CHECK(number_of(message_of("141#0102000742B40000")) == 90.0);
    CHECK(message_of("141#0102000742B40000").code == 7);
    CHECK(message_of("00010130#0102000042B40000").id == 304);
    CHECK(message_of("00010130#0102000042B40000").channel == 1);
    // Roll angle 45 of a full scale of 180 degrees, as SHORT2.
    CHECK(number_of(message_of("138#010C0000200000B4")).value() == Approx(45.0).margin(0.0055));
    const auto utc = message_of("4B0#010F00010D2B1600");
    CHECK(to_hex(utc.data) == "0d2b1600");
    const auto halves = with_double(1036, 8, 47.2602);
    CHECK(candump_line({1s, "c", canaerospace::encode(halves[0])}) == "(0000000001.000000) c 40C#011E00084047A14E");
    CHECK(candump_line({1s, "c", canaerospace::encode(halves[1])}) == "(0000000001.000000) c 40C#011F00093BCD35A8");
}

TEST_CASE("What is no CANaerospace message is refused by its reason") {
    const auto reason = [](const CanFrame& frame) {
        const auto decoded = canaerospace::decode(frame);
        return std::holds_alternative<Reject>(decoded) ? std::string(name_of(std::get<Reject>(decoded))) : "taken";
    };
    CHECK(reason(frame_of("141#R")) == "not_data_frame");
    CHECK(reason(frame_of("20000004#0000000000000000")) == "not_data_frame");
    CHECK(reason(frame_of("141#010200")) == "bad_size");
    CHECK(reason(frame_of("141#0102000742B400")) == "bad_size");
    CHECK(reason(frame_of("1FFFFFFF#0102000742B40000")) == "unknown_channel");
    CHECK(reason(frame_of("00FF0141#0102000742B40000")) == "taken");
}

TEST_CASE("Every pose of the recorded CANaerospace flight agrees with the simulator's own log") {
    const auto log = kTraces / "canaerospace-c172-takeoff.log";
    CHECK(is_candump_log(log));
    const Capture capture = read_capture(log);
    CHECK(capture.protocol == Protocol::canaerospace);
    CHECK(text(capture.flow) == "can0");
    Session session(can_options());
    std::vector<std::optional<PoseSample>> poses;
    for (const auto& datagram : capture.datagrams) {
        const bool pose = session.accept(capture.payload(datagram), datagram.captured) == Verdict::pose;
        poses.push_back(pose ? session.state().pose : std::nullopt);
    }
    CHECK(session.statistics().frames == 600);
    CHECK(rejected_by_reason(session.statistics()).empty());
    CHECK(session.statistics().lost == 0);
    std::ifstream table(kTraces / "canaerospace-c172-takeoff.csv");
    std::string line;
    std::getline(table, line);
    int rows = 0;
    for (; std::getline(table, line); ++rows) {
        std::ranges::replace(line, ',', ' ');
        std::istringstream cells(line);
        std::size_t packet = 0;
        double seconds = 0, latitude = 0, longitude = 0, altitude = 0, heading = 0, pitch = 0, roll = 0;
        cells >> packet >> seconds >> latitude >> longitude >> altitude >> heading >> pitch >> roll;
        INFO("line " << packet);
        const PoseSample pose = poses.at(packet).value();
        CHECK(std::abs(pose.position.latitude.value - latitude) <= 1e-11);
        CHECK(std::abs(pose.position.longitude.value - longitude) <= 1e-11);
        CHECK(std::abs(pose.position.altitude - altitude) <= 1e-5);
        CHECK(std::abs(std::remainder(pose.attitude.heading.value - heading, 360.0)) <= 5e-5);
        CHECK(std::abs(pose.attitude.pitch.value - pitch) <= 5e-5);
        CHECK(std::abs(pose.attitude.roll.value - roll) <= 5e-5);
        CHECK(std::abs(std::chrono::duration<double>(pose.arrival - capture.datagrams[0].captured).count() - seconds) <
              1e-6);
    }
    CHECK(rows == 10);
}

TEST_CASE("A CAN log and the pcapng that tshark makes of it hold the same flight") {
    const auto log = kTraces / "canaerospace-c172-takeoff.log";
    const Capture from_log = read_capture(log);
    // tshark's own pcapng of such a log is wrapped; SocketCAN records are what capture programs write.
    PcapWriter writer(227);
    for (const auto& d : from_log.datagrams) writer.packet(from_log.payload(d), d.captured);
    const auto pcap = writer.save("flight.pcap");
    const auto pcapng = scratch("flight.pcapng");
    REQUIRE(std::system(("editcap -F pcapng '" + pcap.string() + "' '" + pcapng.string() + "'").c_str()) == 0);
    for (const auto& path : {pcap, pcapng}) {
        const Capture capture = read_capture(path);
        CHECK(capture.protocol == Protocol::canaerospace);
        CHECK(capture.bytes == from_log.bytes);
        CHECK(capture.datagrams.back().captured == from_log.datagrams.back().captured);
    }
    const auto rows = tshark_fields(pcap, {"can.id"});
    REQUIRE(rows.size() == from_log.datagrams.size());
    CHECK(rows[0][0] == "311");
}

TEST_CASE(
    "Whatever messages are lost, doubled or swapped, no pose is made of halves, or of parts older than the time-out") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    Session session(can_options());
    CanHost host;
    std::set<double> sent;
    std::uint64_t given = 0;
    for (int pose = 0; pose < 3000; ++pose) {
        // Latitudes whose halves, wrongly joined, make a number never sent.
        const double latitude = 47.0 + std::ldexp(static_cast<double>(random() % (1U << 20)), -30) + pose * 1e-3;
        sent.insert(latitude);
        auto messages = host.pose(latitude);
        for (std::size_t i = 0; i < messages.size();) {
            const auto fate = random() % 20;
            if (fate == 0)
                messages.erase(messages.begin() + static_cast<std::ptrdiff_t>(i));
            else if (fate == 1 && i + 1 < messages.size())
                std::swap(messages[i], messages[i + 1]), i += 2;
            else if (fate == 2)
                messages.insert(messages.begin() + static_cast<std::ptrdiff_t>(i), messages[i]), i += 2;
            else
                ++i;
        }
        for (const auto& message : messages) {
            ++given;
            if (give(session, message, pose * 16ms) != Verdict::pose) continue;
            REQUIRE(sent.contains(session.state().pose->position.latitude.value));
            REQUIRE(session.state().pose->position.latitude.value > latitude - 0.0175);
        }
    }
    const LinkStatistics& counts = session.statistics();
    CHECK(counts.datagrams == given);
    CHECK(counts.frames > 2000);
    CHECK(counts.lost > 500);
    CHECK(counts.duplicate > 500);
    CHECK(counts.rejected_for(Reject::lone_half) > 100);
}

TEST_CASE("A pose needs all of its parts, none older than the time-out, and is complete with its height") {
    Session session(can_options());
    CanHost host;
    const auto first = host.pose(47.5);
    for (std::size_t i = 0; i + 1 < first.size(); ++i) CHECK(give(session, first[i], 0ms) == Verdict::no_pose);
    CHECK(give(session, first.back(), 0ms) == Verdict::pose);
    CHECK(session.state().pose->attitude.heading.value == 270.0);
    CHECK(session.state().pose->attitude.roll.value == -3.0);
    // Heights alone go on making poses of what is known, until that is too old.
    CHECK(give(session, with_float(1038, 1, 101.0F), 200ms) == Verdict::pose);
    CHECK(session.state().pose->position.altitude == 101.0);
    CHECK(give(session, with_float(1038, 2, 102.0F), 251ms) == Verdict::rejected);
    CHECK(session.statistics().rejected_for(Reject::incomplete_pose) == 1);
    CHECK(session.state().pose->position.altitude == 101.0);
}

TEST_CASE("A half whose other comes after the time-out is a half alone") {
    Session session(can_options());
    CanHost host;
    CHECK(give(session, host.pose(47.5), 0ms) == Verdict::pose);
    const auto late = with_double(1036, 2, 47.6), in_time = with_double(1036, 4, 47.7);
    give(session, late[0], 10ms);
    CHECK(give(session, late[1], 261ms) == Verdict::rejected);
    CHECK(session.statistics().rejected_for(Reject::lone_half) == 1);
    give(session, in_time[0], 300ms);
    CHECK(give(session, in_time[1], 550ms) == Verdict::no_pose);
    CHECK(session.statistics().rejected_for(Reject::lone_half) == 1);
}

TEST_CASE("True heading is preferred to heading while it comes, and magnetic heading is never taken for either") {
    Session session(can_options());
    CanHost host;
    give(session, with_float(1133, 0, 10.0F), 0ms);
    give(session, with_float(1069, 0, 77.0F), 0ms);
    give(session, host.pose(47.5), 0ms);
    CHECK(session.state().pose->attitude.heading.value == 10.0);
    give(session, host.pose(47.5), 500ms);
    CHECK(session.state().pose->attitude.heading.value == 270.0);
}

TEST_CASE("Position and commit are the ones that the link's URL names") {
    const auto url = parse_link_url("can:?position=ins&commit=312&timeout=20&altitude_offset=5");
    SessionOptions options = session_options(url, {});
    Session session(options);
    for (const auto& [id, value] :
         {std::pair{1049, 1.0F}, {1050, 2.0F}, {1051, 3.0F}, {1036, 9.0F}, {311, 4.0F}, {321, 5.0F}})
        CHECK(give(session, with_float(static_cast<std::uint16_t>(id), 0, value), 0ms) == Verdict::no_pose);
    CHECK(give(session, with_float(312, 0, 6.0F), 20ms) == Verdict::pose);
    CHECK(session.state().pose->position.latitude.value == 1.0);
    CHECK(session.state().pose->position.altitude == 8.0);
    CHECK(give(session, with_float(312, 1, 6.0F), 21ms) == Verdict::rejected);
}

TEST_CASE("A redundant channel takes over when the first falls silent, and gives way once it is steady again") {
    Session session(can_options());
    CanHost first{.channel = 0}, second{.channel = 1};
    Time now{};
    for (int i = 0; i < 400; ++i, now += 16ms) {
        const bool silent = i >= 100 && i < 200;
        if (!silent) give(session, first.pose(10.0), now);
        give(session, second.pose(20.0), now + 1ms);
        const double seen = session.state().pose->position.latitude.value;
        INFO(i);
        if (i < 100) CHECK(seen == 10.0);
        if (i >= 117 && i < 200) CHECK(seen == 20.0);
        if (i >= 200 && i < 262) CHECK(seen == 20.0);
        if (i > 264) CHECK(seen == 10.0);
    }
    CHECK(session.statistics().lost == 0);
    Session pinned(session_options(parse_link_url("can:?channel=1"), {}));
    CHECK(give(pinned, first.pose(10.0), 0ms) == Verdict::no_pose);
    CHECK(give(pinned, second.pose(20.0), 0ms) == Verdict::pose);
    for (std::uint8_t channel = 2; channel < 40; ++channel) {
        first.channel = channel;
        give(session, first.pose(30.0), now);
    }
    CHECK(session.statistics().rejected_for(Reject::unknown_channel) > 200);
}

TEST_CASE("A host that counts anew is followed, and one whose message code stands still is taken as it is") {
    Session session(can_options());
    CanHost host{.code = 30};
    for (int i = 0; i < 50; ++i) give(session, host.pose(47.0), i * 16ms);
    host.code = 0;
    int taken = 0;
    for (int i = 50; i < 60; ++i) taken += give(session, host.pose(48.0), i * 16ms) == Verdict::pose;
    CHECK(taken == 10);
    CHECK(session.statistics().restarts == 1);
    Session still(can_options());
    for (int i = 0; i < 10; ++i)
        for (const int id : {311, 312, 321, 1036, 1037, 1038})
            give(still, with_float(static_cast<std::uint16_t>(id), 0, 1.0F), i * 1s);
    CHECK(still.statistics().frames == 10);
    CHECK(still.statistics().duplicate == 0);
}

TEST_CASE("Date, time and true velocities of a CANaerospace host are in its state") {
    Session session(can_options());
    give(session, message_of("4B0#010F00010D2B1600"), 0ms);
    CHECK_FALSE(session.state().utc.has_value());
    give(session, message_of("4B6#010F00000C061357"), 0ms);
    give(session, message_of("4B0#010F00020D2B1700"), 1s);
    REQUIRE(session.state().utc);
    CHECK(session.state().utc->year == 1987);
    CHECK(session.state().utc->month == 6);
    CHECK(session.state().utc->day == 12);
    CHECK(session.state().utc->minute == 43);
    CHECK(session.state().utc->second == 23.0);
    give(session, message_of("4B0#010F00031D2B1700"), 2s);
    // A hundred years to a century.
    give(session, message_of("4B6#010F00010C061364"), 2s);
    give(session, message_of("4B0#010F00040D2B1800"), 2s);
    CHECK(session.state().utc->year == 1987);
    CHECK(session.statistics().rejected_for(Reject::out_of_range) == 2);
    give(session, with_float(1131, 0, 70.5F), 2s);
    CHECK(session.state().velocity->y == 70.5);
    give(session, message_of("46B#0103000100000005"), 2s);
    CHECK(session.statistics().rejected_for(Reject::bad_data_type) == 1);
}

TEST_CASE("The identification service is answered on the next identifier, for our node and for all, and for no other") {
    Session session(can_options());
    const auto answer_to = [&](const std::string& request) {
        session.accept(can_record(frame_of(request)), 0ms);
        if (session.answer().empty()) return std::string();
        return candump_line({0s, "c", can_frame(session.answer()).value()}).substr(22);
    };
    CHECK(answer_to("080#20000005") == "081#2010000501010000");
    CHECK(answer_to("0C6#00000001") == "0C7#2010000101010000");
    CHECK(answer_to("080#21000005").empty());
    CHECK(answer_to("081#20000005").empty());
    CHECK(answer_to("080#20000105").empty());
    CHECK(answer_to("141#0102000742B40000").empty());
}
