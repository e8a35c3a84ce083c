#include "host_link/internet_address.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <cstddef>
#include <cstring>
#include <stdexcept>

namespace quadrig::host {

socklen_t socket_address(const LinkUrl& url, sockaddr_storage& storage) {
    const auto port = htons(url.port.value_or(0));
    sockaddr_in v4{};
    if (inet_pton(AF_INET, url.address.c_str(), &v4.sin_addr) == 1) {
        v4.sin_family = AF_INET;
        v4.sin_port = port;
        std::memcpy(&storage, &v4, sizeof v4);
        return sizeof v4;
    }
    sockaddr_in6 v6{};
    if (inet_pton(AF_INET6, url.address.c_str(), &v6.sin6_addr) != 1)
        throw std::runtime_error("link '" + url.text + "': not a numeric address");
    v6.sin6_family = AF_INET6;
    v6.sin6_port = port;
    std::memcpy(&storage, &v6, sizeof v6);
    return sizeof v6;
}

std::uint16_t bound_port(int socket) {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    getsockname(socket, reinterpret_cast<sockaddr*>(&storage), &size);
    sockaddr_in v4{};
    // The port stands at the same place in both families.
    static_assert(offsetof(sockaddr_in, sin_port) == offsetof(sockaddr_in6, sin6_port));
    std::memcpy(&v4, &storage, sizeof v4);
    return ntohs(v4.sin_port);
}

}  // namespace quadrig::host
