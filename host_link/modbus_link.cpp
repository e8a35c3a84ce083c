#include "host_link/modbus_link.h"

#include <modbus/modbus.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <vector>

#include "host_link/internet_address.h"
#include "host_link/modbus_pose.h"

namespace quadrig::host {

ModbusLink::ModbusLink(const LinkUrl& given)
    : LiveLink(given),
      listening_(listening_socket(url(), static_cast<int>(kMostClients))),
      gate_(url().trust),
      context_(modbus_new_tcp(nullptr, 0)),
      mapping_(modbus_mapping_new_start_address(0, 0, 0, 0, url().modbus.base, modbus::kHoldingRegisters, 0,
                                                modbus::kInputRegisters)) {
    if (context_ == nullptr || mapping_ == nullptr) throw std::bad_alloc();
    // libmodbus sleeps that long before it refuses a request: of those that we let through there is none.
    modbus_set_response_timeout(context_, 0, 1);
    own_port_ = port();
}

ModbusLink::~ModbusLink() {
    stop();
    modbus_mapping_free(mapping_);
    modbus_free(context_);
}

std::uint16_t ModbusLink::port() const { return bound_port(listening_.fd); }

void ModbusLink::frame_begins(const FrameStatus& status) {
    frame_.store(status.frame, std::memory_order_relaxed);
    misses_.store(status.misses, std::memory_order_relaxed);
}

void ModbusLink::receive() {
    std::vector<pollfd> waiting;
    while (true) {
        waiting = {pollfd{wake_descriptor(), POLLIN, 0}, pollfd{listening_.fd, POLLIN, 0}};
        for (const Client& client : clients_) waiting.push_back({client.connection.socket.fd, POLLIN, 0});
        if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return;
        if (waiting[0].revents != 0) return;
        auto next = waiting.begin() + 2;
        for (Client& client : clients_)
            if ((next++)->revents != 0) hear_client(client);
        for (auto client = clients_.begin(); client != clients_.end();)
            if (client->gone)
                client = let_go(client);
            else
                ++client;
        if (waiting[1].revents != 0) admit();
    }
}

void ModbusLink::refuse(Reject reason) {
    const auto lock = lock_session();
    session().refuse(reason);
}

void ModbusLink::admit() {
    auto connection = accept_connection(listening_.fd);
    if (!connection) return;
    if (!gate_.allows(endpoint_of(connection->from).address)) return refuse(Reject::not_allowed);
    const Time now = clock_time(CLOCK_MONOTONIC);
    if (clients_.size() == kMostClients) {
        const auto idle = std::ranges::min_element(clients_, {}, &Client::heard);
        if (now - idle->heard < kIdle) return refuse(Reject::too_many_clients);
        let_go(idle);
    }
    switch_on(connection->socket.fd, IPPROTO_TCP, TCP_NODELAY);
    clients_.push_back({*std::move(connection), connections_++, now, {}, false});
}

std::list<ModbusLink::Client>::iterator ModbusLink::let_go(std::list<Client>::iterator client) {
    const auto lock = lock_session();
    connection_closes({clock_time(CLOCK_MONOTONIC), {}, client->number, client->connection.from, own_port_});
    return clients_.erase(client);
}

void ModbusLink::hear_client(Client& client) {
    std::array<std::byte, 4096> bytes{};
    const auto size = recv(client.connection.socket.fd, bytes.data(), bytes.size(), 0);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    client.gone = size <= 0;
    if (client.gone) return;
    client.heard = clock_time(CLOCK_MONOTONIC);
    std::span<const std::byte> stream(bytes.data(), static_cast<std::size_t>(size));
    while (const auto frame = client.frames.next(stream)) {
        {
            const auto lock = lock_session();
            const Verdict verdict = hear({client.heard, *frame, client.number, client.connection.from, own_port_});
            if (verdict == Verdict::pose) publish();
        }
        client.gone = !answer(client, *frame);
        if (client.gone) return;
    }
    client.gone = client.frames.broken();
    if (client.gone) refuse(Reject::bad_request);
}

bool ModbusLink::answer(Client& client, std::span<const std::byte> frame) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(frame.data());
    // An exception response: its own exception's function would wrap round to that of a sound answer.
    if (bytes[modbus::kHeaderSize] >= 0x80) return false;
    const auto read = modbus::read_request(frame);
    modbus_set_socket(context_, client.connection.socket.fd);
    int sent = 0;
    if (const auto* exception = std::get_if<modbus::Exception>(&read)) {
        sent = modbus_reply_exception(context_, bytes, static_cast<unsigned>(*exception));
    } else {
        const auto& request = std::get<modbus::Request>(read);
        const bool there = modbus::may_read(request, url().modbus) &&
                           (!request.write || modbus::may_write(*request.write, url().modbus));
        refresh_status();
        sent = there ? modbus_reply(context_, bytes, static_cast<int>(frame.size()), mapping_)
                     : modbus_reply_exception(context_, bytes, MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS);
    }
    modbus_set_socket(context_, -1);
    count_reply(sent > 0);
    return sent > 0;
}

void ModbusLink::refresh_status() {
    modbus::Status status;
    status.frame = frame_.load(std::memory_order_relaxed);
    status.misses = misses_.load(std::memory_order_relaxed);
    {
        const auto lock = lock_session();
        status.mode = session().state().mode;
        status.sequence = session().modbus_sequence();
        status.poses = static_cast<std::uint32_t>(session().statistics().frames);
        status.rejected = static_cast<std::uint32_t>(session().statistics().rejected_in_all());
    }
    const auto registers = modbus::input_registers(status, url().modbus.order);
    std::ranges::copy(registers, mapping_->tab_input_registers);
}

}  // namespace quadrig::host
