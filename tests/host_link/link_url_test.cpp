#include <catch2/catch.hpp>

#include "host_link/link_url.h"

using namespace quadrig::host;

namespace {

std::string error_of(std::string_view text) {
    try {
        parse_link_url(text);
    } catch (const LinkUrlError& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("A link names its protocol, address and port") {
    const LinkUrl cigi = parse_link_url("cigi://127.0.0.1:8004");
    CHECK(cigi.protocol == Protocol::cigi);
    CHECK(cigi.address == "127.0.0.1");
    CHECK(cigi.port == 8004);
    CHECK(cigi.text == "cigi://127.0.0.1:8004");
    const LinkUrl fdm = parse_link_url("fdm://[::1]:5500");
    CHECK(fdm.protocol == Protocol::flightgear_fdm);
    CHECK(fdm.address == "::1");
    CHECK(fdm.port == 5500);
    CHECK(parse_link_url("cigi://0.0.0.0:1").address == "0.0.0.0");
}

TEST_CASE("Loopback is the default address") {
    CHECK(parse_link_url("cigi://:8004").address == "127.0.0.1");
    CHECK(parse_link_url("cigi://localhost:8004").address == "127.0.0.1");
}

TEST_CASE("A host may be named; what ends in a number is an address, and whom to trust is told by address") {
    CHECK(parse_link_url("cigi://sim_2.hangar-3.example:8004").address == "sim_2.hangar-3.example");
    CHECK(parse_link_url("modbus://3com:1502").address == "3com");
    using Catch::Contains;
    for (const char* link :
         {"cigi://10.1:80", "cigi://sim.7:80", "cigi://sim.:80", "cigi://a b:80", "cigi://s\xC3\xA4:80"})
        CHECK_THAT(error_of(link), Contains("bad address"));
    CHECK_THAT(error_of("cigi://sim:80?reply=sim:81"), Contains("bad address 'sim'"));
    CHECK(parse_link_url("cigi://sim:80?reply=[::1]:81").trust.reply->port == 81);
}

TEST_CASE("A bare protocol names a recording's") {
    CHECK(parse_link_url("fdm:").protocol == Protocol::flightgear_fdm);
    CHECK_FALSE(parse_link_url("cigi:").port.has_value());
}

TEST_CASE("A CAN link names its interface") {
    const LinkUrl url = parse_link_url("can://vcan0?node=7&channel=2&commit=1038");
    CHECK(url.protocol == Protocol::canaerospace);
    CHECK(url.live);
    CHECK(url.address == "vcan0");
    CHECK_FALSE(url.port.has_value());
    CHECK(url.can_node == 7);
    CHECK(url.canaerospace.channel == 2);
    CHECK(url.canaerospace.commit == 1038);
    CHECK_FALSE(parse_link_url("can:").live);
}

TEST_CASE("Options of a link are read") {
    const LinkUrl url = parse_link_url("cigi://127.0.0.1:8004?version=3.3&ownship=7&view=2&altitude_offset=-48.5");
    CHECK(url.ownship == 7);
    CHECK(url.view == 2);
    CHECK(url.altitude_offset == -48.5);
    CHECK(parse_link_url("cigi:?view=3").view == 3);
    CHECK(parse_link_url("cigi:?database=5").database == 5);
    CHECK(parse_link_url("cigi://:8004?operation=synchronous").synchronous);
    CHECK_FALSE(parse_link_url("cigi://:8004?operation=asynchronous").synchronous);
    for (const char* link : {"cigi:", "fdm://:5500", "can://can0", "modbus://:1502"}) {
        CHECK(parse_link_url(link).trust.silence == std::chrono::seconds(1));
        CHECK(parse_link_url(std::string(link) + "?silence=2500").trust.silence == std::chrono::milliseconds(2500));
    }
    CHECK(parse_link_url("fdm:?altitude_offset=2").altitude_offset == 2.0);
}

TEST_CASE("A link says whom it trusts") {
    const LinkUrl url =
        parse_link_url("cigi://[::]:8004?allow=10.1.2.3,10.8.0.0/13,[fd00::]/9,[::1]&host=first&reply=[::1]:8005");
    const auto allowed = [&](const char* address) { return PeerGate(url.trust).allows(ip_address(address).value()); };
    for (const char* address : {"10.1.2.3", "10.8.0.0", "10.15.255.255", "fd00::1", "fd7f::1", "::1"})
        CHECK(allowed(address));
    for (const char* address : {"10.1.2.4", "10.7.255.255", "10.16.0.0", "fd80::1", "fe00::1", "::2", "0.0.0.1"})
        CHECK_FALSE(allowed(address));
    CHECK(url.trust.first_host);
    CHECK(url.trust.reply->port == 8005);
    CHECK(PeerGate({}).allows(ip_address("192.0.2.1").value()));
    CHECK(PeerGate(parse_link_url("modbus://0.0.0.0:1502?allow=0.0.0.0/0").trust).allows(*ip_address("192.0.2.1")));
}

TEST_CASE("What a link gets wrong is said with the link") {
    using Catch::Contains;
    CHECK_THAT(error_of("127.0.0.1"), Contains("127.0.0.1") && Contains("cigi://127.0.0.1:8004"));
    CHECK_THAT(error_of("http://127.0.0.1:80"), Contains("unknown scheme"));
    CHECK_THAT(error_of("can://"), Contains("no CAN interface"));
    CHECK_THAT(error_of("can://0123456789abcdef"), Contains("no CAN interface"));
    CHECK_THAT(error_of("can://vcan0?node=0"), Contains("node is a number from 1 to 255"));
    CHECK_THAT(error_of("can://vcan0?position=radio"), Contains("position is gps, ins or auxiliary"));
    CHECK_THAT(error_of("can://vcan0?ownship=1"), Contains("unknown option"));
    CHECK_THAT(error_of("modbus://127.0.0.1:1502?word_order=abdc"), Contains("word_order is abcd"));
    CHECK_THAT(error_of("modbus://127.0.0.1:1502?base=65409"), Contains("base is a number from 0 to 65408"));
    CHECK_THAT(error_of("cigi://127.0.0.1"), Contains("no port"));
    CHECK_THAT(error_of("cigi://[::1]"), Contains("no port"));
    CHECK_THAT(error_of("cigi://127.0.0.1:65536"), Contains("bad port"));
    CHECK_THAT(error_of("cigi://127.0.0.1:"), Contains("bad port"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80x"), Contains("bad port"));
    CHECK_THAT(error_of("cigi://127.0.0.256:80"), Contains("bad address"));
    CHECK_THAT(error_of("cigi://[::g]:80"), Contains("bad IPv6"));
    CHECK_THAT(error_of("cigi://[:80"), Contains("bad IPv6"));
    CHECK_THAT(error_of("cigi://::1:80"), Contains("brackets"));
    CHECK_THAT(error_of("cigi:127.0.0.1:80"), Contains("//"));
    CHECK(parse_link_url("cigi://127.0.0.1:80?version=4.0").cigi_version == cigi::Version::four);
    CHECK(parse_link_url("cigi://127.0.0.1:80?version=3.2").cigi_version == cigi::Version::three);
    CHECK_FALSE(parse_link_url("cigi://127.0.0.1:80").cigi_version.has_value());
    CHECK_THAT(error_of("cigi://127.0.0.1:80?version=5"), Contains("unknown CIGI version"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?ownship=-1"), Contains("ownship"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?altitude_offset=nan"), Contains("metres"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?altitude_offset=1.1e6"), Contains("metres from -1e6 to 1e6"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?view=1&ownship=2&view=1"), Contains("'view' is given twice"));
    CHECK_THAT(error_of("fdm://127.0.0.1:80?version=3.3"), Contains("unknown option"));
    CHECK_THAT(error_of("fdm://127.0.0.1:80?transport=sctp"), Contains("udp or tcp"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?transport=tcp"), Contains("unknown option"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?database=128"), Contains("from 1 to 127"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?operation=both"), Contains("synchronous or asynchronous"));
    CHECK_THAT(error_of("fdm://127.0.0.1:80?operation=synchronous"), Contains("unknown option"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?silence=99"), Contains("from 100 to 3600000"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?allow="), Contains("ADDRESS[/BITS]"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?allow=10.0.0.0/33"), Contains("from 0 to 32"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?allow=10.0.0.0/"), Contains("from 0 to 32"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?allow=here"), Contains("bad address"));
    CHECK_THAT(error_of("can://vcan0?allow=10.0.0.1"), Contains("unknown option"));
    CHECK_THAT(error_of("cigi:?allow=10.0.0.1"), Contains("unknown option"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?host=last"), Contains("first or newest"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?reply=[::1]:81"), Contains("both IPv4 or both IPv6"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?reply=127.0.0.1"), Contains("no port"));
    CHECK_THAT(error_of("fdm://127.0.0.1:80?reply=127.0.0.1:81"), Contains("unknown option"));
    CHECK_THAT(error_of("cigi://127.0.0.1:80?reply_rate=0"), Contains("from 1 to 1000"));
}
