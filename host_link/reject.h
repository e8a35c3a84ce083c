/// Why something a host sent was not taken. Every reason has its own counter, and its name in reports.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace quadrig::host {

enum class Reject : std::uint8_t {
    truncated,               ///< the datagram ends before its packets do
    bad_size,                ///< a packet size below 2, not a multiple of 8, or not the one of its packet id
    no_ig_control,           ///< a CIGI message of a host starts with IG Control
    start_of_frame,          ///< the message of an image generator: it starts with Start Of Frame
    bad_byte_order,          ///< the byte swap field holds neither 0x8000 nor 0x0080
    unknown_version,         ///< a major version (CIGI) or version (FDM) that is not read here, or not asked for
    byte_swapped_version,    ///< FDM: 24 or 25 in little-endian order; the host forgot to convert to network order
    version_size_mismatch,   ///< FDM: the version of one layout with the size of another
    out_of_range,            ///< a number that is not finite, or outside the range its field has
    bad_attachment,          ///< CIGI: an entity attached to itself, by way of others too, or too many deep
    view_of_unknown_entity,  ///< CIGI: View Control puts our view on an entity that the host has not named
    not_data_frame,          ///< CAN: a remote frame, an error report, CAN FD, or a damaged record
    unknown_channel,         ///< CANaerospace: a redundancy channel above 255, or one more than are followed
    bad_data_type,           ///< CANaerospace: a parameter in a type that it cannot have
    lone_half,               ///< CANaerospace: half of a float64 whose other half did not come
    incomplete_pose,         ///< CANaerospace: the completing message came while a part was missing or too old
    bad_request,             ///< Modbus: a function that is not served, or counts that contradict each other
    bad_address,             ///< Modbus: registers that are not there, or are not for hosts to write
    commit_mismatch,         ///< Modbus: the commit register was not the sequence number
    other_host,              ///< of a second host while the first one holds the link
    too_many_clients,        ///< connections that found every place taken
    not_allowed,             ///< of a peer that the link's allow-list does not name
    count
};

inline constexpr std::size_t kRejectCount = static_cast<std::size_t>(Reject::count);
inline constexpr std::array<std::string_view, kRejectCount> kRejectNames{"truncated",
                                                                         "bad_size",
                                                                         "no_ig_control",
                                                                         "start_of_frame",
                                                                         "bad_byte_order",
                                                                         "unknown_version",
                                                                         "byte_swapped_version",
                                                                         "version_size_mismatch",
                                                                         "out_of_range",
                                                                         "bad_attachment",
                                                                         "view_of_unknown_entity",
                                                                         "not_data_frame",
                                                                         "unknown_channel",
                                                                         "bad_data_type",
                                                                         "lone_half",
                                                                         "incomplete_pose",
                                                                         "bad_request",
                                                                         "bad_address",
                                                                         "commit_mismatch",
                                                                         "other_host",
                                                                         "too_many_clients",
                                                                         "not_allowed"};

constexpr std::string_view name_of(Reject reason) { return kRejectNames[static_cast<std::size_t>(reason)]; }

}  // namespace quadrig::host
