// The link view and the conformance report: what they say of hosts that are in order, and of hosts that are not.
#include <catch2/catch.hpp>

#include "host_link/can_frame.h"
#include "host_link/canaerospace.h"
#include "host_link/capture.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/modbus_pose.h"
#include "host_link/monitor.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

struct Watched {
    Monitor monitor;
    Time now = 1000s;
    explicit Watched(const char* url) : monitor(parse_link_url(url)) {}
    void hear(std::span<const std::byte> bytes, Time after = 16667us) { monitor.hear({now += after, bytes}); }
    /// All lines said since the last call.
    std::string oddities() {
        std::string all;
        for (const std::string& line : monitor.take_oddities()) all += line + '\n';
        return all;
    }
};

Bytes cigi_frame(std::uint32_t number, double latitude = 47.26) {
    return message(ByteOrder::big, ig_control(number, number * 1667), ownship(latitude));
}

Bytes fdm(std::uint32_t version) {
    flightgear::NetFdm packet{.version = version, .longitude = 0.2, .latitude = 0.8};
    Bytes bytes(flightgear::kSize25);
    bytes.resize(flightgear::encode(packet, bytes));
    return bytes;
}

}  // namespace

TEST_CASE("A host in order is seen field by field with its rates, and nothing is odd about it") {
    Watched link("cigi:");
    for (std::uint32_t f = 0; f < 60; ++f) link.hear(cigi_frame(f));
    const std::string view = link.monitor.view(link.now + 16667us);
    CHECK_THAT(view, Contains("60.0 messages/s  60.0 poses/s"));
    CHECK_THAT(view, Contains("entity_control 0") && Contains("latitude 47.26 deg") && Contains("altitude 1000 m"));
    CHECK_THAT(view, Contains("host_frame 59") && Contains("minor_version 3") && Contains("pose "));
    CHECK_THAT(view, !Contains("(!)") && !Contains("rejected"));
    CHECK(link.monitor.oddities() == 0);
    // Rates are those since the view before.
    CHECK_THAT(link.monitor.view(link.now + 1s), Contains(" 0.0 messages/s"));
}

TEST_CASE("A 4.0 host is seen field by field, too") {
    Watched link("cigi:");
    constexpr cigi::Format kFour{ByteOrder::little, cigi::Version::four};
    const auto entity = ownship();
    link.hear(message(kFour, ig_control(1), entity, static_cast<const cigi::EntityPosition&>(entity),
                      cigi::WeatherControl{.layer = 2, .coverage = 101.0F}));
    const std::string view = link.monitor.view(link.now + 1s);
    CHECK_THAT(view, Contains("major_version 4") && Contains("entity_position 0") && Contains("latitude 47.26 deg"));
    CHECK_THAT(view, Contains("weather_control 2") && Contains("coverage 101 % (!)"));
    CHECK_THAT(link.oddities(), Contains("coverage 101 %"));
}

TEST_CASE("Everything that a host's developers should know of becomes a line, with the message that showed it") {
    Watched link("cigi:");
    for (std::uint32_t f = 0; f < 9; ++f) link.hear(cigi_frame(f));
    link.hear(cigi_frame(11));
    CHECK_THAT(link.oddities(), Contains("0.150 s, message 10: lost 2: frame number 11 after 8\n"));
    link.hear(cigi_frame(11));
    CHECK_THAT(link.oddities(), Contains("message 11: duplicate"));
    link.hear(cigi_frame(10));
    CHECK_THAT(link.oddities(), Contains("message 12: reordered"));
    link.hear(cigi_frame(0, 47.3), 1ms);
    CHECK_THAT(link.oddities(), Contains("restart") && Contains("frame number 0 after 11"));
    link.hear(cigi_frame(1), 123ms);
    CHECK_THAT(link.oddities(), Contains("gap: no pose for 123.0 ms"));
    link.hear(cigi_frame(2, 91.0));
    CHECK_THAT(link.oddities(), Contains("entity_control 0: latitude 91 deg (!) is not within -90 .. 90\n"));
    CHECK_THAT(link.monitor.view(link.now), Contains("latitude 91 deg (!)"));
    link.hear(cigi_frame(3) + raw_packet(150, 8));
    CHECK_THAT(link.oddities(), Contains("packet id 150 has no meaning"));
    link.hear(Bytes(64));
    CHECK_THAT(link.oddities(), Contains("no_ig_control: does not start with IG Control"));
    CHECK(link.monitor.oddities() == 8);
}

TEST_CASE("A link that passes to another host is told as a restart, though its messages do not show it") {
    Watched link("fdm://127.0.0.1:0?transport=tcp");
    for (int i = 0; i < 3; ++i) link.hear(fdm(24));
    CHECK(link.oddities().empty());
    Heard other{link.now += 16667us, {}};
    const Bytes first = fdm(24);
    other.bytes = first, other.changes = 1;
    link.monitor.hear(other);
    CHECK_THAT(link.oddities(), Contains("message 4: restart"));
}

TEST_CASE("The likely cause of what is refused is said in words") {
    Watched link("fdm:");
    link.hear(fdm(25));
    CHECK(link.oddities().empty());
    CHECK_THAT(link.monitor.view(link.now), Contains("version 25 packets: FlightGear 2020.4 or later"));
    Bytes swapped = fdm(24);
    std::swap(swapped[0], swapped[3]);
    link.hear(swapped);
    CHECK_THAT(link.oddities(), Contains("byte-swapped 24: a host of the other byte order"));
    CHECK_THAT(link.monitor.view(link.now), Contains("rejected 1 byte_swapped_version: byte-swapped 24"));
    Bytes cut = fdm(25);
    cut.resize(flightgear::kSize24);
    link.hear(cut);
    CHECK_THAT(link.oddities(), Contains("version 25 in 408 bytes"));
    for (std::size_t i = 0; i < kRejectCount; ++i)
        for (const Protocol protocol : {Protocol::cigi, Protocol::flightgear_fdm, Protocol::modbus})
            CHECK_FALSE(likely_cause(protocol, static_cast<Reject>(i)).empty());
}

TEST_CASE("CAN and Modbus hosts are seen as well") {
    Watched can("can:");
    can.hear(can_record(canaerospace::encode(canaerospace::with_float(311, 7, 2.5F))));
    can.hear(can_record(canaerospace::encode(canaerospace::with_float(1038, 0, 600.0F))));
    CHECK_THAT(can.monitor.view(can.now), Contains("body_pitch_angle 311") && Contains("code 7  value 2.5"));
    CHECK_THAT(can.oddities(), Contains("incomplete_pose"));

    Watched modbus("modbus:");
    const auto block = modbus::float_block({1, 5, {{{47.26}, {11.34}, 600.0}, {}}}, {});
    std::array<std::byte, modbus::kLargestFrame> frame{};
    modbus.hear(std::span(frame).first(modbus::write_request(1, 0, block, frame)));
    CHECK_THAT(modbus.monitor.view(modbus.now),
               Contains("write_multiple_registers") && Contains("count 24") && Contains("latitude 47.26 deg"));
    CHECK(modbus.oddities().empty());
    LinkStatistics refused = modbus.monitor.statistics();
    refused.rejected[static_cast<std::size_t>(Reject::not_allowed)] = 3;
    modbus.monitor.hear_refusals(refused);
    modbus.monitor.hear_refusals(refused);
    CHECK_THAT(modbus.oddities(), Contains("not_allowed (3)"));
    CHECK(modbus.monitor.oddities() == 1);
}

TEST_CASE("A flood of oddities and of packets is counted beyond what is shown") {
    Watched link("cigi:");
    for (int i = 0; i < 5000; ++i) link.hear(Bytes(8), 10us);
    const auto lines = link.monitor.take_oddities();
    CHECK(lines.size() == Monitor::kMostLines + 1);
    CHECK(lines.back() == "and 4000 more");
    for (std::uint16_t i = 0; i < 1000; ++i) {
        cigi::EntityControl other = ownship();
        other.entity = i;
        link.hear(message(ByteOrder::big, ig_control(i), other), 10us);
    }
    const std::string view = link.monitor.view(link.now);
    CHECK(std::ranges::count(view, '\n') < std::ptrdiff_t{Monitor::kMostRows} + 10);
    CHECK_THAT(view, Contains("packets of further kinds"));
}

TEST_CASE("A recorded CAN bus is seen with every parameter of its host, at their rates, and its one gap") {
    const Capture bus =
        read_capture(std::filesystem::path(QUADRIG_SOURCE_DIR) / "config/traces/canaerospace-c172-takeoff.log");
    Monitor monitor(parse_link_url("can:"));
    Time now = 1000s;
    const Time first = bus.datagrams.front().captured;
    for (const auto& frame : bus.datagrams) monitor.hear({now = 1000s + (frame.captured - first), bus.payload(frame)});
    const std::string seen = monitor.view(now);
    INFO(seen);
    const auto oddities = monitor.take_oddities();
    REQUIRE(oddities.size() == 1);
    CHECK_THAT(oddities[0], Contains("gap: no pose for 60."));
    for (const char* row : {"body_pitch_angle 311", "body_roll_angle 312", "1036", "1037", "1038"})
        CHECK_THAT(seen, Contains(row));
    CHECK(monitor.statistics().datagrams == bus.datagrams.size());
    CHECK(monitor.statistics().last_pose.has_value());
}
