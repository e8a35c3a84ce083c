#include "host_link/udp_link.h"

#include <poll.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

#include "host_link/internet_address.h"

namespace quadrig::host {

namespace {

constexpr unsigned kBatch = 32;
constexpr std::size_t kLargestDatagram = 65535;
// A second of a fast host's messages, so that a stall of ours loses none.
constexpr int kReceiveBuffer = 1 << 20;

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

UdpLink::UdpLink(LinkUrl given)
    : LiveLink(std::move(given)),
      socket_(socket(url().address.find(':') == std::string::npos ? AF_INET : AF_INET6,
                     SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    if (socket_.fd < 0) fail("cannot open a socket");
    const int on = 1;
    setsockopt(socket_.fd, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
    setsockopt(socket_.fd, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
    sockaddr_storage storage{};
    const socklen_t size = socket_address(url(), storage);
    if (bind(socket_.fd, reinterpret_cast<const sockaddr*>(&storage), size) != 0) fail("cannot bind");
}

std::uint16_t UdpLink::port() const { return bound_port(socket_.fd); }

void UdpLink::receive() {
    const auto batch = std::make_unique<Batch>();
    std::array<pollfd, 2> waiting{pollfd{socket_.fd, POLLIN, 0}, pollfd{wake_descriptor(), POLLIN, 0}};
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
    const std::uint16_t own_port = port();
    std::optional<std::size_t> newest;
    const auto lock = lock_session();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        msghdr& header = batch.messages[i].msg_hdr;
        const std::span datagram(batch.bytes.data() + i * kLargestDatagram, batch.messages[i].msg_len);
        const Verdict verdict =
            hear({arrival_time(header, realtime, monotonic), datagram, 0, batch.peers[i].address, own_port});
        queue(session().responses());
        batch.peers[i].size = header.msg_namelen;
        if (verdict == Verdict::pose || verdict == Verdict::no_pose) newest = i;
    }
    if (newest) publish(batch.peers[*newest]);
}

void UdpLink::queue(std::span<const Session::Response> responses) {
    std::size_t next = queued_.load(std::memory_order_relaxed);
    for (const Session::Response& response : responses) {
        if (next - taken_.load(std::memory_order_acquire) == kMostWaiting) {
            session().drop_answer();
            continue;
        }
        waiting_[next++ % kMostWaiting] = response;
    }
    queued_.store(next, std::memory_order_release);
}

void UdpLink::send_start_of_frame(std::uint32_t ig_frame, Time now) {
    const auto& [state, reply, peer, heard] = latched();
    if (!reply || peer.size == 0) return;
    std::size_t size = start_of_frame(*reply, ig_frame, now, std::span(message_).first<cigi::StartOfFrame::kSize>());
    std::size_t next = taken_.load(std::memory_order_relaxed);
    for (const std::size_t end = queued_.load(std::memory_order_acquire); next != end; ++next) {
        const Session::Response& response = waiting_[next % kMostWaiting];
        if (size + response.size > kLargestMessage) break;
        std::memcpy(message_.data() + size, response.bytes.data(), response.size);
        size += response.size;
    }
    taken_.store(next, std::memory_order_release);
    const auto sent = sendto(socket_.fd, message_.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(&peer.address), peer.size);
    count_reply(sent == static_cast<ssize_t>(size));
}

}  // namespace quadrig::host
