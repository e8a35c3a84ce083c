/// Recorded traffic: the datagrams of one host out of a pcap or pcapng file, or the frames of one CAN bus out of one of
/// these or a candump log, with their capture times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host_link/host_state.h"
#include "host_link/link_url.h"

namespace quadrig::host {

/// Everything in a file that is not a datagram of the flow taken, by why.
struct CaptureCounts {
    std::uint64_t packets = 0;     ///< read from the file, of all kinds
    std::uint64_t not_udp = 0;     ///< other network or transport protocols, TCP that is not Modbus among them
    std::uint64_t fragments = 0;   ///< of IP datagrams: skipped
    std::uint64_t damaged = 0;     ///< headers cut or contradicting themselves
    std::uint64_t other_flow = 0;  ///< UDP of other senders or ports, replies to the host among them
};

/// "10.0.0.5 -> 127.0.0.1:8004": a sender's address and the receiver's address and port. Two source ports are one flow,
/// as on a live link: a host that comes back has a new one.
struct Flow {
    std::string source;  ///< CAN: the interface, and the rest is empty
    std::string destination;
    std::uint16_t destination_port = 0;
};
std::string text(const Flow& flow);

struct Capture {
    struct Datagram {
        Time captured{};           ///< since 1970
        std::size_t offset = 0;    ///< in `bytes`
        std::size_t size = 0;      ///< what the file holds of it
        std::uint32_t source = 0;  ///< Modbus: which of the file's connections it came over, counted from 0
    };

    /// Modbus: a connection that was closed.
    struct Closing {
        std::size_t datagrams = 0;  ///< before it
        std::uint32_t source = 0;
    };

    Protocol protocol = Protocol::cigi;
    Flow flow;
    std::vector<Datagram> datagrams;  ///< in the file's order
    std::vector<Closing> closings;    ///< in the file's order
    std::vector<std::byte> bytes;
    CaptureCounts counts;
    std::optional<std::string>
        truncated;  ///< the file ends in the middle of a packet: the reader's words; all before it is here

    [[nodiscard]] std::span<const std::byte> payload(const Datagram& d) const {
        return std::span(bytes).subspan(d.offset, d.size);
    }
    /// What was closed after the datagram before this one.
    [[nodiscard]] std::span<const Closing> closed_before(std::size_t datagram) const;
};

/// Whether a file holds a frame as candump writes it (-l, -L) within its first 4096 bytes.
bool is_candump_log(const std::filesystem::path& path);

/// Reads a capture and takes the flow with the most datagrams that look like a host's, of `protocol` or, without one,
/// of any. CAN frames are LINKTYPE_CAN_SOCKETCAN records, Modbus
/// requests whole frames. All datagrams of that flow are there, sound or not: judging
/// them is the Session's. Links: Ethernet (VLAN tags too), raw IP, Linux cooked 1 and 2, BSD loopback, SocketCAN. IPv4
/// and IPv6; UDP checksums are not looked at. Throws std::runtime_error, with the file's name, where it cannot be read
/// or holds no host.
///
/// `whole`: all flows are taken together, as a link has heard them that recorded them.
Capture read_capture(const std::filesystem::path& path, std::optional<Protocol> protocol = std::nullopt,
                     bool whole = false);

}  // namespace quadrig::host
