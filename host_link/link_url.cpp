#include "host_link/link_url.h"

#include <arpa/inet.h>

#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "host_link/read_number.h"

namespace quadrig::host {

namespace {

constexpr std::string_view kLoopback = "127.0.0.1";

[[noreturn]] void fail(const LinkUrl& url, const std::string& why) {
    throw LinkUrlError("link '" + url.text + "': " + why);
}

/// Splits at the first `separator`; without one, all is before it.
std::pair<std::string_view, std::string_view> split(std::string_view text, char separator) {
    const auto at = text.find(separator);
    if (at == std::string_view::npos) return {text, {}};
    return {text.substr(0, at), text.substr(at + 1)};
}

Protocol protocol_of(const LinkUrl& url, std::string_view scheme) {
    if (scheme == "cigi") return Protocol::cigi;
    if (scheme == "fdm") return Protocol::flightgear_fdm;
    if (scheme == "can") return Protocol::canaerospace;
    if (scheme == "modbus") return Protocol::modbus;
    fail(url, "unknown scheme; known are cigi:, fdm:, can: and modbus:");
}

bool is_numeric_address(int family, const std::string& address) {
    std::array<unsigned char, sizeof(in6_addr)> binary{};
    return inet_pton(family, address.c_str(), binary.data()) == 1;
}

/// As hosts are called (RFC 1123, and the underscores that there are all the same). What ends in a number is an IPv4
/// address, if a bad one.
bool is_host_name(std::string_view text) {
    constexpr std::size_t kLongestName = 253;
    constexpr std::string_view kDigits = "0123456789";
    constexpr std::string_view kKnown = "-_.0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const std::string_view last = text.substr(text.rfind('.') + 1);
    return text.size() <= kLongestName && text.find_first_not_of(kKnown) == std::string_view::npos &&
           last.find_first_not_of(kDigits) != std::string_view::npos;
}

std::string address_of(const LinkUrl& url, std::string_view text) {
    if (text.empty() || text == "localhost") return std::string(kLoopback);
    if (text.front() == '[') {
        std::string address(text.substr(1, text.size() < 2 ? 0 : text.size() - 2));
        if (text.back() != ']' || !is_numeric_address(AF_INET6, address))
            fail(url, "bad IPv6 address " + std::string(text));
        return address;
    }
    if (text.find(':') != std::string_view::npos) fail(url, "an IPv6 address stands in brackets: [::1]:8004");
    if (!is_numeric_address(AF_INET, std::string(text)))
        fail(url, "bad address '" + std::string(text) + "': give a numeric one, for example 127.0.0.1:8004");
    return std::string(text);
}

void set_interface(LinkUrl& url, std::string_view name) {
    // As Linux has it: IFNAMSIZ with its final zero.
    constexpr std::size_t kLongestName = 15;
    if (name.empty() || name.size() > kLongestName || name.find_first_of(" /:") != std::string_view::npos)
        fail(url, "no CAN interface; give its name, for example can://can0");
    url.address = name;
}

/// Host, as it stands there, and port.
std::pair<std::string_view, std::uint16_t> endpoint_of(const LinkUrl& url, std::string_view text) {
    const auto colon = text.rfind(':');
    const auto bracket = text.rfind(']');
    if (colon == std::string_view::npos || (bracket != std::string_view::npos && colon < bracket))
        fail(url, "no port; give ADDRESS:PORT, for example 127.0.0.1:8004");
    const auto port = read_number<std::uint16_t>(text.substr(colon + 1));
    if (!port) fail(url, "bad port '" + std::string(text.substr(colon + 1)) + "'");
    return {text.substr(0, colon), *port};
}

void set_endpoint(LinkUrl& url, std::string_view endpoint) {
    url.live = true;
    if (url.protocol == Protocol::canaerospace) return set_interface(url, endpoint);
    const auto [host, port] = endpoint_of(url, endpoint);
    const bool named = is_host_name(host) && host != "localhost";
    url.address = named ? std::string(host) : address_of(url, host);
    url.port = port;
}

cigi::Version version_of(const LinkUrl& url, std::string_view value) {
    if (value == "4" || value == "4.0") return cigi::Version::four;
    for (const std::string_view known : {"3", "3.0", "3.1", "3.2", "3.3"})
        if (value == known) return cigi::Version::three;
    fail(url, "unknown CIGI version '" + std::string(value) + "'; known are 3.3 and 4.0");
}

template <class Number>
Number whole_in(const LinkUrl& url, std::string_view key, std::string_view value, unsigned least, unsigned most) {
    const auto whole = read_number<unsigned>(value);
    if (!whole || *whole < least || *whole > most)
        fail(url, std::string(key) + " is a number from " + std::to_string(least) + " to " + std::to_string(most) +
                      ", not '" + std::string(value) + "'");
    return static_cast<Number>(*whole);
}

canaerospace::PositionSource position_of(const LinkUrl& url, std::string_view value) {
    using enum canaerospace::PositionSource;
    if (value == "gps") return gps;
    if (value == "ins") return ins;
    if (value == "auxiliary") return auxiliary;
    fail(url, "position is gps, ins or auxiliary, not '" + std::string(value) + "'");
}

bool is_synchronous(const LinkUrl& url, std::string_view value) {
    if (value != "synchronous" && value != "asynchronous")
        fail(url, "operation is synchronous or asynchronous, not '" + std::string(value) + "'");
    return value == "synchronous";
}

bool set_cigi_option(LinkUrl& url, std::string_view key, std::string_view value) {
    if (key == "version")
        url.cigi_version = version_of(url, value);
    else if (key == "ownship")
        url.ownship = whole_in<std::uint16_t>(url, key, value, 0, 65535);
    else if (key == "view")
        url.view = whole_in<std::uint16_t>(url, key, value, 0, 65535);
    else if (key == "database")
        url.database = whole_in<std::int8_t>(url, key, value, 1, 127);
    else if (key == "operation")
        url.synchronous = is_synchronous(url, value);
    else
        return false;
    return true;
}

bool set_can_option(LinkUrl& url, std::string_view key, std::string_view value) {
    if (key == "position")
        url.canaerospace.position = position_of(url, value);
    else if (key == "commit")
        url.canaerospace.commit = whole_in<std::uint16_t>(url, key, value, 0, 2047);
    else if (key == "channel")
        url.canaerospace.channel = whole_in<std::uint8_t>(url, key, value, 0, 255);
    else if (key == "timeout")
        url.canaerospace.timeout = std::chrono::milliseconds(whole_in<int>(url, key, value, 1, 60000));
    else if (key == "node")
        url.can_node = whole_in<std::uint8_t>(url, key, value, 1, 255);
    else
        return false;
    return true;
}

modbus::WordOrder word_order_of(const LinkUrl& url, std::string_view value) {
    if (value == "abcd") return {false, false};
    if (value == "cdab") return {true, false};
    if (value == "badc") return {false, true};
    if (value == "dcba") return {true, true};
    fail(url, "word_order is abcd, cdab, badc or dcba, not '" + std::string(value) + "'");
}

bool set_modbus_option(LinkUrl& url, std::string_view key, std::string_view value) {
    if (key == "base")
        url.modbus.base = whole_in<std::uint16_t>(url, key, value, 0, 65536 - modbus::kHoldingRegisters);
    else if (key == "word_order")
        url.modbus.order = word_order_of(url, value);
    else
        return false;
    return true;
}

AddressRange range_of(const LinkUrl& url, std::string_view text) {
    const auto [network, length] = split(text, '/');
    if (network.empty()) fail(url, "allow is ADDRESS[/BITS], with commas between several");
    AddressRange range{ip_address(address_of(url, network)).value(), 0};
    const unsigned most = range.address.v6 ? 128 : 32;
    const bool has_length = network.size() < text.size();
    range.bits = has_length ? whole_in<unsigned>(url, "the number of bits in allow", length, 0, most) : most;
    return range;
}

Endpoint reply_of(const LinkUrl& url, std::string_view value) {
    const auto [host, port] = endpoint_of(url, value);
    const Endpoint reply{ip_address(address_of(url, host)).value(), port};
    if (port == 0) fail(url, "reply needs a port");
    if (const auto own = ip_address(url.address); own && own->v6 != reply.address.v6)
        fail(url, "reply and the link itself are both IPv4 or both IPv6");
    return reply;
}

bool set_live_option(LinkUrl& url, std::string_view key, std::string_view value) {
    using enum Protocol;
    const Protocol protocol = url.protocol;
    if (!url.live) return false;
    if (key == "allow" && protocol != canaerospace) {
        url.trust.allow.clear();
        auto [range, rest] = split(value, ',');
        url.trust.allow.push_back(range_of(url, range));
        while (!rest.empty()) {
            std::tie(range, rest) = split(rest, ',');
            url.trust.allow.push_back(range_of(url, range));
        }
    } else if (key == "host" && (protocol == cigi || protocol == flightgear_fdm)) {
        if (value != "first" && value != "newest")
            fail(url, "host is first or newest, not '" + std::string(value) + "'");
        url.trust.first_host = value == "first";
    } else if (key == "transport" && protocol == flightgear_fdm) {
        if (value != "udp" && value != "tcp") fail(url, "transport is udp or tcp, not '" + std::string(value) + "'");
        url.tcp = value == "tcp";
    } else if (key == "reply" && protocol == cigi) {
        url.trust.reply = reply_of(url, value);
    } else if (key == "reply_rate" && (protocol == cigi || protocol == canaerospace)) {
        url.trust.reply_rate = whole_in<int>(url, key, value, 1, 1000);
    } else {
        return false;
    }
    return true;
}

void set_option(LinkUrl& url, std::string_view key, std::string_view value) {
    if (set_live_option(url, key, value)) return;
    if (url.protocol == Protocol::cigi && set_cigi_option(url, key, value)) return;
    if (url.protocol == Protocol::canaerospace && set_can_option(url, key, value)) return;
    if (url.protocol == Protocol::modbus && set_modbus_option(url, key, value)) return;
    if (key == "silence") {
        url.trust.silence = std::chrono::milliseconds(whole_in<int>(url, key, value, 100, 3'600'000));
        return;
    }
    if (key != "altitude_offset") fail(url, "unknown option '" + std::string(key) + "'");
    constexpr double kMost = 1e6;
    url.altitude_offset = read_number<double>(value);
    if (!url.altitude_offset || !(std::abs(*url.altitude_offset) <= kMost))
        fail(url, "altitude_offset is a number of metres from -1e6 to 1e6, not '" + std::string(value) + "'");
}

}  // namespace

std::string_view name_of(Protocol protocol) {
    static constexpr std::array<std::string_view, kProtocolCount> kNames{"cigi", "fdm", "can", "modbus"};
    return kNames[static_cast<std::size_t>(protocol)];
}

std::string_view title_of(Protocol protocol) {
    static constexpr std::array<std::string_view, kProtocolCount> kTitles{"CIGI", "FlightGear FDM", "CANaerospace",
                                                                          "Modbus"};
    return kTitles[static_cast<std::size_t>(protocol)];
}

LinkUrl parse_link_url(std::string_view text) {
    LinkUrl url;
    url.text = text;
    url.address = kLoopback;
    if (text.find(':') == std::string_view::npos) fail(url, "not a link; give for example cigi://127.0.0.1:8004");
    const auto [scheme, rest] = split(text, ':');
    url.protocol = protocol_of(url, scheme);
    auto [endpoint, query] = split(rest, '?');
    if (endpoint.starts_with("//")) {
        set_endpoint(url, endpoint.substr(2));
    } else if (!endpoint.empty()) {
        fail(url, "expected '//' after '" + std::string(scheme) + ":'");
    }
    std::set<std::string_view> keys;
    while (!query.empty()) {
        const auto [option, more] = split(query, '&');
        const auto [key, value] = split(option, '=');
        if (!keys.insert(key).second) fail(url, "option '" + std::string(key) + "' is given twice");
        set_option(url, key, value);
        query = more;
    }
    return url;
}

}  // namespace quadrig::host
