/// A live link to a CAN bus: a raw SocketCAN socket.
#pragma once

#include <linux/can.h>

#include "host_link/live_link.h"
#include "host_link/sockets.h"
#include "host_link/trust.h"

namespace quadrig::host {

/// Between our frames and Linux's, which has the identifier and the flags in one number of the host's byte order.
CanFrame from_kernel(const struct ::can_frame& frame);
struct ::can_frame to_kernel(const CanFrame& frame);

class CanLink final : public LiveLink {
  public:
    /// Binds to the interface. Throws std::runtime_error with the URL and the system's reason.
    explicit CanLink(const LinkUrl& url);
    ~CanLink() override { stop(); }

    [[nodiscard]] std::string place() const override { return "interface " + url().address; }

  private:
    void receive() override;
    bool drain();  ///< whether the bus is up
    void send(std::span<const std::byte> record, Time now);

    Descriptor socket_;
    ReplyRate reply_rate_;
};

}  // namespace quadrig::host
