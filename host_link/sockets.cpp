#include "host_link/sockets.h"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "host_link/internet_address.h"

namespace quadrig::host {

Descriptor::~Descriptor() {
    if (fd >= 0) close(fd);
}

void throw_errno(const LinkUrl& url, const std::string& what) {
    throw std::runtime_error("link '" + url.text + "': " + what + ": " + std::system_category().message(errno));
}

void switch_on(int socket, int level, int option) {
    const int on = 1;
    setsockopt(socket, level, option, &on, sizeof on);
}

void queue_with_times(int socket, int bytes) {
    switch_on(socket, SOL_SOCKET, SO_TIMESTAMPNS);
    setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
}

Descriptor can_socket(const LinkUrl& url, int flags, const std::string& what) {
    Descriptor bus(socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | flags, CAN_RAW));
    if (bus.fd < 0) throw_errno(url, "this system's kernel has no CAN");
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(url.address.c_str()));
    if (address.can_ifindex == 0 || bind(bus.fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw_errno(url, what);
    return bus;
}

Descriptor listening_socket(const LinkUrl& url, int waiting) {
    sockaddr_storage address{};
    const socklen_t size = socket_address(url, address);
    Descriptor listening(socket(address.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (listening.fd < 0) throw_errno(url, "cannot open a socket");
    switch_on(listening.fd, SOL_SOCKET, SO_REUSEADDR);
    if (bind(listening.fd, reinterpret_cast<const sockaddr*>(&address), size) != 0) throw_errno(url, "cannot bind");
    if (listen(listening.fd, waiting) != 0) throw_errno(url, "cannot listen");
    return listening;
}

std::optional<Connection> accept_connection(int listening) {
    Connection next;
    socklen_t size = sizeof next.from;
    next.socket =
        Descriptor(accept4(listening, reinterpret_cast<sockaddr*>(&next.from), &size, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (next.socket.fd < 0) return std::nullopt;
    return next;
}

}  // namespace quadrig::host
