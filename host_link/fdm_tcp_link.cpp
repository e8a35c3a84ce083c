#include "host_link/fdm_tcp_link.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "host_link/internet_address.h"

namespace quadrig::host {

FdmTcpLink::FdmTcpLink(LinkUrl given)
    : LiveLink(std::move(given)), listening_(listening_socket(1)), gate_(url().trust), own_port_(port()) {}

FdmTcpLink::~FdmTcpLink() {
    stop();
    let_go();
}

std::uint16_t FdmTcpLink::port() const { return bound_port(listening_.fd); }

void FdmTcpLink::let_go() {
    if (client_) close(client_->socket);
    client_.reset();
}

void FdmTcpLink::receive() {
    while (true) {
        // poll passes over a descriptor below 0.
        std::array<pollfd, 3> waiting{pollfd{wake_descriptor(), POLLIN, 0}, pollfd{listening_.fd, POLLIN, 0},
                                      pollfd{client_ ? client_->socket : -1, POLLIN, 0}};
        if (poll(waiting.data(), waiting.size(), -1) < 0) {
            if (errno != EINTR) return;
            continue;
        }
        if (waiting[0].revents != 0) return;
        // First the client: one that went away makes room.
        if (waiting[2].revents != 0) hear_client();
        if (waiting[1].revents != 0) admit();
    }
}

void FdmTcpLink::admit() {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    const int socket =
        accept4(listening_.fd, reinterpret_cast<sockaddr*>(&address), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket < 0) return;
    const Time now = clock_time(CLOCK_MONOTONIC);
    const bool allowed = gate_.allows(endpoint_of(address).address);
    const auto lock = lock_session();
    if (!allowed || (client_ && now - client_->heard < kIdle)) {
        close(socket);
        session().refuse(allowed ? Reject::too_many_clients : Reject::not_allowed);
        return;
    }
    let_go();
    if (session().state().pose) session().host_changes();
    client_.emplace(Client{socket, address, now, {}});
}

void FdmTcpLink::hear_client() {
    std::array<std::byte, 4096> bytes{};
    const auto size = recv(client_->socket, bytes.data(), bytes.size(), 0);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) return let_go();
    client_->heard = clock_time(CLOCK_MONOTONIC);
    std::span<const std::byte> stream(bytes.data(), static_cast<std::size_t>(size));
    const auto breaks = client_->packets.breaks();
    const auto lock = lock_session();
    while (const auto packet = client_->packets.next(stream))
        if (hear({client_->heard, *packet, 0, client_->address, own_port_}) == Verdict::pose) publish();
    for (auto seen = breaks; seen != client_->packets.breaks(); ++seen) session().refuse(Reject::unknown_version);
}

}  // namespace quadrig::host
