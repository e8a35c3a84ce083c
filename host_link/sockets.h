/// Sockets of links and senders.
#pragma once

#include <sys/socket.h>

#include <optional>
#include <string>
#include <utility>

#include "host_link/link_url.h"

namespace quadrig::host {

/// An open file descriptor, closed at its end.
struct Descriptor {
    int fd = -1;
    Descriptor() = default;
    explicit Descriptor(int f) : fd(f) {}
    Descriptor(Descriptor&& other) noexcept : fd(std::exchange(other.fd, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(fd, other.fd);
        return *this;
    }
    ~Descriptor();
};

/// Throws std::runtime_error with the URL, what failed, and errno's words.
[[noreturn]] void throw_errno(const LinkUrl& url, const std::string& what);

/// Sets one of a socket's options that are on or off.
void switch_on(int socket, int level, int option);

/// Has the kernel stamp what comes with its time (SO_TIMESTAMPNS), and keep up to `bytes` of it waiting.
void queue_with_times(int socket, int bytes);

/// A raw SocketCAN socket bound to the URL's interface, with `flags` as of socket(2). Throws as
/// throw_errno does, with `what`.
Descriptor can_socket(const LinkUrl& url, int flags, const std::string& what);

/// Bound to the URL's address for TCP, with that many connections waiting at most; not to be waited on by accept.
/// Throws as throw_errno does.
Descriptor listening_socket(const LinkUrl& url, int waiting);

struct Connection {
    Descriptor socket;  ///< not to be waited on
    sockaddr_storage from{};
};
/// The connection that has waited longest; absent where there is none.
std::optional<Connection> accept_connection(int listening);

}  // namespace quadrig::host
