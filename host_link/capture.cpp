#include "host_link/capture.h"

#include <arpa/inet.h>
#include <pcap/dlt.h>
#include <pcap/pcap.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <compare>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "host_link/can_frame.h"
#include "host_link/canaerospace.h"
#include "host_link/cigi.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/modbus.h"
#include "host_link/network_packet.h"
#include "host_link/tcp_streams.h"

namespace quadrig::host {

namespace {

struct FlowKey {
    std::string interface;  ///< CAN's, and nothing else is told of it
    IpAddress source, destination;
    std::uint16_t destination_port = 0;
    bool stream = false;  ///< TCP
    friend auto operator<=>(const FlowKey&, const FlowKey&) = default;
};

/// How many datagrams of a flow look like a host's, by protocol; and which flow came first, to settle ties.
struct FlowCount {
    std::array<std::uint64_t, kProtocolCount> matches{};
    std::uint64_t all = 0;
    std::size_t order = 0;
};

struct Read {
    std::map<FlowKey, FlowCount> flows;
    std::vector<std::size_t> flow_of;  ///< of each datagram: FlowCount::order
    Capture capture;                   ///< every UDP datagram of the file
};

constexpr std::array<Protocol, kProtocolCount> kProtocols{Protocol::cigi, Protocol::flightgear_fdm,
                                                          Protocol::canaerospace, Protocol::modbus};

bool is_canaerospace(std::span<const std::byte> record) {
    const auto frame = can_frame(record);
    if (!frame) return false;
    const auto message = canaerospace::decode(*frame);
    const auto* sound = std::get_if<canaerospace::Message>(&message);
    return sound != nullptr && canaerospace::parameter_at(canaerospace::parameter_index(sound->id)).id != 0;
}

bool writes_registers(std::span<const std::byte> frame) {
    const auto request = modbus::read_request(frame);
    return std::holds_alternative<modbus::Request>(request) && std::get<modbus::Request>(request).write.has_value();
}

bool is_fdm(std::span<const std::byte> payload) {
    const auto decoded = flightgear::decode(payload);
    if (std::holds_alternative<flightgear::NetFdm>(decoded)) return true;
    // Sent in the wrong byte order or with the wrong size, but meant as one.
    const bool sized = payload.size() == flightgear::kSize24 || payload.size() == flightgear::kSize25;
    return sized && std::get<Reject>(decoded) != Reject::unknown_version;
}

bool looks_like(Protocol protocol, const FlowKey& flow, std::span<const std::byte> payload) {
    const bool bus = !flow.interface.empty(), datagrams = !bus && !flow.stream;
    switch (protocol) {
        case Protocol::cigi:
            return datagrams && cigi::looks_like_host_message(payload);
        case Protocol::flightgear_fdm:
            return datagrams && is_fdm(payload);
        case Protocol::canaerospace:
            return bus && is_canaerospace(payload);
        case Protocol::modbus:
            return flow.stream && writes_registers(payload);
    }
    return false;
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
    if (const int type = pcap_datalink(pcap.get()); type != DLT_CAN_SOCKETCAN && !is_known_link_type(type)) {
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

void add(Read& read, Time captured, const FlowKey& key, std::span<const std::byte> payload, std::uint32_t source = 0) {
    FlowCount& flow = read.flows.try_emplace(key, FlowCount{{}, 0, read.flows.size()}).first->second;
    for (std::size_t p = 0; p < kProtocols.size(); ++p)
        flow.matches[p] += looks_like(kProtocols[p], key, payload) ? 1U : 0U;
    ++flow.all;
    read.flow_of.push_back(flow.order);
    read.capture.datagrams.push_back({captured, read.capture.bytes.size(), payload.size(), source});
    read.capture.bytes.insert(read.capture.bytes.end(), payload.begin(), payload.end());
}

Read read_candump(const std::filesystem::path& path) {
    std::ifstream file(path);
    Read read;
    for (std::string line; std::getline(file, line);) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
        // Comments and the reports of lost frames are no frames.
        if (line.empty() || line.front() != '(') continue;
        ++read.capture.counts.packets;
        if (const auto read_line = read_candump_line(line))
            add(read, read_line->time, {std::string(read_line->interface), {}, {}, 0}, can_record(read_line->frame));
        else if (file.eof())
            read.capture.truncated = "the last line is cut";
        else
            ++read.capture.counts.damaged;
    }
    if (file.bad()) throw std::runtime_error(path.string() + ": cannot be read");
    return read;
}

/// What pcap files call the bus: they do not name it.
constexpr const char* kSomeBus = "can";

Read read_pcap(const std::filesystem::path& path) {
    const Pcap pcap = open(path);
    Read read;
    CaptureCounts& counts = read.capture.counts;
    const bool bus = pcap_datalink(pcap.get()) == DLT_CAN_SOCKETCAN;
    TcpStreams streams;
    const auto take_frame = [&read](const TcpStreams::Stream& stream, Time captured, std::span<const std::byte> frame) {
        add(read, captured, {{}, stream.source, stream.destination, stream.destination_port, true}, frame,
            stream.number);
    };
    const auto end_stream = [&read](std::uint32_t number) {
        read.capture.closings.push_back({read.capture.datagrams.size(), number});
    };
    pcap_pkthdr* header = nullptr;
    const unsigned char* data = nullptr;
    int status = 0;
    while ((status = pcap_next_ex(pcap.get(), &header, &data)) == 1) {
        ++counts.packets;
        const Time captured = capture_time(header->ts);
        const auto packet = std::as_bytes(std::span(data, header->caplen));
        if (bus) {
            add(read, captured, {kSomeBus, {}, {}, 0}, packet);
            continue;
        }
        const auto result = transport_packet(pcap_datalink(pcap.get()), packet);
        if (const auto* datagram = std::get_if<UdpDatagram>(&result)) {
            add(read, captured, {{}, datagram->source, datagram->destination, datagram->destination_port},
                datagram->payload);
            continue;
        }
        if (const auto* segment = std::get_if<TcpSegment>(&result)) {
            if (!streams.feed(*segment, captured, take_frame, end_stream)) ++counts.not_udp;
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
    streams.finish(take_frame);
    if (status != PCAP_ERROR_BREAK) read.capture.truncated = pcap_geterr(pcap.get());
    return read;
}

/// Keeps the datagrams of one flow.
void select(Capture& capture, const std::vector<std::size_t>& flow_of, std::size_t flow) {
    std::vector<Capture::Datagram> datagrams;
    std::vector<std::byte> bytes;
    auto closing = capture.closings.begin();
    for (std::size_t i = 0; i < capture.datagrams.size(); ++i) {
        for (; closing != capture.closings.end() && closing->datagrams <= i; ++closing)
            closing->datagrams = datagrams.size();
        if (flow_of[i] != flow) continue;
        Capture::Datagram datagram = capture.datagrams[i];
        const auto payload = capture.payload(datagram);
        datagram.offset = bytes.size();
        datagrams.push_back(datagram);
        bytes.insert(bytes.end(), payload.begin(), payload.end());
    }
    // Nothing comes after these.
    capture.closings.erase(closing, capture.closings.end());
    capture.counts.other_flow = capture.datagrams.size() - datagrams.size();
    capture.datagrams = std::move(datagrams);
    capture.bytes = std::move(bytes);
}

[[noreturn]] void fail_without_host(const std::filesystem::path& path, const Read& read,
                                    std::optional<Protocol> protocol) {
    std::string wanted;
    for (const Protocol known : kProtocols)
        if (!protocol || *protocol == known) wanted += (wanted.empty() ? "" : " or ") + std::string(title_of(known));
    std::string message = path.string() + ": no datagram of a " + wanted + " host in " +
                          std::to_string(read.capture.counts.packets) + " packets, " +
                          std::to_string(read.capture.datagrams.size()) +
                          " of them UDP datagrams, Modbus requests or CAN frames";
    if (read.capture.truncated) message += "; " + *read.capture.truncated;
    throw std::runtime_error(message);
}

}  // namespace

std::string text(const Flow& flow) {
    if (flow.destination.empty()) return flow.source;
    const bool v6 = flow.destination.find(':') != std::string::npos;
    return flow.source + " -> " + (v6 ? '[' + flow.destination + ']' : flow.destination) + ':' +
           std::to_string(flow.destination_port);
}

std::span<const Capture::Closing> Capture::closed_before(std::size_t datagram) const {
    const auto found = std::ranges::equal_range(closings, datagram, {}, &Closing::datagrams);
    return {found.begin(), found.end()};
}

bool is_candump_log(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::array<char, 4096> begin{};
    file.read(begin.data(), begin.size());
    std::string_view text(begin.data(), static_cast<std::size_t>(file.gcount()));
    // A comment or two may stand before the first frame.
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        if (read_candump_line(line.substr(0, line.find('\r')))) return true;
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return false;
}

Capture read_capture(const std::filesystem::path& path, std::optional<Protocol> protocol, bool whole) {
    // What a file holds is told by its beginning, and then read from there again.
    if (std::error_code none; std::filesystem::is_other(path, none))
        throw std::runtime_error(path.string() + ": expected a regular file, found a pipe or a device");
    Read read = is_candump_log(path) ? read_candump(path) : read_pcap(path);
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
    const FlowKey& key = best->first;
    capture.flow = key.interface.empty() ? Flow{text(key.source), text(key.destination), key.destination_port}
                                         : Flow{key.interface, {}, 0};
    if (!whole) select(capture, read.flow_of, best->second.order);
    return capture;
}

}  // namespace quadrig::host
