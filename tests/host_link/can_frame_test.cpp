// CAN frames as recordings hold them, in bytes and in text: what is one, and what another program reads of it.
#include <catch2/catch.hpp>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "host_link/can_frame.h"
#include "host_link/capture.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

CanFrame frame_in(const std::string& text) {
    const auto line = read_candump_line("(1.000000) can0 " + text);
    REQUIRE(line);
    return line->frame;
}

SessionOptions bus_options() {
    SessionOptions options;
    options.protocol = Protocol::canaerospace;
    return options;
}

CanFrame random_frame(std::mt19937_64& random) {
    CanFrame frame;
    frame.extended = random() % 2 == 0;
    frame.id = static_cast<std::uint32_t>(random() & (frame.extended ? 0x1FFFFFFFU : 0x7FFU));
    frame.remote = random() % 16 == 0;
    if (frame.remote) return frame;
    frame.size = static_cast<std::uint8_t>(random() % 9);
    for (std::size_t i = 0; i < frame.size; ++i) frame.data[i] = static_cast<std::byte>(random());
    return frame;
}

}  // namespace

TEST_CASE("An identifier of three digits is one of eleven bits") {
    CHECK(read_candump_line("(1.000000) can0 7FF#01020007"));
    CHECK_FALSE(read_candump_line("(1.000000) can0 800#01020007"));
}

TEST_CASE("A length code above 8 behind the data is the frame of eight bytes that it belongs to") {
    for (const char code : std::string("9ABCDEFaf"))
        CHECK(frame_in(std::string("141#0102000742B40000_") + code) == frame_in("141#0102000742B40000"));
    for (const char* line : {"141#0102000742B40000_8", "141#0102000742B40000_", "141#0102000742B40000_99",
                             "141#0102000742B400_9", "141#0102000742B4000000"})
        CHECK_FALSE(read_candump_line("(1.000000) can0 " + std::string(line)));
}

TEST_CASE("A CAN FD frame of a log is one of its bus that no host sends, as it is in a capture") {
    for (const char* text :
         {"141##0", "141##10102000742B40000", "00010130##5.01.02", "141##F0102000742B400000102030405"}) {
        INFO(text);
        const CanFrame frame = frame_in(text);
        CHECK(frame.fd);
        CHECK_FALSE(can_frame(can_record(frame)));
        CHECK(read_candump_line(candump_line({1s, "can0", frame}))->frame == frame);
    }
    const std::string too_much(130, '0');
    for (const std::string& text :
         {std::string("141##"), std::string("141##x"), std::string("141##01"), "141##0" + too_much})
        CHECK_FALSE(read_candump_line("(1.000000) can0 " + text));

    const auto path = scratch("fd.log");
    std::ofstream log(path);
    for (const char* text : {"40E#0102000042C80000", "40E##10102000142C80000", "40E#0102000242C80000"})
        log << "(1.000000) can0 " << text << '\n';
    log.close();
    const Capture capture = read_capture(path);
    CHECK(capture.counts.damaged == 0);
    REQUIRE(capture.datagrams.size() == 3);
    Session session(bus_options());
    CHECK(session.accept(capture.payload(capture.datagrams[1]), 0ms) == Verdict::rejected);
    CHECK(session.statistics().rejected_for(Reject::not_data_frame) == 1);
}

TEST_CASE("Any frame survives the record and the log line, and tshark reads the log alike") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::vector<CanFrame> frames;
    const auto path = scratch("random.log");
    std::ofstream log(path);
    for (int i = 0; i < 500; ++i) {
        frames.push_back(random_frame(random));
        CHECK(can_frame(can_record(frames.back())) == frames.back());
        const Time time = 1795325181s + i * 1234us;
        const std::string line = candump_line({time, "vcan0", frames.back()});
        const auto back = read_candump_line(line);
        REQUIRE(back);
        CHECK(back->time == time);
        CHECK(back->interface == "vcan0");
        CHECK(back->frame == frames.back());
        log << line << '\n';
    }
    log.close();
    const auto rows = tshark_fields(path, {"can.id", "can.flags.xtd", "can.flags.rtr", "can.len", "frame.time_epoch"});
    REQUIRE(rows.size() == frames.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        INFO(i);
        CHECK(std::stoul(rows[i][0]) == frames[i].id);
        CHECK(rows[i][1] == (frames[i].extended ? "1" : "0"));
        CHECK(rows[i][2] == (frames[i].remote ? "1" : "0"));
        CHECK(std::stoul(rows[i][3]) == frames[i].size);
    }
}

TEST_CASE("No bytes and no text make the CAN readers fail") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    Session session(bus_options());
    const std::string alphabet = "(). #0123456789ABCDEFR_vcan\n";
    for (int i = 0; i < 20000; ++i) {
        Bytes record(random() % 24);
        for (auto& byte : record) byte = static_cast<std::byte>(random() % 4 == 0 ? random() % 32 : random());
        session.accept(record, i * 1ms);
        session.accept(can_record(random_frame(random)), i * 1ms);
        std::string line = random() % 2 == 0 ? "(1.000000) can0 141#0102000742B40000" : "";
        for (std::size_t n = random() % 12; n > 0; --n) {
            const char c = alphabet[random() % alphabet.size()];
            line.insert(random() % (line.size() + 1), 1, c);
        }
        read_candump_line(line);
    }
    CHECK(session.statistics().datagrams == 40000);
}
