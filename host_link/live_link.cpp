#include "host_link/live_link.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <utility>

#include "host_link/can_link.h"
#include "host_link/fdm_tcp_link.h"
#include "host_link/internet_address.h"
#include "host_link/modbus_link.h"
#include "host_link/udp_link.h"

namespace quadrig::host {

LiveLink::LiveLink(LinkUrl url) : url_(std::move(url)), wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (!url_.live)
        throw std::runtime_error("link '" + url_.text + "': a live link needs ADDRESS:PORT, or on CAN an interface");
    if (wake_.fd < 0) throw_errno(url_, "cannot open a descriptor");
}

void LiveLink::start(const SessionOptions& options) {
    if (session_) throw std::logic_error("a link starts once");
    session_ = std::make_unique<Session>(options);
    thread_ = std::thread([this] { receive(); });
}

void LiveLink::stop() {
    if (!thread_.joinable()) return;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = write(wake_.fd, &one, sizeof one);
    thread_.join();
}

bool LiveLink::take_newest(HostState& state) {
    if (!mailbox_.take(latched_)) return false;
    state = latched_.state;
    return true;
}

Verdict LiveLink::hear(Heard heard) {
    heard.changes = std::exchange(changes_, 0);
    if (tap_) tap_(heard);
    return session_->accept(heard.bytes, heard.arrival, heard.source);
}

void LiveLink::connection_closes(Heard heard) {
    heard.closes = true;
    if (tap_) tap_(heard);
    session_->connection_closes(heard.source);
}

void LiveLink::host_changes() {
    session_->host_changes();
    ++changes_;
}

void LiveLink::count_reply(bool sent) {
    (sent ? replies_sent_ : replies_failed_).fetch_add(1, std::memory_order_relaxed);
}

LinkStatistics LiveLink::statistics() const {
    const std::lock_guard lock(session_mutex_);
    if (session_) return session_->statistics();
    LinkStatistics none;
    none.protocol = url_.protocol;
    return none;
}

Time clock_time(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

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

std::unique_ptr<LiveLink> open_link(const LinkUrl& given) {
    const LinkUrl url = looked_up(given);
    if (url.protocol == Protocol::canaerospace) return std::make_unique<CanLink>(url);
    if (url.protocol == Protocol::modbus) return std::make_unique<ModbusLink>(url);
    if (url.tcp) return std::make_unique<FdmTcpLink>(url);
    return std::make_unique<UdpLink>(url);
}

}  // namespace quadrig::host
