/// What a message says, field by field, for people to read. Pure.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_link/link_url.h"

namespace quadrig::host {

/// A number as it is on the wire, in the wire's unit, and the range that it should be in.
struct Field {
    std::string_view name;
    double value = 0.0;
    std::string_view unit;
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
    /// Finite, and in its range.
    [[nodiscard]] bool sound() const;
};

/// A packet: its name, where there may be several with the number that tells them apart ("entity_control 3"), and its
/// fields; none where the packet is skipped here.
struct ToldPacket {
    std::string name;
    std::vector<Field> fields;
};

/// The packets of a message as Heard holds it; none where it cannot be read.
std::vector<ToldPacket> told_packets(Protocol protocol, std::span<const std::byte> message);

/// "latitude 47.26 deg"; with "(!)" behind it where the value is not sound.
std::string text_of(const Field& field);

}  // namespace quadrig::host
