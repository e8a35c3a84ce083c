/// The other end of a link: sends what a host has sent.
#pragma once

#include <memory>
#include <span>
#include <system_error>

#include "host_link/link_url.h"

namespace quadrig::host {

class Sender {
  public:
    virtual ~Sender() = default;
    Sender() = default;
    Sender(const Sender&) = delete;
    Sender& operator=(const Sender&) = delete;

    /// A datagram, a CAN record or a Modbus request of the connection `source`, as Capture holds them; why it did not
    /// leave, or no error. The next one may: UDP finds a host that has come meanwhile. A connection is lost for good
    /// with broken_pipe or connection_reset. Waits where the bus or the server is slow.
    virtual std::error_code send(std::span<const std::byte> bytes, std::uint32_t source) = 0;
    /// Modbus: ends the connection `source`.
    virtual void close(std::uint32_t /*source*/) {}
};

/// To where `given` says, which is a live one with a port. Throws std::runtime_error with the URL and the system's
/// reason.
std::unique_ptr<Sender> open_sender(const LinkUrl& given);

}  // namespace quadrig::host
