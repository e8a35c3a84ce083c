#include "host_link/can_link.h"

#include <linux/can.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace quadrig::host {

namespace {

// A second of a bus at its busiest, so that a stall of ours loses nothing.
constexpr int kBusBuffer = 4 << 20;
constexpr std::chrono::milliseconds kBusDownPause{100};

}  // namespace

CanFrame from_kernel(const struct ::can_frame& frame) {
    CanFrame result;
    result.extended = (frame.can_id & CAN_EFF_FLAG) != 0;
    result.remote = (frame.can_id & CAN_RTR_FLAG) != 0;
    result.error = (frame.can_id & CAN_ERR_FLAG) != 0;
    result.id = frame.can_id & (result.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    if (result.remote) return result;
    result.size = static_cast<std::uint8_t>(std::min<std::size_t>(frame.can_dlc, kCanDataSize));
    std::memcpy(result.data.data(), frame.data, result.size);
    return result;
}

struct ::can_frame to_kernel(const CanFrame& frame) {
    struct ::can_frame result {};
    result.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U) |
                    (frame.error ? CAN_ERR_FLAG : 0U);
    result.can_dlc = frame.size;
    std::memcpy(result.data, frame.data.data(), frame.size);
    return result;
}

CanLink::CanLink(const LinkUrl& given)
    : LiveLink(given), socket_(can_socket(url(), SOCK_NONBLOCK, "cannot listen")), reply_rate_(url().trust.reply_rate) {
    queue_with_times(socket_.fd, kBusBuffer);
}

void CanLink::receive() {
    std::array<pollfd, 2> waiting{pollfd{socket_.fd, POLLIN, 0}, pollfd{wake_descriptor(), POLLIN, 0}};
    while (true) {
        if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return;
        if (waiting[1].revents != 0) return;
        if (!drain()) std::this_thread::sleep_for(kBusDownPause);
    }
}

bool CanLink::drain() {
    struct ::can_frame frame {};
    iovec vector{&frame, sizeof frame};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timespec))> control{};
    while (true) {
        msghdr header{};
        header.msg_iov = &vector;
        header.msg_iovlen = 1;
        header.msg_control = control.data();
        header.msg_controllen = control.size();
        const auto size = recvmsg(socket_.fd, &header, MSG_DONTWAIT);
        if (size < 0) return errno == EAGAIN || errno == EINTR;
        if (size != sizeof frame) continue;
        const Time arrival = arrival_time(header, clock_time(CLOCK_REALTIME), clock_time(CLOCK_MONOTONIC));
        const auto lock = lock_session();
        // Microseconds, as candump's logs have them.
        const auto record = can_record(from_kernel(frame));
        const Verdict verdict = hear({floor<std::chrono::microseconds>(arrival), record});
        if (verdict == Verdict::pose || verdict == Verdict::no_pose) publish();
        send(session().answer(), arrival);
    }
}

void CanLink::send(std::span<const std::byte> record, Time now) {
    if (record.empty()) return;
    if (!reply_rate_.take(now)) return hold_reply_back();
    const struct ::can_frame frame = to_kernel(host::can_frame(record).value());
    count_reply(write(socket_.fd, &frame, sizeof frame) == sizeof frame);
}

}  // namespace quadrig::host
