// Modbus/TCP: the registers by the letter of their table, and live against mbpoll, pymodbus and clients that misbehave.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <bit>
#include <catch2/catch.hpp>
#include <fstream>
#include <thread>

#include "host_link/capture.h"
#include "host_link/modbus_link.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::modbus;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

using Words = std::vector<std::uint16_t>;

/// The example that travels with the register layout.
const Words kExample{1,     7,     0, 0, 16455, 41287, 44564, 31457, 16422, 44564, 31457, 18350,
                     16530, 49152, 0, 0, 17076, 0,     16384, 0,     49440, 0,     0,     7};

Bytes bytes_of(const Words& words) {
    Bytes bytes(2 * words.size());
    for (std::size_t i = 0; i < words.size(); ++i) store(std::span(bytes), 2 * i, ByteOrder::big, words[i]);
    return bytes;
}

Bytes write_frame(std::uint16_t address, std::span<const std::byte> values) {
    Bytes frame(kLargestFrame);
    frame.resize(write_request(1, address, values, frame));
    return frame;
}
Bytes write_frame(std::uint16_t address, const Words& words) { return write_frame(address, bytes_of(words)); }

HostPose pose_of(std::uint16_t sequence, double latitude = 47.26) {
    return {sequence, sequence * 16U, {{{latitude}, {11.34}, 1200.0}, {{90.0}, {2.0}, {-10.0}}}};
}
Bytes pose_frame(std::uint16_t sequence, double latitude = 47.26) {
    return write_frame(0, float_block(pose_of(sequence, latitude), {}));
}

Session modbus_session(const std::string& url = "modbus:") { return Session(session_options(parse_link_url(url), {})); }

int connect_to(std::uint16_t port) {
    const int s = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(connect(s, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0);
    const timeval patience{2, 0};
    setsockopt(s, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    return s;
}

/// A host that waits for each answer.
struct Client {
    explicit Client(std::uint16_t port) : s(connect_to(port)) {}
    ~Client() { close(s); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    void send(const Bytes& bytes) const { ::send(s, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
    [[nodiscard]] Bytes ask(const Bytes& request) const {
        send(request);
        Bytes answer(kLargestFrame);
        const auto size = recv(s, answer.data(), answer.size(), 0);
        answer.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        return answer;
    }
    int s;
};

std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"), &pclose);
    std::string text(65536, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), pipe.get()));
    return text;
}

struct Live {
    explicit Live(const std::string& options = "") : link(parse_link_url("modbus://127.0.0.1:0" + options)) {
        link.start(session_options(link.url(), {}));
    }
    bool sees(std::uint64_t poses) {
        for (const auto end = std::chrono::steady_clock::now() + 5s; std::chrono::steady_clock::now() < end;) {
            link.take_newest(state);
            if (state.pose && state.pose->sequence >= poses) return true;
            std::this_thread::sleep_for(1ms);
        }
        return false;
    }
    ModbusLink link;
    HostState state;
};

}  // namespace

TEST_CASE("One write of the layout's example is its pose") {
    Session session = modbus_session();
    CHECK(session.accept(write_frame(0, kExample), 1s) == Verdict::pose);
    const PoseSample& pose = session.state().pose.value();
    CHECK(pose.position.latitude.value == 47.26);
    CHECK(pose.position.longitude.value == 11.34);
    CHECK(pose.position.altitude == 1200.0);
    CHECK(pose.attitude.heading.value == 90.0);
    CHECK(pose.attitude.pitch.value == 2.0);
    CHECK(pose.attitude.roll.value == -10.0);
    CHECK(pose.source_time == 0ms);
    CHECK(Bytes(bytes_of(kExample)) == [] {
        const auto block = float_block({7, 0, pose_of(7).pose}, {});
        return Bytes(block.begin(), block.end());
    }());
}

TEST_CASE("Numbers lie in their registers as the word order is spelt, and are read back from there") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> angle(-180.0F, 180.0F);
    for (const std::string name : {"abcd", "cdab", "badc", "dcba"}) {
        const LinkUrl url = parse_link_url("modbus:?base=40&word_order=" + name);
        for (int i = 0; i < 200; ++i) {
            HostPose pose = pose_of(static_cast<std::uint16_t>(random()));
            const float heading = angle(random);
            pose.pose.attitude.heading.value = heading;
            pose.pose.position.latitude.value = angle(random) / 3.0;
            const auto block = float_block(pose, url.modbus.order);
            // A is the most significant byte.
            const auto bits = std::bit_cast<std::uint32_t>(heading);
            for (std::size_t place = 0; place < 4; ++place)
                CHECK(std::to_integer<unsigned>(block[32 + place]) == (bits >> (8 * ('d' - name[place])) & 0xFFU));
            Session session(session_options(url, {}));
            CHECK(session.accept(write_frame(40, block), 1s) == Verdict::pose);
            CHECK(session.state().pose->position.latitude.value == pose.pose.position.latitude.value);
            CHECK(session.state().pose->source_time == std::chrono::milliseconds(pose.time));
        }
    }
}

TEST_CASE("The block of scaled int32 carries the same pose") {
    Session session = modbus_session("modbus:?base=1000");
    Words words{1, 3, 0, 500};
    for (const std::int32_t value : {472600001, -1133400009, -12345, 3599999, -25000, 1795000}) {
        words.push_back(static_cast<std::uint16_t>(static_cast<std::uint32_t>(value) >> 16));
        words.push_back(static_cast<std::uint16_t>(value));
    }
    words.insert(words.end(), {0, 3});
    REQUIRE(words.size() == kScaledRegisters);
    CHECK(session.accept(write_frame(1100, words), 1s) == Verdict::pose);
    const PoseSample& pose = session.state().pose.value();
    CHECK(pose.position.latitude.value == Approx(47.2600001).epsilon(1e-15));
    CHECK(pose.position.longitude.value == Approx(-113.3400009).epsilon(1e-15));
    CHECK(pose.position.altitude == Approx(-12.345));
    CHECK(pose.attitude.heading.value == Approx(359.9999));
    CHECK(pose.attitude.pitch.value == Approx(-2.5));
    CHECK(pose.attitude.roll.value == Approx(179.5));
}

TEST_CASE("Written in parts of any kind and order, a pose counts once its commit is written, and never in part") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    Session session = modbus_session();
    for (std::uint16_t n = 1; n < 500; ++n) {
        const double latitude = 40.0 + n * 1e-2;
        const auto block = float_block(pose_of(n, latitude), {});
        std::vector<std::pair<std::uint16_t, std::uint16_t>> parts;  // from, to
        for (std::uint16_t from = 0; from < 23;) {
            const auto to = static_cast<std::uint16_t>(std::min<std::uint64_t>(23, from + 1 + random() % 6));
            parts.emplace_back(from, to);
            from = to;
        }
        std::ranges::shuffle(parts, random);
        const auto write = [&](std::size_t from, std::size_t to) {
            return session.accept(
                write_frame(static_cast<std::uint16_t>(from), std::span(block).subspan(2 * from, 2 * (to - from))),
                n * 16ms);
        };
        for (const auto& [from, to] : parts) {
            CHECK(write(from, to) == Verdict::no_pose);
            if (n > 1) CHECK(session.state().pose->position.latitude.value == 40.0 + (n - 1) * 1e-2);
        }
        CHECK(write(23, 24) == Verdict::pose);
        CHECK(session.state().pose->position.latitude.value == latitude);
        // The old commit once more, with the next pose half written, is no pose.
        const auto next = float_block(pose_of(n, 1.0), {});
        session.accept(write_frame(4, std::span(next).subspan(8, 8)), n * 16ms);
        CHECK(write(23, 24) == Verdict::duplicate);
        CHECK(session.state().pose->position.latitude.value == latitude);
    }
    CHECK(rejected_by_reason(session.statistics()).empty());
}

TEST_CASE("What a Modbus host gets wrong is counted by its reason") {
    Session session = modbus_session();
    const auto refused = [&](const Bytes& frame, std::string_view reason) {
        INFO(reason);
        CHECK(session.accept(frame, 1s) == Verdict::rejected);
        CHECK(rejected_by_reason(session.statistics()).back().first == reason);
        session = modbus_session();
    };
    Words wrong = kExample;
    wrong[23] = 8;
    refused(write_frame(0, wrong), "commit_mismatch");
    wrong = kExample;
    wrong[0] = 2;
    refused(write_frame(0, wrong), "unknown_version");
    refused(write_frame(1, kExample), "bad_address");
    refused(write_frame(30, Words{1}), "bad_address");
    refused(from_hex("000100000006ff0300000080"), "bad_request");
    refused(from_hex("000100000006ff050000ff00"), "bad_request");
    refused(from_hex("000100000009ff10000000010400000000"), "bad_request");
    wrong = kExample;
    wrong[4] = 0x7FF0;
    CHECK(session.accept(write_frame(0, wrong), 1s) == Verdict::no_pose);
    CHECK(session.statistics().rejected_for(Reject::out_of_range) == 1);
}

TEST_CASE("Sequence numbers tell lost poses, doubled ones and a host that counts anew; of two hosts one drives") {
    Session session = modbus_session();
    for (const std::uint16_t n : {std::uint16_t{65533}, std::uint16_t{65534}, std::uint16_t{1}, std::uint16_t{1}})
        session.accept(pose_frame(n), 1s);
    CHECK(session.statistics().lost == 2);
    CHECK(session.statistics().duplicate == 1);
    CHECK(session.accept(pose_frame(0, 10.0), 1s) == Verdict::pose);
    CHECK(session.statistics().restarts == 1);
    CHECK_FALSE(session.state().earlier.has_value());
    CHECK(session.accept(pose_frame(1, 20.0), 1500ms, 1) == Verdict::rejected);
    CHECK(session.statistics().rejected_for(Reject::other_host) == 1);
    CHECK(session.state().pose->position.latitude.value == 10.0);
    CHECK(session.accept(pose_frame(2, 20.0), 2001ms, 1) == Verdict::pose);
    CHECK(session.accept(pose_frame(1, 10.0), 2002ms, 0) == Verdict::rejected);
}

TEST_CASE("A stream in any pieces gives the same frames, and no bytes make the readers fail") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    Bytes stream;
    for (std::uint16_t n = 0; n < 200; ++n) stream = std::move(stream) + pose_frame(n);
    FrameBuffer buffer;
    std::span<const std::byte> rest(stream);
    std::uint16_t seen = 0;
    while (!rest.empty()) {
        auto piece = rest.first(std::min<std::size_t>(rest.size(), 1 + random() % 100));
        rest = rest.subspan(piece.size());
        while (const auto frame = buffer.next(piece)) {
            const Bytes expected = pose_frame(seen++);
            REQUIRE(std::ranges::equal(*frame, expected));
        }
    }
    CHECK(seen == 200);
    Session session = modbus_session();
    for (int i = 0; i < 20000; ++i) {
        Bytes bytes = random() % 2 == 0 ? pose_frame(static_cast<std::uint16_t>(i)) : Bytes(random() % 300);
        for (std::size_t k = random() % 4; k > 0 && !bytes.empty(); --k)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        FrameBuffer any;
        std::span<const std::byte> piece(bytes);
        while (const auto frame = any.next(piece))
            session.accept(*frame, i * 1ms, static_cast<std::uint32_t>(random() % 12));
        session.accept(bytes, i * 1ms);
    }
}

TEST_CASE("A host whose connection closed goes on over its next one, and another begins anew, without waiting") {
    Session session = modbus_session();
    CHECK(session.accept(pose_frame(7), 0ms, 1) == Verdict::pose);
    CHECK(session.accept(pose_frame(8), 16ms, 2) == Verdict::rejected);
    session.connection_closes(2);
    CHECK(session.accept(pose_frame(9), 17ms, 3) == Verdict::rejected);
    session.connection_closes(1);
    CHECK(session.accept(pose_frame(10), 32ms, 4) == Verdict::pose);
    CHECK(session.statistics().lost == 2);
    CHECK(session.statistics().restarts == 0);
    for (const auto& [sequence, arrival] : {std::pair{std::uint16_t{10}, 48ms}, {std::uint16_t{11}, 2000ms}}) {
        session.connection_closes(sequence == 10 ? 4 : 5);
        CHECK(session.accept(pose_frame(sequence), arrival, sequence == 10 ? 5 : 6) == Verdict::pose);
    }
    CHECK(session.statistics().restarts == 2);
}

TEST_CASE("mbpoll drives the link by one write, and reads the known values and the status back") {
    Live live;
    const std::string peer = "mbpoll -m tcp -0 -p " + std::to_string(live.link.port()) + " ";
    std::string values;
    for (const auto word : kExample) values += " " + std::to_string(word);
    CHECK_THAT(output_of(peer + "-r 0 -t 4 127.0.0.1" + values), Catch::Contains("Written 24 references"));
    REQUIRE(live.sees(1));
    CHECK(live.state.pose->position.latitude.value == 47.26);
    live.link.frame_begins({123456, 0ms, 7});
    const std::string words = output_of(peer + "-1 -q -r 0 -c 26 -t 3:hex 127.0.0.1");
    for (const auto& [place, value] : std::vector<std::pair<int, std::string>>{{0, "0x0001"},
                                                                               {1, "0x1234"},
                                                                               {2, "0x1234"},
                                                                               {3, "0x5678"},
                                                                               {4, "0x47F1"},
                                                                               {5, "0x2000"},
                                                                               {16, "0x0001"},
                                                                               {17, "0x0007"},
                                                                               {18, "0x0001"},
                                                                               {19, "0xE240"},
                                                                               {21, "0x0007"},
                                                                               {23, "0x0001"},
                                                                               {25, "0x0000"}})
        CHECK_THAT(words, Catch::Contains("[" + std::to_string(place) + "]: \t" + value));
    CHECK_THAT(output_of(peer + "-1 -q -r 4 -c 1 -t 3:float -B 127.0.0.1"), Catch::Contains("123456"));
    CHECK_THAT(output_of(peer + "-1 -q -r 16 -c 2 -t 4:hex 127.0.0.1"), Catch::Contains("0x42B4"));
    CHECK_THAT(output_of(peer + "-r 50 -t 4 127.0.0.1 1"), Catch::Contains("Illegal data address"));
    CHECK_THAT(output_of(peer + "-1 -q -r 200 -c 2 -t 4 127.0.0.1"), Catch::Contains("Illegal data address"));
}

TEST_CASE("pymodbus drives the link at 60 Hz, every pose whole") {
    Live live;
    const auto script = scratch("host.py");
    std::ofstream(script) << R"(
import struct, sys, time
from pymodbus.client import ModbusTcpClient
client = ModbusTcpClient("127.0.0.1", port=int(sys.argv[1]))
assert client.connect()
start = time.monotonic()
for n in range(90):
    block = struct.pack(">HHIdddfffHH", 1, n, n * 16, 47.0 + n * 1e-4, 11.0, 500.0, 90.0, 1.0, 2.0, 0, n)
    answer = client.write_registers(0, list(struct.unpack(">24H", block)))
    assert not answer.isError(), answer
    time.sleep(max(0.0, start + (n + 1) / 60 - time.monotonic()))
known = client.read_input_registers(2, 8).registers
assert struct.unpack(">Ifd", struct.pack(">8H", *known)) == (0x12345678, 123456.0, 123456.789), known
print("well")
)";
    const std::string said = output_of("/usr/bin/python3 " + script.string() + " " + std::to_string(live.link.port()));
    INFO(said);
    CHECK_THAT(said, Catch::EndsWith("well\n"));
    REQUIRE(live.sees(90));
    CHECK(live.state.pose->position.latitude.value == 47.0 + 89 * 1e-4);
    CHECK(live.state.pose->source_time == 89 * 16ms);
    CHECK(live.link.statistics().lost == 0);
    CHECK(live.link.statistics().frames == 90);
}

TEST_CASE("Slow, broken, silent and deaf clients do not hold a host up") {
    Live live;
    const std::uint16_t port = live.link.port();
    const Client slow(port), broken(port), deaf(port), host(port);
    std::vector<std::unique_ptr<Client>> silent;
    for (int i = 0; i < 10; ++i) silent.push_back(std::make_unique<Client>(port));
    broken.send(Bytes(300, std::byte{0xFF}));
    const Bytes reading = from_hex("000100000006ff0300000018");
    const Bytes slowly = pose_frame(1000, 1.0);
    Bytes flood;
    for (int i = 0; i < 200; ++i) flood = std::move(flood) + reading;
    std::chrono::steady_clock::duration longest{};
    for (std::uint16_t n = 0; n < 60; ++n) {
        slow.send({slowly[n]});
        ::send(deaf.s, flood.data(), flood.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        const auto before = std::chrono::steady_clock::now();
        const Bytes answer = host.ask(pose_frame(n));
        longest = std::max(longest, std::chrono::steady_clock::now() - before);
        REQUIRE(answer.size() == 12);
    }
    // A machine that is busy elsewhere is not what is asked about: a client that holds the server up does so for its
    // time-out, half a second or more, every time.
    CHECK(longest < 1500ms);
    CHECK(live.sees(60));
    CHECK(live.link.statistics().rejected_for(Reject::too_many_clients) >= 1);
    CHECK(live.link.statistics().rejected_for(Reject::bad_request) >= 1);
    CHECK(live.state.pose->position.latitude.value == 47.26);
}

TEST_CASE("An exception response sent to the link is counted and not answered, and ends the connection") {
    Live live;
    const Client confused(live.link.port()), host(live.link.port());
    CHECK(confused.ask(from_hex("000100000003018301")).empty());
    CHECK(host.ask(pose_frame(1)).size() == 12);
    CHECK(live.link.statistics().rejected_for(Reject::bad_request) == 1);
}

TEST_CASE("A peer that a Modbus link is not told to hear finds its connection closed, and moves nothing") {
    Live closed("?allow=10.8.0.0/13,192.0.2.10"), open("?allow=127.0.0.0/8");
    Client stranger(closed.link.port()), host(open.link.port());
    CHECK(stranger.ask(pose_frame(1)).empty());
    CHECK(host.ask(pose_frame(1)).size() == 12);
    CHECK(open.sees(1));
    CHECK_FALSE(closed.link.take_newest(closed.state));
    CHECK(closed.link.statistics().rejected_for(Reject::not_allowed) == 1);
    CHECK(closed.link.statistics().datagrams == 0);
    CHECK(open.link.statistics().rejected_in_all() == 0);
}
