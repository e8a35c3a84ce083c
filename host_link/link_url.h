/// Links as users name them: cigi://ADDRESS:PORT, fdm://ADDRESS:PORT, and for a recording just cigi: or fdm:.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace quadrig::host {

enum class Protocol : std::uint8_t { cigi, flightgear_fdm };

/// "cigi", "fdm": the scheme of its URLs.
std::string_view name_of(Protocol protocol);

/// A link that cannot be understood, or is not supported: wrong use (exit status 2). The message names the URL.
struct LinkUrlError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct LinkUrl {
    Protocol protocol = Protocol::cigi;
    std::string text;                       ///< as given
    std::string address;                    ///< numeric, without brackets; 127.0.0.1 where none was given
    std::optional<std::uint16_t> port;      ///< absent for a bare protocol, which names a recording's; 0: any free port
    std::optional<std::uint16_t> ownship;   ///< ?ownship=ID
    std::optional<std::uint16_t> view;      ///< ?view=ID
    std::optional<double> altitude_offset;  ///< ?altitude_offset=METRES, added to the host's altitudes
};

/// Reads SCHEME: or SCHEME://[ADDRESS]:PORT[?KEY=VALUE[&KEY=VALUE…]]. ADDRESS is IPv4, [IPv6] or localhost.
/// Keys: version (cigi; 3, 3.0 to 3.3), ownship, view (cigi), altitude_offset.
/// Throws LinkUrlError.
LinkUrl parse_link_url(std::string_view text);

}  // namespace quadrig::host
