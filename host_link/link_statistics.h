/// What came over a link, counted: every way to lose something has its own counter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host_link/host_state.h"
#include "host_link/link_url.h"
#include "host_link/reject.h"

namespace quadrig::host {

/// Intervals between the arrivals of accepted poses that are longer than the session's gap threshold.
struct Gaps {
    std::uint64_t count = 0;
    Time longest{};
};

struct LinkStatistics {
    Protocol protocol = Protocol::cigi;
    std::uint64_t datagrams = 0;
    std::uint64_t bytes = 0;
    std::uint64_t frames = 0;  ///< poses accepted
    /// In sound datagrams. CIGI: by cigi::Kind, FDM: by version, CANaerospace: by parameter_index, Modbus: by function.
    std::array<std::uint64_t, 262> packets{};
    std::array<std::uint64_t, kRejectCount> rejected{};  ///< by Reject
    std::uint64_t lost = 0;
    std::uint64_t duplicate = 0;
    std::uint64_t reordered = 0;
    std::uint64_t restarts = 0;          ///< the host began to count anew
    std::uint64_t other_entities = 0;    ///< most active at a time beside the ownship
    std::uint64_t entities_dropped = 0;  ///< packets of entities beyond those that are followed
    std::uint64_t regions_dropped = 0;   ///< packets of weather regions beyond those that are kept
    std::uint64_t answers_dropped = 0;   ///< requests about the scene beyond what is answered at a time
    std::optional<PoseSample> first_pose;
    std::optional<PoseSample> last_pose;
    Gaps gaps;

    [[nodiscard]] std::uint64_t rejected_for(Reject reason) const { return rejected[static_cast<std::size_t>(reason)]; }
    [[nodiscard]] std::uint64_t rejected_in_all() const;
};

using NamedCounts = std::vector<std::pair<std::string_view, std::uint64_t>>;

/// Counts that are not zero, under the names that reports use.
NamedCounts packets_by_name(const LinkStatistics& statistics);
NamedCounts rejected_by_reason(const LinkStatistics& statistics);

}  // namespace quadrig::host
