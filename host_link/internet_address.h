/// Socket addresses of links.
#pragma once

#include <sys/socket.h>

#include <cstdint>

#include "host_link/link_url.h"
#include "host_link/trust.h"

namespace quadrig::host {

/// A link whose host is named, with the address that the system finds for it: of IPv4, where there is none of IPv6; of
/// its reply's family, if it has one. Waits for the name servers. Throws LinkUrlError with the resolver's reason.
LinkUrl looked_up(LinkUrl url);

/// A link's numeric address and port for bind and connect; returns its size. Throws std::runtime_error with the URL
/// where the address is not numeric.
socklen_t socket_address(const LinkUrl& url, sockaddr_storage& storage);

/// The same of an endpoint.
socklen_t socket_address(const Endpoint& endpoint, sockaddr_storage& storage);
/// A peer's, of IPv4 also where the socket is an IPv6 one.
Endpoint endpoint_of(const sockaddr_storage& storage);

/// The port that a socket is bound to.
std::uint16_t bound_port(int socket);

}  // namespace quadrig::host
