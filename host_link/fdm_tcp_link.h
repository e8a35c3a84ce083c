/// A live FlightGear link over TCP: FlightGear and JSBSim connect as clients, one at a time.
#pragma once

#include "host_link/fdm_stream.h"
#include "host_link/live_link.h"
#include "host_link/sockets.h"
#include "host_link/trust.h"

namespace quadrig::host {

class FdmTcpLink final : public LiveLink {
  public:
    /// A newcomer gets the place of a client silent for this long; before, it is let go.
    static constexpr Time kIdle = std::chrono::seconds(10);

    /// Listens. Throws std::runtime_error with the URL and the system's reason.
    explicit FdmTcpLink(LinkUrl url);
    ~FdmTcpLink() override { stop(); }

    [[nodiscard]] std::string place() const override { return "port " + std::to_string(port()); }
    [[nodiscard]] std::uint16_t port() const override;

  private:
    struct Client {
        Connection connection;
        Time heard{};
        flightgear::PacketStream packets;
    };

    void receive() override;
    void admit();
    void hear_client();

    Descriptor listening_;
    PeerGate gate_;
    std::uint16_t own_port_ = 0;
    std::optional<Client> client_;
};

}  // namespace quadrig::host
