#include "host_link/modbus_link.h"

#include <modbus/modbus.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <vector>

#include "host_link/internet_address.h"
#include "host_link/modbus_pose.h"

namespace quadrig::host {

ModbusLink::ModbusLink(const LinkUrl& given)
    : LiveLink(given),
      listening_(listening_socket(static_cast<int>(kMostClients))),
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
    for (Client& client : clients_) let_go(client);
    modbus_mapping_free(mapping_);
    modbus_free(context_);
}

std::uint16_t ModbusLink::port() const { return bound_port(listening_.fd); }

void ModbusLink::frame_begins(const FrameStatus& status) {
    frame_.store(status.frame, std::memory_order_relaxed);
    misses_.store(status.misses, std::memory_order_relaxed);
}

void ModbusLink::let_go(Client& client) {
    if (!client.gone) close(client.socket);
    client.gone = true;
}

void ModbusLink::receive() {
    std::vector<pollfd> waiting;
    while (true) {
        waiting = {pollfd{wake_descriptor(), POLLIN, 0}, pollfd{listening_.fd, POLLIN, 0}};
        for (const Client& client : clients_) waiting.push_back({client.socket, POLLIN, 0});
        if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return;
        if (waiting[0].revents != 0) return;
        auto next = waiting.begin() + 2;
        for (Client& client : clients_)
            if ((next++)->revents != 0) hear_client(client);
        clients_.remove_if([](const Client& client) { return client.gone; });
        if (waiting[1].revents != 0) admit();
    }
}

void ModbusLink::turn_away(int socket, Reject reason) {
    close(socket);
    const auto lock = lock_session();
    session().refuse(reason);
}

void ModbusLink::admit() {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    const int socket =
        accept4(listening_.fd, reinterpret_cast<sockaddr*>(&address), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket < 0) return;
    if (!gate_.allows(endpoint_of(address).address)) return turn_away(socket, Reject::not_allowed);
    const Time now = clock_time(CLOCK_MONOTONIC);
    if (clients_.size() == kMostClients) {
        const auto idle = std::ranges::min_element(clients_, {}, &Client::heard);
        if (now - idle->heard < kIdle) return turn_away(socket, Reject::too_many_clients);
        let_go(*idle);
        clients_.erase(idle);
    }
    const int on = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    clients_.push_back({socket, connections_++, address, now, {}, false});
}

void ModbusLink::hear_client(Client& client) {
    std::array<std::byte, 4096> bytes{};
    const auto size = recv(client.socket, bytes.data(), bytes.size(), 0);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) return let_go(client);
    client.heard = clock_time(CLOCK_MONOTONIC);
    std::span<const std::byte> stream(bytes.data(), static_cast<std::size_t>(size));
    while (const auto frame = client.frames.next(stream)) {
        {
            const auto lock = lock_session();
            const Verdict verdict = hear({client.heard, *frame, client.number, client.address, own_port_});
            if (verdict == Verdict::pose) publish();
        }
        if (!answer(client, *frame)) return let_go(client);
    }
    if (!client.frames.broken()) return;
    {
        const auto lock = lock_session();
        session().refuse(Reject::bad_request);
    }
    let_go(client);
}

bool ModbusLink::answer(Client& client, std::span<const std::byte> frame) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(frame.data());
    // An exception response: its own exception's function would wrap round to that of a sound answer.
    if (bytes[modbus::kHeaderSize] >= 0x80) return false;
    const auto read = modbus::read_request(frame);
    modbus_set_socket(context_, client.socket);
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
