#include "host_link/link_statistics.h"

#include <algorithm>
#include <numeric>

#include "host_link/canaerospace.h"
#include "host_link/cigi.h"
#include "host_link/modbus.h"

namespace quadrig::host {

namespace {

static_assert(cigi::kKinds <= std::tuple_size_v<decltype(LinkStatistics::packets)>);

std::string_view name_of_packet(Protocol protocol, std::uint16_t kind) {
    switch (protocol) {
        case Protocol::cigi:
            return cigi::packet_name(kind);
        case Protocol::flightgear_fdm:
            return kind == 24 ? "net_fdm_24" : "net_fdm_25";
        case Protocol::canaerospace:
            return canaerospace::parameter_at(kind).name;
        case Protocol::modbus:
            return modbus::name_of(modbus::Function(kind));
    }
    return "unknown";
}

}  // namespace

std::uint64_t LinkStatistics::rejected_in_all() const {
    return std::accumulate(rejected.begin(), rejected.end(), std::uint64_t{0});
}

NamedCounts packets_by_name(const LinkStatistics& statistics) {
    NamedCounts counts;
    for (std::size_t kind = 0; kind < statistics.packets.size(); ++kind) {
        if (statistics.packets[kind] == 0) continue;
        const std::string_view name = name_of_packet(statistics.protocol, static_cast<std::uint16_t>(kind));
        auto known = std::ranges::find(counts, name, &NamedCounts::value_type::first);
        if (known == counts.end()) known = counts.insert(counts.end(), {name, 0});
        known->second += statistics.packets[kind];
    }
    return counts;
}

NamedCounts rejected_by_reason(const LinkStatistics& statistics) {
    NamedCounts counts;
    for (std::size_t reason = 0; reason < kRejectCount; ++reason)
        if (statistics.rejected[reason] != 0) counts.emplace_back(kRejectNames[reason], statistics.rejected[reason]);
    return counts;
}

}  // namespace quadrig::host
