#include <catch2/catch.hpp>
#include <cstdlib>
#include <vector>

#include "host_link/canaerospace.h"
#include "host_link/capture.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/modbus_pose.h"
#include "host_link/recording.h"
#include "support.h"

using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

constexpr std::uint32_t kEthernet = 1, kRaw = 101, kIpv4 = 228, kNull = 0, kSll = 113, kSll2 = 276;

Bytes cigi_message(std::uint32_t frame) { return message(ByteOrder::big, ig_control(frame), ownship()); }
Bytes fdm_packet() {
    Bytes bytes(flightgear::kSize24);
    flightgear::encode({}, bytes);
    return bytes;
}

std::string error_of(const std::filesystem::path& path, std::optional<Protocol> protocol = std::nullopt) {
    try {
        read_capture(path, protocol);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "no error";
}

std::filesystem::path ten_messages(const std::string& name) {
    PcapWriter writer(kIpv4);
    for (std::uint32_t f = 0; f < 10; ++f) writer.packet(ipv4_udp(cigi_message(f)), 1s + f * 16ms);
    return writer.save(name);
}

}  // namespace

TEST_CASE("Datagrams come out whole, in order, with their capture times, from classic pcap and from pcapng") {
    const auto pcap = ten_messages("ten.pcap");
    const auto pcapng = scratch("ten.pcapng");
    REQUIRE(std::system(("editcap -F pcapng '" + pcap.string() + "' '" + pcapng.string() + "'").c_str()) == 0);
    const auto nanoseconds = scratch("ten-ns.pcap");
    REQUIRE(std::system(("editcap -F nsecpcap '" + pcap.string() + "' '" + nanoseconds.string() + "'").c_str()) == 0);
    for (const auto& path : {pcap, pcapng, nanoseconds}) {
        INFO(path);
        const Capture capture = read_capture(path);
        CHECK(capture.protocol == Protocol::cigi);
        REQUIRE(capture.datagrams.size() == 10);
        for (std::uint32_t f = 0; f < 10; ++f) {
            const auto payload = capture.payload(capture.datagrams[f]);
            CHECK(Bytes(payload.begin(), payload.end()) == cigi_message(f));
            CHECK(capture.datagrams[f].captured == 1s + f * 16ms);
        }
        CHECK_FALSE(capture.truncated.has_value());
    }
}

TEST_CASE("Ethernet, VLAN, raw IP, loopback and both Linux cooked captures hold the same datagram") {
    const Bytes payload = cigi_message(1);
    const Bytes v4 = ipv4_udp(payload), v6 = ipv6_udp(payload);
    Bytes sll(14), sll2 = from_hex("0800") + Bytes(18);
    sll = sll + from_hex("86dd");
    const std::vector<std::pair<std::uint32_t, Bytes>> packets{
        {kEthernet, ethernet(v4, 0x0800)},
        {kEthernet, ethernet(v6, 0x86DD)},
        {kEthernet, ethernet(from_hex("00640800") + v4, 0x8100)},
        {kEthernet, ethernet(from_hex("0064810000c886dd") + v6, 0x88A8)},
        {kEthernet, ethernet(v4 + Bytes(7), 0x0800)},  // a trailer
        {kRaw, v4},
        {kRaw, v6},
        {kIpv4, v4},
        {kNull, from_hex("02000000") + v4},
        {kNull, from_hex("1e000000") + v6},
        {kSll, sll + v6},
        {kSll2, sll2 + v4}};
    int i = 0;
    for (const auto& [link, packet] : packets) {
        INFO("packet " << i << ", link type " << link);
        PcapWriter writer(link);
        writer.packet(packet, 5s);
        const Capture capture = read_capture(writer.save("link" + std::to_string(i++) + ".pcap"));
        REQUIRE(capture.datagrams.size() == 1);
        const auto read = capture.payload(capture.datagrams[0]);
        CHECK(Bytes(read.begin(), read.end()) == payload);
        CHECK(capture.flow.destination_port == 8004);
    }
}

TEST_CASE("The host's flow is taken; replies, other hosts, other traffic and fragments are counted") {
    PcapWriter writer(kEthernet);
    const auto put = [&](const Bytes& ip_packet, std::uint16_t type = 0x0800) {
        writer.packet(ethernet(ip_packet, type), 1s);
    };
    const Bytes reply = message(ByteOrder::little, cigi::StartOfFrame{});
    for (std::uint32_t f = 0; f < 20; ++f) {
        put(ipv4_udp(cigi_message(f)));
        put(ipv4_udp(reply, {0x7F000001, 0x7F000001, 8004, 8005}));
        put(ipv4_udp(reply, {0x7F000001, 0x7F000001, 8004, 8005}));
    }
    put(ipv4_udp(from_hex("00"), {}));  // garbage to the image generator's port: part of the flow
    put(ipv4_udp(cigi_message(20), {0x7F000001, 0x7F000001, 9999, 8004}));  // the same host from a new port
    put(ipv4_udp(cigi_message(1), {0x7F000001, 0x7F000001, 8005, 8104}));   // another image generator
    put(ipv4_udp(fdm_packet(), {0x7F000001, 0x7F000001, 8005, 5500}));
    put(ipv4_udp(cigi_message(1), {0x0A000001, 0x7F000001, 8005, 8004}));  // another host
    put(Bytes(28), 0x0806);                                                // ARP
    Bytes tcp = ipv4_udp(cigi_message(1));
    tcp[9] = std::byte{6};
    put(tcp);
    Bytes fragment = ipv4_udp(cigi_message(1));
    fragment[6] = std::byte{0x20};
    put(fragment);
    put(from_hex("450000"));
    const Capture capture = read_capture(writer.save("mixed.pcap"));
    CHECK(capture.protocol == Protocol::cigi);
    CHECK(text(capture.flow) == "127.0.0.1 -> 127.0.0.1:8004");
    CHECK(capture.datagrams.size() == 22);
    CHECK(capture.counts.packets == 69);
    CHECK(capture.counts.other_flow == 43);
    CHECK(capture.counts.not_udp == 2);
    CHECK(capture.counts.fragments == 1);
    CHECK(capture.counts.damaged == 1);

    const Capture fdm = read_capture(scratch("mixed.pcap"), Protocol::flightgear_fdm);
    CHECK(fdm.protocol == Protocol::flightgear_fdm);
    CHECK(fdm.flow.destination_port == 5500);
    CHECK(fdm.datagrams.size() == 1);
}

TEST_CASE("A capture cut anywhere gives what was whole, and says that it was cut") {
    const Bytes whole = read_file(ten_messages("whole.pcap"));
    const std::size_t record = (whole.size() - 24) / 10;
    const auto path = scratch("cut.pcap");
    for (std::size_t size = 0; size < whole.size(); size += 3) {
        INFO("cut to " << size << " bytes");
        write_file(path, std::span(whole).first(size));
        if (size < 24 + record) {
            CHECK_THAT(error_of(path), Catch::Contains("cut.pcap"));
            continue;
        }
        const Capture capture = read_capture(path);
        CHECK(capture.datagrams.size() == (size - 24) / record);
        CHECK(capture.truncated.has_value() == ((size - 24) % record != 0));
    }
}

TEST_CASE("A recording of the project cut in the middle, in either format, gives what was readable") {
    for (const std::string name : {"netfdm-c172-takeoff.pcap", "cigi33-737-turn.pcapng"}) {
        const Bytes whole = read_file(std::filesystem::path(QUADRIG_SOURCE_DIR) / "config/traces" / name);
        const auto path = scratch("half-" + name);
        write_file(path, std::span(whole).first(whole.size() / 2 + 1));
        const Capture capture = read_capture(path);
        CHECK(capture.truncated.has_value());
        CHECK(capture.datagrams.size() > 1400);
    }
}

TEST_CASE("A packet captured only in part gives the part") {
    PcapWriter writer(kIpv4);
    writer.packet(ipv4_udp(cigi_message(0)), 1s);
    writer.packet(ipv4_udp(cigi_message(1)), 1s, 20);
    const Capture capture = read_capture(writer.save("snapped.pcap"));
    REQUIRE(capture.datagrams.size() == 2);
    CHECK(capture.datagrams[1].size == cigi_message(1).size() - 20);
}

TEST_CASE("Files that are no captures, or hold no host, are refused by name and reason") {
    using Catch::Contains;
    CHECK_THAT(error_of("/nonexistent/flight.pcap"), Contains("/nonexistent/flight.pcap") && Contains("No such file"));
    write_file(scratch("text.pcap"), std::as_bytes(std::span("this is not a capture at all")));
    CHECK_THAT(error_of(scratch("text.pcap")), Contains("text.pcap") && Contains("unknown file format"));
    write_file(scratch("empty.pcap"), {});
    CHECK_THAT(error_of(scratch("empty.pcap")), Contains("empty.pcap"));
    CHECK_THAT(error_of(PcapWriter(kEthernet).save("no-packets.pcap")),
               Contains("no-packets.pcap") && Contains("0 packets"));
    PcapWriter bluetooth(187);
    bluetooth.packet(Bytes(20), 1s);
    CHECK_THAT(error_of(bluetooth.save("bluetooth.pcap")), Contains("kind of link"));
    CHECK_THAT(error_of(ten_messages("ten.pcap"), Protocol::flightgear_fdm),
               Contains("no datagram of a FlightGear FDM host"));
}

TEST_CASE("A CIGI 4.0 recording is recognised by its content") {
    PcapWriter writer(kIpv4);
    for (int i = 0; i < 3; ++i)
        writer.packet(ipv4_udp(from_hex("1800000004000005e90300008d13000040e2010000000000")), 1s);
    const Capture capture = read_capture(writer.save("cigi4.pcap"));
    CHECK(capture.protocol == Protocol::cigi);
    CHECK(capture.datagrams.size() == 3);
}

TEST_CASE("Captures with random damage are read or refused, never worse") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const Bytes pcapng_source = [] {
        const auto path = scratch("fuzz.pcapng");
        REQUIRE(std::system(("editcap -F pcapng '" + ten_messages("fuzz.pcap").string() + "' '" + path.string() + "'")
                                .c_str()) == 0);
        return read_file(path);
    }();
    // A Modbus host's stream, and a bus as text.
    const auto recorded = [](Protocol protocol, RecordingFormat format, const auto& bytes_of) {
        RecordingText writer(protocol, format, "can0");
        std::string all = writer.begin();
        for (std::uint16_t i = 0; i < 20; ++i) {
            const auto bytes = bytes_of(i);
            Heard heard;
            heard.bytes = bytes;
            heard.from.ss_family = AF_INET;
            heard.source = i % 3U;
            all += writer.piece(heard, 1s + i * 16ms);
        }
        const auto view = std::as_bytes(std::span(all));
        return Bytes(view.begin(), view.end());
    };
    const std::vector<Bytes> sources{read_file(scratch("fuzz.pcap")), pcapng_source,
                                     recorded(Protocol::modbus, RecordingFormat::pcapng,
                                              [](std::uint16_t i) {
                                                  Bytes frame(modbus::kLargestFrame);
                                                  const auto block = modbus::float_block({i, i, {}}, {});
                                                  frame.resize(modbus::write_request(i, 0, block, frame));
                                                  return frame;
                                              }),
                                     recorded(Protocol::canaerospace, RecordingFormat::candump, [](std::uint16_t i) {
                                         return can_record(canaerospace::encode(canaerospace::with_float(
                                             1038, static_cast<std::uint8_t>(i), static_cast<float>(i))));
                                     })};
    const auto path = scratch("damaged");
    int readable = 0;
    for (int i = 0; i < 1000; ++i) {
        Bytes bytes = sources[static_cast<std::size_t>(i) % sources.size()];
        for (auto flips = 1 + random() % 8; flips > 0; --flips)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        write_file(path, bytes);
        try {
            readable += read_capture(path).datagrams.empty() ? 0 : 1;
        } catch (const std::runtime_error& e) {
            REQUIRE_THAT(e.what(), Catch::Contains(path.string()));
        }
    }
    CHECK(readable > 250);
}
