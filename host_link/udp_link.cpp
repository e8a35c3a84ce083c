#include "host_link/udp_link.h"

#include <poll.h>

#include <algorithm>
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
constexpr int kDatagramBuffer = 1 << 20;

bool is_loopback(const std::string& address) { return address.starts_with("127.") || address == "::1"; }

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
                     SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)),
      gate_(url().trust),
      reply_rate_(url().trust.reply_rate),
      open_(!is_loopback(url().address) && url().trust.allow.empty() && !url().trust.reply) {
    if (socket_.fd < 0) throw_errno(url(), "cannot open a socket");
    queue_with_times(socket_.fd, kDatagramBuffer);
    sockaddr_storage storage{};
    const socklen_t size = socket_address(url(), storage);
    if (bind(socket_.fd, reinterpret_cast<const sockaddr*>(&storage), size) != 0) throw_errno(url(), "cannot bind");
    if (url().trust.reply) {
        reply_to_.emplace();
        reply_to_->size = socket_address(*url().trust.reply, reply_to_->address);
    }
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
        const Time arrival = arrival_time(header, realtime, monotonic);
        Peer& peer = batch.peers[i];
        const Endpoint from = endpoint_of(peer.address);
        const PeerGate::Judgement judgement = gate_.judge(from, arrival);
        if (judgement.refused) {
            session().refuse(*judgement.refused);
            continue;
        }
        if (judgement.passes_on) host_changes();
        const Verdict verdict = hear({arrival, datagram, 0, peer.address, own_port});
        queue(session().responses());
        if (verdict != Verdict::pose && verdict != Verdict::no_pose) continue;
        gate_.taken(from, arrival);
        bytes_taken_ += datagram.size();
        peer.size = header.msg_namelen;
        peer.bytes_taken = bytes_taken_;
        newest = i;
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

std::size_t UdpLink::largest_reply(std::uint64_t bytes_taken) {
    if (!open_) return kLargestMessage;
    bytes_answered_ = std::max(bytes_answered_, bytes_taken - std::min(bytes_taken, kMostCredit));
    return static_cast<std::size_t>(std::min<std::uint64_t>(kLargestMessage, bytes_taken - bytes_answered_));
}

void UdpLink::look_for_answer() {
    if (!url().synchronous) return;
    if (told_of_last_frame_ && heard() == heard_at_last_frame_) unanswered_.fetch_add(1, std::memory_order_relaxed);
    heard_at_last_frame_ = heard();
}

void UdpLink::append(const Session::Response& response, std::size_t& size) {
    std::memcpy(message_.data() + size, response.bytes.data(), response.size);
    size += response.size;
}

void UdpLink::keep(const Session::Response& message) {
    if (kept_.full()) return hold_reply_back();
    kept_.push_back(message);
}

void UdpLink::append_message(std::uint64_t bytes_taken, std::size_t largest, std::size_t& size) {
    if (kept_.empty()) return;
    const std::size_t wanted = kept_[0].size;
    if (size + wanted > largest || bytes_taken - bytes_at_last_message_ < wanted) return;
    append(kept_[0], size);
    bytes_at_last_message_ = bytes_taken;
    kept_.erase(kept_.begin());
}

void UdpLink::frame_begins(const FrameStatus& status) {
    look_for_answer();
    send_start_of_frame(status.frame, status.now, status.misses != misses_);
    misses_ = status.misses;
}

void UdpLink::send_start_of_frame(std::uint32_t ig_frame, Time now, bool overframing) {
    told_of_last_frame_ = false;
    const auto& [state, reply, peer, heard] = latched();
    if (!reply || peer.size == 0) return;
    const std::size_t largest = largest_reply(peer.bytes_taken);
    std::size_t size =
        start_of_frame(*reply, ig_frame, now, overframing, std::span(message_).first<cigi::StartOfFrame::kSize>());
    if (size > largest || !reply_rate_.take(now)) return hold_reply_back();
    std::size_t next = taken_.load(std::memory_order_relaxed);
    for (const std::size_t end = queued_.load(std::memory_order_acquire); next != end; ++next) {
        const Session::Response& response = waiting_[next % kMostWaiting];
        if (!response.asked) {
            keep(response);
            continue;
        }
        if (size + response.size > largest) break;
        append(response, size);
    }
    taken_.store(next, std::memory_order_release);
    append_message(peer.bytes_taken, largest, size);
    bytes_answered_ += size;
    const Peer& to = reply_to_ ? *reply_to_ : peer;
    const auto sent = sendto(socket_.fd, message_.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(&to.address), to.size);
    told_of_last_frame_ = sent == static_cast<ssize_t>(size);
    count_reply(told_of_last_frame_);
}

}  // namespace quadrig::host
