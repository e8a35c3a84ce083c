#include "host_link/udp_link.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace quadrig::host {

namespace {

constexpr unsigned kBatch = 32;
constexpr std::size_t kLargestDatagram = 65535;
// A second of a fast host's messages, so that a stall of ours loses none.
constexpr int kReceiveBuffer = 1 << 20;

[[noreturn]] void fail(const LinkUrl& url, const std::string& what) {
    throw std::runtime_error("link '" + url.text + "': " + what + ": " + std::system_category().message(errno));
}

Time clock_time(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

// The kernel stamps datagrams by CLOCK_REALTIME, which may be set; the two clocks are compared afresh for every batch.
Time arrival_time(msghdr& header, Time realtime, Time monotonic) {
    for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
        if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_TIMESTAMPNS) continue;
        timespec stamp{};
        std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
        const Time age = realtime - (std::chrono::seconds(stamp.tv_sec) + std::chrono::nanoseconds(stamp.tv_nsec));
        if (age >= Time(0) && age < std::chrono::seconds(60)) return monotonic - age;
    }
    return monotonic;
}

socklen_t endpoint(const LinkUrl& url, sockaddr_storage& storage) {
    const auto port = htons(url.port.value_or(0));
    sockaddr_in v4{};
    if (inet_pton(AF_INET, url.address.c_str(), &v4.sin_addr) == 1) {
        v4.sin_family = AF_INET;
        v4.sin_port = port;
        std::memcpy(&storage, &v4, sizeof v4);
        return sizeof v4;
    }
    sockaddr_in6 v6{};
    if (inet_pton(AF_INET6, url.address.c_str(), &v6.sin6_addr) != 1)
        throw std::runtime_error("link '" + url.text + "': not a numeric address");
    v6.sin6_family = AF_INET6;
    v6.sin6_port = port;
    std::memcpy(&storage, &v6, sizeof v6);
    return sizeof v6;
}

}  // namespace

struct UdpLink::Batch {
    std::vector<std::byte> bytes = std::vector<std::byte>(kBatch * kLargestDatagram);
    std::array<iovec, kBatch> vectors{};
    std::array<mmsghdr, kBatch> messages{};
    std::array<Peer, kBatch> peers{};
    struct alignas(cmsghdr) Control {
        std::array<char, CMSG_SPACE(sizeof(timespec))> room;
    };
    std::array<Control, kBatch> controls{};

    void prepare() {
        for (std::size_t i = 0; i < kBatch; ++i) {
            vectors[i] = {bytes.data() + i * kLargestDatagram, kLargestDatagram};
            msghdr& header = messages[i].msg_hdr;
            header = {};
            header.msg_name = &peers[i].address;
            header.msg_namelen = sizeof peers[i].address;
            header.msg_iov = &vectors[i];
            header.msg_iovlen = 1;
            header.msg_control = controls[i].room.data();
            header.msg_controllen = controls[i].room.size();
        }
    }
};

UdpLink::Descriptor::~Descriptor() {
    if (fd >= 0) close(fd);
}

UdpLink::UdpLink(LinkUrl url)
    : url_(std::move(url)),
      socket_(socket(url_.address.find(':') == std::string::npos ? AF_INET : AF_INET6,
                     SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (!url_.port) throw std::runtime_error("link '" + url_.text + "': a live link needs ADDRESS:PORT");
    if (socket_.fd < 0 || wake_.fd < 0) fail(url_, "cannot open a socket");
    const int on = 1;
    setsockopt(socket_.fd, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
    setsockopt(socket_.fd, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
    sockaddr_storage storage{};
    const socklen_t size = endpoint(url_, storage);
    if (bind(socket_.fd, reinterpret_cast<const sockaddr*>(&storage), size) != 0) fail(url_, "cannot bind");
}

UdpLink::~UdpLink() { stop(); }

std::uint16_t UdpLink::port() const {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    getsockname(socket_.fd, reinterpret_cast<sockaddr*>(&storage), &size);
    sockaddr_in v4{};
    // The port stands at the same place in both families.
    static_assert(offsetof(sockaddr_in, sin_port) == offsetof(sockaddr_in6, sin6_port));
    std::memcpy(&v4, &storage, sizeof v4);
    return ntohs(v4.sin_port);
}

void UdpLink::start(const SessionOptions& options) {
    if (session_) throw std::logic_error("a link starts once");
    session_ = std::make_unique<Session>(options);
    thread_ = std::thread([this] { receive(); });
}

void UdpLink::stop() {
    if (!thread_.joinable()) return;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = write(wake_.fd, &one, sizeof one);
    thread_.join();
}

void UdpLink::receive() {
    const auto batch = std::make_unique<Batch>();
    std::array<pollfd, 2> waiting{pollfd{socket_.fd, POLLIN, 0}, pollfd{wake_.fd, POLLIN, 0}};
    while (true) {
        if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return;
        if (waiting[1].revents != 0) return;
        batch->prepare();
        // An error here is news of an earlier reply that nobody wanted (ECONNREFUSED); the socket goes on.
        const int count = recvmmsg(socket_.fd, batch->messages.data(), kBatch, 0, nullptr);
        if (count > 0) accept_batch(*batch, count);
    }
}

void UdpLink::accept_batch(Batch& batch, int count) {
    const Time realtime = clock_time(CLOCK_REALTIME);
    const Time monotonic = clock_time(CLOCK_MONOTONIC);
    std::optional<std::size_t> newest;
    const std::lock_guard lock(session_mutex_);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        msghdr& header = batch.messages[i].msg_hdr;
        const std::span datagram(batch.bytes.data() + i * kLargestDatagram, batch.messages[i].msg_len);
        const Verdict verdict = session_->accept(datagram, arrival_time(header, realtime, monotonic));
        batch.peers[i].size = header.msg_namelen;
        if (verdict == Verdict::pose || verdict == Verdict::no_pose) newest = i;
    }
    if (newest) mailbox_.publish({session_->state(), session_->reply_context(), batch.peers[*newest]});
}

bool UdpLink::take_newest(HostState& state) {
    if (!mailbox_.take(latched_)) return false;
    state = latched_.state;
    return true;
}

void UdpLink::send_start_of_frame(std::uint32_t ig_frame, Time now) {
    if (!latched_.reply || latched_.peer.size == 0) return;
    std::array<std::byte, cigi::StartOfFrame::kSize> packet{};
    const std::size_t size = start_of_frame(*latched_.reply, ig_frame, now, packet);
    const auto sent = sendto(socket_.fd, packet.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(&latched_.peer.address), latched_.peer.size);
    auto& counter = sent == static_cast<ssize_t>(size) ? replies_sent_ : replies_failed_;
    counter.fetch_add(1, std::memory_order_relaxed);
}

LinkStatistics UdpLink::statistics() const {
    const std::lock_guard lock(session_mutex_);
    if (session_) return session_->statistics();
    LinkStatistics none;
    none.protocol = url_.protocol;
    return none;
}

}  // namespace quadrig::host
