/// A live Modbus/TCP server: hosts write poses into its registers, anybody reads them and the status.
#pragma once

#include <list>

#include "host_link/live_link.h"
#include "host_link/modbus.h"
#include "host_link/sockets.h"
#include "host_link/trust.h"

struct _modbus;  // libmodbus' names for its types
struct _modbus_mapping_t;

namespace quadrig::host {

/// One thread serves all clients; none can hold it up. Bytes are gathered without waiting, requests are checked before
/// libmodbus sees them, and a client that does not take its answers is let go.
class ModbusLink final : public LiveLink {
  public:
    static constexpr std::size_t kMostClients = 8;
    /// A newcomer that finds all places taken gets that of a client silent for this long.
    static constexpr Time kIdle = std::chrono::seconds(10);

    /// Listens. Throws std::runtime_error with the URL and the system's reason.
    explicit ModbusLink(const LinkUrl& url);
    ~ModbusLink() override;

    void frame_begins(const FrameStatus& status) override;

    [[nodiscard]] std::string place() const override { return "port " + std::to_string(port()); }
    [[nodiscard]] std::uint16_t port() const override;

  private:
    struct Client {
        Connection connection;
        std::uint32_t number = 0;  ///< of all connections ever
        Time heard{};
        modbus::FrameBuffer frames;
        bool gone = false;  ///< to be let go
    };

    void receive() override;
    void admit();
    std::list<Client>::iterator let_go(std::list<Client>::iterator client);
    void hear_client(Client& client);
    bool answer(Client& client, std::span<const std::byte> frame);
    void refresh_status();
    void refuse(Reject reason);

    Descriptor listening_;
    PeerGate gate_;
    _modbus* context_;
    _modbus_mapping_t* mapping_;
    std::list<Client> clients_;
    std::uint32_t connections_ = 0;
    std::uint16_t own_port_ = 0;
    std::atomic<std::uint32_t> frame_{0}, misses_{0};
};

}  // namespace quadrig::host
