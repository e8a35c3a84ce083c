/// Links as users name them: cigi://ADDRESS:PORT, fdm://ADDRESS:PORT, can://INTERFACE, modbus://ADDRESS:PORT, and for a
/// recording just
/// cigi:, fdm:, can: or modbus:.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "host_link/canaerospace_pose.h"
#include "host_link/cigi_format.h"
#include "host_link/modbus_pose.h"
#include "host_link/trust.h"

namespace quadrig::host {

enum class Protocol : std::uint8_t { cigi, flightgear_fdm, canaerospace, modbus };
inline constexpr std::size_t kProtocolCount = 4;

/// "cigi", "fdm", "can", "modbus": the scheme of its URLs.
std::string_view name_of(Protocol protocol);
/// "CIGI", "FlightGear FDM", "CANaerospace", "Modbus".
std::string_view title_of(Protocol protocol);

/// A link that cannot be understood, or is not supported: wrong use (exit status 2). The message names the URL.
struct LinkUrlError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct LinkUrl {
    Protocol protocol = Protocol::cigi;
    std::string text;     ///< as given
    bool live = false;    ///< says where to listen; a bare protocol names a recording's
    std::string address;  ///< numeric, without brackets, 127.0.0.1 where none was given; or a host's name, which
                          ///< looked_up (internet_address.h) makes numeric; CAN: the interface
    std::optional<std::uint16_t> port;          ///< 0: any free port; absent for CAN and a bare protocol
    bool tcp = false;                           ///< FlightGear over TCP: ?transport=tcp
    std::optional<cigi::Version> cigi_version;  ///< ?version=
    std::optional<std::uint16_t> ownship;       ///< ?ownship=ID
    std::optional<std::uint16_t> view;          ///< ?view=ID
    std::optional<std::int8_t> database;        ///< ?database=N: the scene's number; absent: whatever the host asks for
    bool synchronous = false;                   ///< ?operation=synchronous
    std::optional<double> altitude_offset;      ///< ?altitude_offset=METRES, added to the host's altitudes
    canaerospace::PoseSettings canaerospace;    ///< ?position=, ?commit=, ?channel=, ?timeout=
    modbus::PoseSettings modbus;                ///< ?base=, ?word_order=
    std::optional<std::uint8_t> can_node;       ///< ?node=ID
    TrustSettings trust;                        ///< ?allow=, ?host=, ?reply=, ?reply_rate=, ?silence=
};

/// Reads SCHEME: or SCHEME://[ADDRESS]:PORT[?KEY=VALUE[&KEY=VALUE…]]. ADDRESS is IPv4, [IPv6], localhost or a host's
/// name, or can://INTERFACE[?…]. Keys: altitude_offset, silence (milliseconds, 100 to 3,600,000); cigi: version (3, 3.0
/// to 3.3, 4, 4.0), ownship, view, database (1 to 127), operation (asynchronous or synchronous); can: position (gps,
/// ins, auxiliary), commit (an identifier, 0 to 2047), channel (0 to 255), timeout (milliseconds, 1 to 60000), node (1
/// to 255). Of live links: allow (ADDRESS[/BITS], with commas; not can), host (first or newest; cigi and fdm), reply
/// (ADDRESS:PORT; cigi), transport (udp or tcp; fdm), reply_rate (1 to 1000; cigi and can). Throws LinkUrlError.
LinkUrl parse_link_url(std::string_view text);

}  // namespace quadrig::host
