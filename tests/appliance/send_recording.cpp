/// send_recording RECORDING PORT [SECONDS]: plays a recorded flight's datagrams to 127.0.0.1:PORT in their own time,
/// over and over, for so long (default: once).
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <iostream>

#include "frame_scheduler/frame_clock.h"
#include "host_link/capture.h"

using namespace quadrig;

namespace {

void send_all(const host::Capture& flight, std::uint16_t port, double seconds) {
    const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    scheduler::MonotonicClock clock;
    const scheduler::Time start = clock.now();
    const scheduler::Time first = flight.datagrams.front().captured;
    const scheduler::Time length = flight.datagrams.back().captured - first + std::chrono::microseconds(16667);
    std::size_t sent = 0;
    for (scheduler::Time round{0};; round += length) {
        for (const auto& datagram : flight.datagrams) {
            const scheduler::Time at = round + datagram.captured - first;
            if (std::chrono::duration<double>(at).count() >= seconds) {
                std::cerr << sent << " datagrams sent\n";
                return;
            }
            clock.sleep_until(start + at);
            const auto bytes = flight.payload(datagram);
            sent += send(socket, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
        }
    }
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 3) {
        std::cerr << "send_recording RECORDING PORT [SECONDS]\n";
        return 2;
    }
    const host::Capture flight = host::read_capture(argv[1]);
    const scheduler::Time length = flight.datagrams.back().captured - flight.datagrams.front().captured;
    const double once = std::chrono::duration<double>(length).count() + 1e-3;
    send_all(flight, static_cast<std::uint16_t>(std::atoi(argv[2])), argc > 3 ? std::atof(argv[3]) : once);
} catch (const std::exception& error) {
    std::cerr << "send_recording: " << error.what() << '\n';
    return 1;
}
