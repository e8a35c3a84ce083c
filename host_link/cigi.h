/// A host's message of the Common Image Generator Interface, 3.3 (and 3.0 to 3.2 where they agree) or 4.0: packets back
/// to back in one datagram. Pure.
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "host_link/cigi_control.h"
#include "host_link/cigi_format.h"
#include "host_link/reject.h"

namespace quadrig::host::cigi {

/// A message whose framing is sound: it starts with IG Control, every packet fits, and has the size that its id asks
/// for.
struct Message {
    Format format;
    IgControl ig_control;
    std::span<const std::byte> packets;  ///< the whole datagram, to be taken apart with next_packet
};

/// Checks a datagram from its first byte to its last. It is sound as a whole or refused as a whole: what follows a
/// wrong size cannot be trusted, and what came before it belongs to a message that nobody sent. IG Control says which
/// version it is and, by its byte swap field or, in 4.0, by its size, which byte order.
std::variant<Message, Reject> open_message(std::span<const std::byte> datagram);

/// Whether a datagram claims to be a host's message of CIGI 3 or 4, whatever is wrong with it further on.
bool looks_like_host_message(std::span<const std::byte> datagram);

}  // namespace quadrig::host::cigi
