#include "host_link/sender.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <map>

#include "host_link/can_frame.h"
#include "host_link/can_link.h"
#include "host_link/internet_address.h"
#include "host_link/modbus.h"
#include "host_link/sockets.h"

namespace quadrig::host {

namespace {

constexpr int kPatience = 1000;  // ms

/// Of type SOCK_DGRAM or SOCK_STREAM.
Descriptor connected_socket(const LinkUrl& url, int type) {
    sockaddr_storage address{};
    const socklen_t size = socket_address(url, address);
    Descriptor connected(socket(address.ss_family, type | SOCK_CLOEXEC, 0));
    if (connected.fd < 0 || connect(connected.fd, reinterpret_cast<const sockaddr*>(&address), size) != 0)
        throw_errno(url, "cannot connect");
    if (type == SOCK_STREAM) switch_on(connected.fd, IPPROTO_TCP, TCP_NODELAY);
    return connected;
}

std::error_code last_error() { return {errno, std::generic_category()}; }

std::error_code send_all(const Descriptor& socket, std::span<const std::byte> bytes) {
    const auto sent = send(socket.fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0) return last_error();
    // A stream that took a part cannot take the next packet: where this one ends nobody could tell.
    return static_cast<std::size_t>(sent) == bytes.size() ? std::error_code()
                                                          : std::make_error_code(std::errc::broken_pipe);
}

class InternetSender final : public Sender {
  public:
    explicit InternetSender(const LinkUrl& url) : socket_(connected_socket(url, url.tcp ? SOCK_STREAM : SOCK_DGRAM)) {}
    std::error_code send(std::span<const std::byte> bytes, std::uint32_t) override { return send_all(socket_, bytes); }

  private:
    Descriptor socket_;
};

class CanSender final : public Sender {
  public:
    explicit CanSender(const LinkUrl& url) : socket_(can_socket(url, 0, "cannot send there")) {}
    std::error_code send(std::span<const std::byte> bytes, std::uint32_t) override {
        const auto record = host::can_frame(bytes);
        if (!record) return std::make_error_code(std::errc::bad_message);
        const struct ::can_frame frame = to_kernel(*record);
        // A queue that is full empties at the bus's own pace.
        for (int attempt = 0; attempt < kPatience; ++attempt) {
            if (write(socket_.fd, &frame, sizeof frame) == sizeof frame) return {};
            if (errno != ENOBUFS && errno != EINTR) return last_error();
            poll(nullptr, 0, 1);
        }
        return std::make_error_code(std::errc::no_buffer_space);
    }

  private:
    Descriptor socket_;
};

class ModbusSender final : public Sender {
  public:
    explicit ModbusSender(const LinkUrl& url) : url_(url) { connection(0); }
    std::error_code send(std::span<const std::byte> bytes, std::uint32_t source) override {
        const Descriptor& server = connection(source);
        if (const auto failure = send_all(server, bytes)) return failure;
        modbus::FrameBuffer answer;
        std::array<std::byte, modbus::kLargestFrame> received{};
        pollfd waiting{server.fd, POLLIN, 0};
        while (poll(&waiting, 1, kPatience) == 1) {
            const auto size = recv(server.fd, received.data(), received.size(), 0);
            if (size < 0) return last_error();
            if (size == 0) return std::make_error_code(std::errc::connection_reset);
            std::span<const std::byte> stream(received.data(), static_cast<std::size_t>(size));
            if (answer.next(stream)) return {};
        }
        return std::make_error_code(std::errc::timed_out);
    }

    void close(std::uint32_t source) override { connections_.erase(source); }

  private:
    const Descriptor& connection(std::uint32_t source) {
        const auto known = connections_.find(source);
        if (known != connections_.end()) return known->second;
        return connections_.emplace(source, connected_socket(url_, SOCK_STREAM)).first->second;
    }

    LinkUrl url_;
    std::map<std::uint32_t, Descriptor> connections_;  ///< by source
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
    return std::make_unique<InternetSender>(url);
}

}  // namespace quadrig::host
