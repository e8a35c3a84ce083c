#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <thread>

#include "host_link/internet_address.h"
#include "host_link/udp_link.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

Time monotonic_now() { return std::chrono::steady_clock::now().time_since_epoch(); }

/// A host's socket on the loopback interface.
class Peer {
  public:
    /// From an address of the loopback network, 127.0.0.`last`.
    explicit Peer(std::uint16_t port, std::uint32_t last = 1) : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
        sockaddr_in from{};
        from.sin_family = AF_INET;
        from.sin_addr.s_addr = htonl(0x7F000000U + last);
        REQUIRE(bind(socket_, reinterpret_cast<sockaddr*>(&from), sizeof from) == 0);
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(port);
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        REQUIRE(connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0);
    }
    ~Peer() { close(socket_); }
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;
    void send(const Bytes& bytes) { ::send(socket_, bytes.data(), bytes.size(), 0); }
    [[nodiscard]] std::uint16_t port() const { return bound_port(socket_); }
    Bytes receive(std::chrono::milliseconds patience = 2000ms) {
        pollfd waiting{socket_, POLLIN, 0};
        Bytes bytes(5000);
        if (poll(&waiting, 1, static_cast<int>(patience.count())) != 1) return {};
        const auto size = recv(socket_, bytes.data(), bytes.size(), 0);
        bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        return bytes;
    }

  private:
    int socket_;
};

bool wait_until(const auto& condition) {
    for (const auto end = std::chrono::steady_clock::now() + 5s; std::chrono::steady_clock::now() < end;) {
        if (condition()) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

/// Near where the hosts fly, so that they are not warned.
const GeodeticPosition kHome{{40.5}, {11.34}, 0.0};

Bytes frame(std::uint32_t number, ByteOrder order = ByteOrder::big) {
    return message(order, ig_control(number, number * 1667), ownship(40.0 + number * 1e-3));
}

}  // namespace

TEST_CASE("What a host sends over UDP is the newest state a moment later, with a monotonic arrival time") {
    UdpLink link(parse_link_url("cigi://127.0.0.1:0"));
    REQUIRE(link.port() != 0);
    Peer host(link.port());
    const Time before = monotonic_now();
    host.send(frame(0));  // queued by the kernel before the link has started
    link.start(session_options(link.url(), kHome));
    HostState state;
    REQUIRE(wait_until([&] { return link.take_newest(state); }));
    CHECK(state.host_frame == 0U);
    CHECK(state.pose->arrival > before - 5ms);
    CHECK(state.pose->arrival < monotonic_now() + 5ms);
    CHECK_FALSE(link.take_newest(state));
    for (std::uint32_t f = 1; f <= 200; ++f) host.send(frame(f));
    REQUIRE(wait_until([&] {
        link.take_newest(state);
        return state.host_frame == 200U;
    }));
    CHECK(link.statistics().datagrams == 201);
    CHECK(link.statistics().lost == 0);
    CHECK(state.pose->arrival > state.earlier->arrival);
    link.stop();
    CHECK(link.statistics().frames == 201);
}

TEST_CASE("Start Of Frame goes back to the host that was heard last, in its byte order") {
    UdpLink link(parse_link_url("cigi://127.0.0.1:0"));
    link.start(session_options(link.url(), kHome));
    HostState state;
    link.send_start_of_frame(0, 0ms);
    CHECK(link.replies_sent() == 0);
    Peer first(link.port()), second(link.port());
    std::uint32_t number = 0;
    for (const auto& [peer, order] :
         {std::pair{&first, ByteOrder::little}, {&second, ByteOrder::big}, {&first, ByteOrder::little}}) {
        peer->send(frame(++number, order));
        REQUIRE(wait_until([&] { return link.take_newest(state); }));
        link.send_start_of_frame(100 + number, 5ms);
        const Bytes reply = peer->receive();
        REQUIRE(reply.size() == 24);
        const auto sof = cigi::decode<cigi::StartOfFrame>(reply, order);
        CHECK(sof.ig_frame == 100 + number);
        CHECK(sof.last_host_frame == number);
        CHECK(sof.timestamp == 500);
    }
    CHECK(link.replies_sent() == 3);
    CHECK(link.replies_failed() == 0);
}

TEST_CASE("Garbage is counted, answered by nothing, and leaves the link alive") {
    UdpLink link(parse_link_url("cigi://127.0.0.1:0"));
    link.start(session_options(link.url(), kHome));
    Peer host(link.port());
    host.send({});
    host.send(Bytes(1000));
    host.send(from_hex("0118"));
    HostState state;
    REQUIRE(wait_until([&] { return link.statistics().datagrams == 3; }));
    CHECK(link.statistics().rejected_in_all() == 3);
    CHECK_FALSE(link.take_newest(state));
    link.send_start_of_frame(1, 0ms);
    CHECK(host.receive(50ms).empty());
    host.send(frame(1));
    CHECK(wait_until([&] { return link.take_newest(state); }));
}

TEST_CASE("A host that went away does not stop the link") {
    UdpLink link(parse_link_url("cigi://127.0.0.1:0"));
    link.start(session_options(link.url(), kHome));
    HostState state;
    {
        Peer gone(link.port());
        gone.send(frame(1));
        REQUIRE(wait_until([&] { return link.take_newest(state); }));
    }
    for (std::uint32_t i = 0; i < 10; ++i) link.send_start_of_frame(i, 0ms);
    Peer back(link.port());
    back.send(frame(2));
    CHECK(wait_until([&] { return link.take_newest(state); }));
}

TEST_CASE("A flood of datagrams, one in ten valid, loses none of the valid ones that the kernel delivers") {
    UdpLink link(parse_link_url("cigi://127.0.0.1:0"));
    link.start(session_options(link.url(), kHome));
    Peer host(link.port());
    const Bytes noise(64);
    for (std::uint32_t f = 1; f <= 2000; ++f) {
        host.send(frame(f));
        for (int i = 0; i < 9; ++i) host.send(noise);
        if (f % 20 == 0) std::this_thread::sleep_for(1ms);
    }
    // A last one, when the kernel's queue has room again, tells the gap before it.
    std::this_thread::sleep_for(100ms);
    host.send(frame(2001));
    REQUIRE(wait_until(
        [&] { return link.statistics().last_pose && link.statistics().last_pose->position.latitude.value > 42.0005; }));
    const LinkStatistics statistics = link.statistics();
    CHECK(statistics.frames + statistics.lost == 2001);
    CHECK(statistics.frames > 1000);
    CHECK(statistics.rejected_in_all() + statistics.frames == statistics.datagrams);
}

TEST_CASE("Strangers' floods beside an allowed host are counted as theirs, and take no memory") {
    UdpLink link(parse_link_url("cigi://127.0.0.1:0?allow=10.1.0.0/16,127.0.0.1"));
    link.start(session_options(link.url(), kHome));
    Peer host(link.port()), stranger(link.port(), 2);
    const auto resident = [] {
        std::size_t whole = 0, pages = 0;
        std::ifstream("/proc/self/statm") >> whole >> pages;
        return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    };
    [[maybe_unused]] const std::size_t before = resident();
    for (std::uint32_t f = 1; f <= 2000; ++f) {
        host.send(frame(f));
        for (std::uint32_t i = 0; i < 9; ++i) stranger.send(frame(f + 100000 + i));
        // What the kernel drops on the way was never ours to honour.
        if (f % 20 == 0) wait_until([&] { return link.statistics().frames == f; });
    }
    REQUIRE(wait_until([&] {
        const auto now = link.statistics();
        return now.frames == 2000 && now.rejected_for(Reject::not_allowed) == 18000;
    }));
    const LinkStatistics statistics = link.statistics();
    CHECK(statistics.lost == 0);
    CHECK(statistics.restarts == 0);
    CHECK(statistics.datagrams == 2000);
    CHECK(statistics.rejected_in_all() == 18000);
#if !defined(__SANITIZE_ADDRESS__)  // which keeps freed memory for a while
    CHECK(resident() < before + (std::size_t{8} << 20));
#endif
}

TEST_CASE("Of two hosts at once the first holds the link where that is asked for, until it falls silent") {
    UdpLink link(parse_link_url("cigi://127.0.0.1:0?host=first"));
    link.start(session_options(link.url(), kHome));
    Peer first(link.port()), second(link.port());
    second.send(Bytes(8));  // holds nothing: not a host's
    HostState state;
    for (std::uint32_t f = 1; f <= 50; ++f) {
        first.send(frame(f));
        second.send(frame(1000 + f, ByteOrder::little));
        REQUIRE(wait_until([&] { return link.statistics().rejected_for(Reject::other_host) == f; }));
        REQUIRE(wait_until([&] { return link.take_newest(state); }));
        CHECK(state.host_frame == f);
        link.send_start_of_frame(f, 0ms);
        CHECK(cigi::decode<cigi::StartOfFrame>(first.receive(), ByteOrder::big).last_host_frame == f);
    }
    CHECK(second.receive(0ms).empty());
    std::this_thread::sleep_for(kSilence + 10ms);
    second.send(frame(51, ByteOrder::little));
    REQUIRE(wait_until([&] { return link.take_newest(state); }));
    CHECK(state.host_frame == 51U);
    CHECK_FALSE(state.earlier.has_value());
    CHECK(link.statistics().restarts == 1);
    CHECK(link.statistics().lost == 0);
    link.send_start_of_frame(51, 0ms);
    CHECK(second.receive().size() == cigi::StartOfFrame::kSize);
}

TEST_CASE("Replies go to the configured host, whoever speaks, and not more often than asked for") {
    UdpLink probe(parse_link_url("cigi://127.0.0.1:0"));
    Peer configured(probe.port());
    UdpLink link(
        parse_link_url("cigi://127.0.0.1:0?reply_rate=10&reply=127.0.0.1:" + std::to_string(configured.port())));
    link.start(session_options(link.url(), kHome));
    Peer host(link.port());
    host.send(frame(1));
    HostState state;
    REQUIRE(wait_until([&] { return link.take_newest(state); }));
    for (std::uint32_t f = 0; f < 60; ++f) link.send_start_of_frame(f, f * 16667us);
    CHECK(link.replies_sent() == 10);
    CHECK(link.replies_held_back() == 50);
    CHECK(host.receive(0ms).empty());
}

TEST_CASE("A link that anybody may reach sends no more bytes back than came") {
    UdpLink open(parse_link_url("cigi://0.0.0.0:0")), trusted(parse_link_url("cigi://0.0.0.0:0?allow=127.0.0.0/8"));
    for (UdpLink* link : {&open, &trusted}) {
        SessionOptions options = session_options(link->url(), kHome);
        options.surveyor = [](const SurveyLine&) { return std::optional<SurveyHit>(); };
        link->start(options);
        Peer host(link->port());
        cigi::HatHotRequest question;
        question.kind = cigi::HeightKind::extended;
        question.period = 1;
        Bytes asking = message(ByteOrder::big, ig_control(1), ownship());
        for (std::uint16_t i = 0; i < 8; ++i) {
            question.request = i;
            append(asking, question, ByteOrder::big);
        }
        std::size_t sent = 0, received = 0;
        for (std::uint32_t f = 1; f <= 100; ++f) {
            const Bytes bytes = f == 1 ? asking : frame(f);
            host.send(bytes);
            sent += bytes.size();
            HostState state;
            REQUIRE(wait_until([&] { return link->take_newest(state); }));
            link->send_start_of_frame(f, f * 16667us);
        }
        for (Bytes reply = host.receive(100ms); !reply.empty(); reply = host.receive(0ms)) received += reply.size();
        CHECK((received <= sent) == (link == &open));
        CHECK(received > sent / 2);
    }
}

TEST_CASE("A message that nobody asked for waits until as many bytes have come as it has") {
    UdpLink link(parse_link_url("cigi://127.0.0.1:0"));
    link.start(session_options(link.url(), kHome));
    Peer host(link.port());
    auto ig = ig_control(1);
    ig.last_ig_frame.reset();  // before 3.2: 16 bytes
    const Bytes heartbeat = message(ByteOrder::big, ig);
    // 48 bytes, and a warning of 56.
    const Bytes wrong =
        message(ByteOrder::big, ig, cigi::ViewControl{.view = 60000, .yaw_enable = true, .entity = 50000});
    const auto reply_to = [&](const Bytes& bytes) {
        host.send(bytes);
        HostState state;
        REQUIRE(wait_until([&] { return link.take_newest(state); }));
        link.send_start_of_frame(1, 0ms);
        return host.receive();
    };
    CHECK(reply_to(wrong).size() == 16);
    link.send_start_of_frame(2, 16ms);
    CHECK(host.receive().size() == 16);
    const Bytes told = reply_to(heartbeat);
    REQUIRE(told.size() == 16 + 56);
    CHECK(std::string(reinterpret_cast<const char*>(told.data() + 20)) ==
          "view 60000 is on entity 50000, which is unknown");
    CHECK(reply_to(heartbeat).size() == 16);
}

TEST_CASE("A port that is taken is a clear error") {
    UdpLink link(parse_link_url("fdm://127.0.0.1:0"));
    const std::string url = "fdm://127.0.0.1:" + std::to_string(link.port());
    CHECK_THROWS_WITH(UdpLink(parse_link_url(url)), Catch::Contains(url) && Catch::Contains("in use"));
    CHECK_THROWS_WITH(UdpLink(parse_link_url("cigi:")), Catch::Contains("needs ADDRESS:PORT"));
}

TEST_CASE("A link stops at once, started or not, and twice") {
    UdpLink idle(parse_link_url("cigi://127.0.0.1:0"));
    idle.stop();
    UdpLink link(parse_link_url("cigi://127.0.0.1:0"));
    link.start(session_options(link.url(), kHome));
    const auto before = std::chrono::steady_clock::now();
    link.stop();
    link.stop();
    CHECK(std::chrono::steady_clock::now() - before < 1s);
}

TEST_CASE("IPv6 loopback works where the machine has it") {
    const int probe = socket(AF_INET6, SOCK_DGRAM, 0);
    sockaddr_in6 address{};
    address.sin6_family = AF_INET6;
    address.sin6_addr = in6addr_loopback;
    const bool available = probe >= 0 && bind(probe, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    if (!available) {
        if (probe >= 0) close(probe);
        CHECK_THROWS(UdpLink(parse_link_url("cigi://[::1]:0")));
        return;
    }
    UdpLink link(parse_link_url("cigi://[::1]:0"));
    link.start(session_options(link.url(), kHome));
    address.sin6_port = htons(link.port());
    const Bytes bytes = frame(1);
    sendto(probe, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&address), sizeof address);
    HostState state;
    CHECK(wait_until([&] { return link.take_newest(state); }));
    close(probe);
}
