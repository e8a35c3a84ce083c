#include "host_link/internet_address.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>

namespace quadrig::host {

namespace {

/// Empty where the name has no address of that family: `error` is getaddrinfo's.
std::string numeric_address(const std::string& name, int family, int& error) {
    addrinfo wanted{};
    wanted.ai_family = family;
    wanted.ai_socktype = SOCK_STREAM;  // each address once
    addrinfo* list = nullptr;
    error = getaddrinfo(name.c_str(), nullptr, &wanted, &list);
    if (error != 0) return {};
    std::array<char, NI_MAXHOST> text{};
    error = getnameinfo(list->ai_addr, list->ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST);
    freeaddrinfo(list);
    return text.data();
}

}  // namespace

LinkUrl looked_up(LinkUrl url) {
    if (url.protocol == Protocol::canaerospace || ip_address(url.address)) return url;
    const auto& reply = url.trust.reply;
    std::string address;
    int error = 0;
    for (const int family : {AF_INET, AF_INET6})
        if (address.empty() && (!reply || reply->address.v6 == (family == AF_INET6)))
            address = numeric_address(url.address, family, error);
    if (address.empty())
        throw LinkUrlError("link '" + url.text + "': host '" + url.address + "': " + gai_strerror(error));
    url.address = address;
    return url;
}

socklen_t socket_address(const LinkUrl& url, sockaddr_storage& storage) {
    const auto address = ip_address(url.address);
    if (!address) throw std::runtime_error("link '" + url.text + "': not a numeric address");
    return socket_address(Endpoint{*address, url.port.value_or(0)}, storage);
}

socklen_t socket_address(const Endpoint& endpoint, sockaddr_storage& storage) {
    if (!endpoint.address.v6) {
        sockaddr_in v4{};
        v4.sin_family = AF_INET;
        v4.sin_port = htons(endpoint.port);
        std::memcpy(&v4.sin_addr, endpoint.address.bytes.data(), sizeof v4.sin_addr);
        std::memcpy(&storage, &v4, sizeof v4);
        return sizeof v4;
    }
    sockaddr_in6 v6{};
    v6.sin6_family = AF_INET6;
    v6.sin6_port = htons(endpoint.port);
    std::memcpy(&v6.sin6_addr, endpoint.address.bytes.data(), sizeof v6.sin6_addr);
    std::memcpy(&storage, &v6, sizeof v6);
    return sizeof v6;
}

Endpoint endpoint_of(const sockaddr_storage& storage) {
    Endpoint endpoint;
    if (storage.ss_family == AF_INET) {
        sockaddr_in v4{};
        std::memcpy(&v4, &storage, sizeof v4);
        endpoint.port = ntohs(v4.sin_port);
        std::memcpy(endpoint.address.bytes.data(), &v4.sin_addr, sizeof v4.sin_addr);
        return endpoint;
    }
    sockaddr_in6 v6{};
    std::memcpy(&v6, &storage, sizeof v6);
    endpoint.port = ntohs(v6.sin6_port);
    const bool mapped = IN6_IS_ADDR_V4MAPPED(&v6.sin6_addr);
    endpoint.address.v6 = !mapped;
    // ::ffff:a.b.c.d ends in the IPv4 address.
    const auto* bytes = v6.sin6_addr.s6_addr;
    std::copy(bytes + (mapped ? 12 : 0), bytes + 16, endpoint.address.bytes.begin());
    return endpoint;
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
