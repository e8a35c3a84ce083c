/// The other end of a UDP link.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>

#include "tests/appliance/flights.h"

namespace quadrig::tests {

/// A host's socket on the loopback interface.
class HostSocket {
  public:
    explicit HostSocket(int port) : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(static_cast<std::uint16_t>(port));
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        REQUIRE(connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0);
    }
    ~HostSocket() { close(socket_); }
    HostSocket(const HostSocket&) = delete;
    HostSocket& operator=(const HostSocket&) = delete;
    void send(const Bytes& bytes) const { ::send(socket_, bytes.data(), bytes.size(), 0); }
    /// With one call for all of them; how many left.
    [[nodiscard]] std::size_t send(std::vector<Bytes>& messages) const {
        std::vector<iovec> pieces;
        for (Bytes& message : messages) pieces.push_back({message.data(), message.size()});
        std::vector<mmsghdr> headers(messages.size());
        for (std::size_t i = 0; i < messages.size(); ++i) {
            headers[i].msg_hdr.msg_iov = &pieces[i];
            headers[i].msg_hdr.msg_iovlen = 1;
        }
        const int sent = sendmmsg(socket_, headers.data(), static_cast<unsigned>(headers.size()), 0);
        return sent > 0 ? static_cast<std::size_t>(sent) : 0;
    }
    /// Empty where nothing comes in time.
    [[nodiscard]] Bytes receive(std::chrono::milliseconds patience) const {
        pollfd waiting{socket_, POLLIN, 0};
        if (poll(&waiting, 1, static_cast<int>(patience.count())) != 1) return {};
        Bytes bytes(65536);
        const auto size = recv(socket_, bytes.data(), bytes.size(), 0);
        bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        return bytes;
    }

  private:
    int socket_;
};

}  // namespace quadrig::tests
