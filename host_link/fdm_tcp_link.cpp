#include "host_link/fdm_tcp_link.h"

#include <poll.h>

#include <array>
#include <cerrno>
#include <utility>

#include "host_link/internet_address.h"

namespace quadrig::host {

FdmTcpLink::FdmTcpLink(LinkUrl given)
    : LiveLink(std::move(given)), listening_(listening_socket(url(), 1)), gate_(url().trust), own_port_(port()) {}

std::uint16_t FdmTcpLink::port() const { return bound_port(listening_.fd); }

void FdmTcpLink::receive() {
    while (true) {
        // poll passes over a descriptor below 0.
        std::array<pollfd, 3> waiting{pollfd{wake_descriptor(), POLLIN, 0}, pollfd{listening_.fd, POLLIN, 0},
                                      pollfd{client_ ? client_->connection.socket.fd : -1, POLLIN, 0}};
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
    auto connection = accept_connection(listening_.fd);
    if (!connection) return;
    const Time now = clock_time(CLOCK_MONOTONIC);
    const bool allowed = gate_.allows(endpoint_of(connection->from).address);
    const auto lock = lock_session();
    if (!allowed) return session().refuse(Reject::not_allowed);
    if (client_ && now - client_->heard < kIdle) return session().refuse(Reject::too_many_clients);
    if (session().state().pose) host_changes();
    client_.emplace(Client{*std::move(connection), now, {}});
}

void FdmTcpLink::hear_client() {
    std::array<std::byte, 4096> bytes{};
    const auto size = recv(client_->connection.socket.fd, bytes.data(), bytes.size(), 0);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) return client_.reset();
    client_->heard = clock_time(CLOCK_MONOTONIC);
    std::span<const std::byte> stream(bytes.data(), static_cast<std::size_t>(size));
    const auto breaks = client_->packets.breaks();
    const auto lock = lock_session();
    while (const auto packet = client_->packets.next(stream))
        if (hear({client_->heard, *packet, 0, client_->connection.from, own_port_}) == Verdict::pose) publish();
    for (auto seen = breaks; seen != client_->packets.breaks(); ++seen) session().refuse(Reject::unknown_version);
}

}  // namespace quadrig::host
