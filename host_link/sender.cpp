#include "host_link/sender.h"

#include <linux/can/raw.h>
#include <net/if.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <map>
#include <stdexcept>
#include <system_error>

#include "host_link/can_frame.h"
#include "host_link/can_link.h"
#include "host_link/internet_address.h"
#include "host_link/live_link.h"
#include "host_link/modbus.h"

namespace quadrig::host {

namespace {

constexpr int kPatience = 1000;  // ms

[[noreturn]] void fail(const LinkUrl& url, const std::string& what) {
    throw std::runtime_error("link '" + url.text + "': " + what + ": " + std::system_category().message(errno));
}

int connected(const LinkUrl& url, int type) {
    sockaddr_storage address{};
    const socklen_t size = socket_address(url, address);
    const int fd = socket(address.ss_family, type | SOCK_CLOEXEC, 0);
    if (fd >= 0 && connect(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0) return fd;
    if (fd >= 0) close(fd);
    fail(url, "cannot connect");
}

class UdpSender final : public Sender {
  public:
    explicit UdpSender(const LinkUrl& url) : socket_(connected(url, SOCK_DGRAM)) {}
    bool send(std::span<const std::byte> bytes, std::uint32_t) override {
        return ::send(socket_.fd, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
    }

  private:
    Descriptor socket_;
};

class StreamSender final : public Sender {
  public:
    explicit StreamSender(const LinkUrl& url) : socket_(connected(url, SOCK_STREAM)) {
        const int on = 1;
        setsockopt(socket_.fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    }
    bool send(std::span<const std::byte> bytes, std::uint32_t) override {
        return ::send(socket_.fd, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
    }

  private:
    Descriptor socket_;
};

class CanSender final : public Sender {
  public:
    explicit CanSender(const LinkUrl& url) : socket_(socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW)) {
        if (socket_.fd < 0) fail(url, "this system's kernel has no CAN");
        sockaddr_can address{};
        address.can_family = AF_CAN;
        address.can_ifindex = static_cast<int>(if_nametoindex(url.address.c_str()));
        if (address.can_ifindex == 0 ||
            bind(socket_.fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            fail(url, "cannot send there");
    }
    bool send(std::span<const std::byte> bytes, std::uint32_t) override {
        const auto record = host::can_frame(bytes);
        if (!record) return false;
        const struct ::can_frame frame = to_kernel(*record);
        // A queue that is full empties at the bus's own pace.
        for (int attempt = 0; attempt < kPatience; ++attempt) {
            if (write(socket_.fd, &frame, sizeof frame) == sizeof frame) return true;
            if (errno != ENOBUFS && errno != EINTR) return false;
            poll(nullptr, 0, 1);
        }
        return false;
    }

  private:
    Descriptor socket_;
};

class ModbusSender final : public Sender {
  public:
    explicit ModbusSender(const LinkUrl& url) : url_(url) { connection(0); }
    bool send(std::span<const std::byte> bytes, std::uint32_t source) override {
        const int fd = connection(source);
        if (::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(bytes.size())) return false;
        modbus::FrameBuffer answer;
        std::array<std::byte, modbus::kLargestFrame> received{};
        pollfd waiting{fd, POLLIN, 0};
        while (poll(&waiting, 1, kPatience) == 1) {
            const auto size = recv(fd, received.data(), received.size(), 0);
            if (size <= 0) return false;
            std::span<const std::byte> stream(received.data(), static_cast<std::size_t>(size));
            if (answer.next(stream)) return true;
        }
        return false;
    }

  private:
    int connection(std::uint32_t source) {
        const auto [place, is_new] = connections_.try_emplace(source);
        if (is_new) {
            place->second = std::make_unique<Descriptor>(connected(url_, SOCK_STREAM));
            const int on = 1;
            setsockopt(place->second->fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        }
        return place->second->fd;
    }

    LinkUrl url_;
    std::map<std::uint32_t, std::unique_ptr<Descriptor>> connections_;
};

}  // namespace

std::unique_ptr<Sender> open_sender(const LinkUrl& given) {
    const LinkUrl url = looked_up(given);
    switch (url.protocol) {
        case Protocol::canaerospace:
            return std::make_unique<CanSender>(url);
        case Protocol::modbus:
            return std::make_unique<ModbusSender>(url);
        case Protocol::cigi:
        case Protocol::flightgear_fdm:
            break;
    }
    if (url.tcp) return std::make_unique<StreamSender>(url);
    return std::make_unique<UdpSender>(url);
}

}  // namespace quadrig::host
