#include "host_link/capture.h"

#include <arpa/inet.h>
#include <pcap/pcap.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <compare>
#include <map>
#include <memory>
#include <stdexcept>

#include "host_link/cigi.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/network_packet.h"

namespace quadrig::host {

namespace {

struct FlowKey {
    IpAddress source, destination;
    std::uint16_t destination_port = 0;
    friend auto operator<=>(const FlowKey&, const FlowKey&) = default;
};

/// How many datagrams of a flow look like a host's, by protocol; and which flow came first, to settle ties.
struct FlowCount {
    std::array<std::uint64_t, 2> matches{};
    std::uint64_t all = 0;
    std::size_t order = 0;
};

struct Read {
    std::map<FlowKey, FlowCount> flows;
    std::vector<std::size_t> flow_of;  ///< of each datagram: FlowCount::order
    Capture capture;                   ///< every UDP datagram of the file
};

constexpr std::array kProtocols{Protocol::cigi, Protocol::flightgear_fdm};

bool looks_like(Protocol protocol, std::span<const std::byte> payload) {
    if (protocol == Protocol::cigi) return cigi::looks_like_host_message(payload);
    const auto decoded = flightgear::decode(payload);
    if (std::holds_alternative<flightgear::NetFdm>(decoded)) return true;
    // Sent in the wrong byte order or with the wrong size, but meant as one.
    const bool sized = payload.size() == flightgear::kSize24 || payload.size() == flightgear::kSize25;
    return sized && std::get<Reject>(decoded) != Reject::unknown_version;
}

std::string text(const IpAddress& address) {
    std::array<char, INET6_ADDRSTRLEN> out{};
    inet_ntop(address.v6 ? AF_INET6 : AF_INET, address.bytes.data(), out.data(), out.size());
    return out.data();
}

using Pcap = std::unique_ptr<pcap_t, decltype(&pcap_close)>;

Pcap open(const std::filesystem::path& path) {
    std::array<char, PCAP_ERRBUF_SIZE> error{};
    Pcap pcap(pcap_open_offline_with_tstamp_precision(path.c_str(), PCAP_TSTAMP_PRECISION_NANO, error.data()),
              &pcap_close);
    if (!pcap) {
        std::string why = error.data();
        // libpcap names the file in some of its messages and not in others.
        if (!why.starts_with(path.string())) why = path.string() + ": " + why;
        throw std::runtime_error(why);
    }
    if (!is_known_link_type(pcap_datalink(pcap.get()))) {
        const char* name = pcap_datalink_val_to_name(pcap_datalink(pcap.get()));
        throw std::runtime_error(path.string() + ": captured on a kind of link that is not read here (" +
                                 (name != nullptr ? name : std::to_string(pcap_datalink(pcap.get()))) + ")");
    }
    return pcap;
}

// With nanosecond precision libpcap puts nanoseconds into tv_usec. A damaged pcapng file may hold any 64 bits as its
// time.
Time capture_time(const timeval& stamp) {
    constexpr std::int64_t kLatest = std::int64_t{1} << 32;
    const auto seconds = std::clamp<std::int64_t>(stamp.tv_sec, 0, kLatest);
    const auto nanoseconds = std::clamp<std::int64_t>(stamp.tv_usec, 0, 999'999'999);
    return std::chrono::seconds(seconds) + std::chrono::nanoseconds(nanoseconds);
}

void add(Read& read, Time captured, const UdpDatagram& datagram) {
    FlowCount& flow = read.flows
                          .try_emplace({datagram.source, datagram.destination, datagram.destination_port},
                                       FlowCount{{}, 0, read.flows.size()})
                          .first->second;
    for (std::size_t p = 0; p < kProtocols.size(); ++p)
        flow.matches[p] += looks_like(kProtocols[p], datagram.payload) ? 1U : 0U;
    ++flow.all;
    read.flow_of.push_back(flow.order);
    read.capture.datagrams.push_back({captured, read.capture.bytes.size(), datagram.payload.size()});
    read.capture.bytes.insert(read.capture.bytes.end(), datagram.payload.begin(), datagram.payload.end());
}

Read read_all(const std::filesystem::path& path) {
    const Pcap pcap = open(path);
    Read read;
    CaptureCounts& counts = read.capture.counts;
    pcap_pkthdr* header = nullptr;
    const unsigned char* data = nullptr;
    int status = 0;
    while ((status = pcap_next_ex(pcap.get(), &header, &data)) == 1) {
        ++counts.packets;
        const Time captured = capture_time(header->ts);
        const auto result = udp_datagram(pcap_datalink(pcap.get()), std::as_bytes(std::span(data, header->caplen)));
        if (const auto* datagram = std::get_if<UdpDatagram>(&result)) {
            add(read, captured, *datagram);
            continue;
        }
        switch (std::get<NotUdp>(result)) {
            case NotUdp::other_protocol:
                ++counts.not_udp;
                break;
            case NotUdp::fragment:
                ++counts.fragments;
                break;
            case NotUdp::damaged:
                ++counts.damaged;
                break;
        }
    }
    if (status != PCAP_ERROR_BREAK) read.capture.truncated = pcap_geterr(pcap.get());
    return read;
}

/// Keeps the datagrams of one flow.
void select(Capture& capture, const std::vector<std::size_t>& flow_of, std::size_t flow) {
    std::vector<Capture::Datagram> datagrams;
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i < capture.datagrams.size(); ++i) {
        if (flow_of[i] != flow) continue;
        Capture::Datagram datagram = capture.datagrams[i];
        const auto payload = capture.payload(datagram);
        datagram.offset = bytes.size();
        datagrams.push_back(datagram);
        bytes.insert(bytes.end(), payload.begin(), payload.end());
    }
    capture.counts.other_flow = capture.datagrams.size() - datagrams.size();
    capture.datagrams = std::move(datagrams);
    capture.bytes = std::move(bytes);
}

[[noreturn]] void fail_without_host(const std::filesystem::path& path, const Read& read,
                                    std::optional<Protocol> protocol) {
    const std::string wanted = protocol == Protocol::cigi             ? "CIGI"
                               : protocol == Protocol::flightgear_fdm ? "FlightGear FDM"
                                                                      : "CIGI or FlightGear FDM";
    std::string message = path.string() + ": no datagram of a " + wanted + " host in " +
                          std::to_string(read.capture.counts.packets) + " packets, " +
                          std::to_string(read.capture.datagrams.size()) + " of them UDP";
    if (read.capture.truncated) message += "; " + *read.capture.truncated;
    throw std::runtime_error(message);
}

}  // namespace

std::string text(const Flow& flow) {
    const bool v6 = flow.destination.find(':') != std::string::npos;
    return flow.source + " -> " + (v6 ? '[' + flow.destination + ']' : flow.destination) + ':' +
           std::to_string(flow.destination_port);
}

Capture read_capture(const std::filesystem::path& path, std::optional<Protocol> protocol) {
    Read read = read_all(path);
    const std::pair<const FlowKey, FlowCount>* best = nullptr;
    std::uint64_t most = 0;
    Protocol spoken = Protocol::cigi;
    for (std::size_t p = 0; p < kProtocols.size(); ++p) {
        if (protocol && *protocol != kProtocols[p]) continue;
        for (const auto& flow : read.flows) {
            const std::uint64_t matches = flow.second.matches[p];
            const bool earlier = best != nullptr && matches == most && flow.second.order < best->second.order;
            if (matches == 0 || (matches <= most && !earlier)) continue;
            best = &flow;
            most = matches;
            spoken = kProtocols[p];
        }
    }
    if (best == nullptr) fail_without_host(path, read, protocol);
    Capture capture = std::move(read.capture);
    capture.protocol = spoken;
    capture.flow = {text(best->first.source), text(best->first.destination), best->first.destination_port};
    select(capture, read.flow_of, best->second.order);
    return capture;
}

}  // namespace quadrig::host
