#include "host_link/trust.h"

#include <arpa/inet.h>

#include <algorithm>
#include <chrono>

namespace quadrig::host {

bool AddressRange::holds(const IpAddress& other) const {
    if (address.v6 != other.v6) return false;
    const std::size_t whole = bits / 8;
    if (!std::equal(address.bytes.begin(), address.bytes.begin() + static_cast<std::ptrdiff_t>(whole),
                    other.bytes.begin()))
        return false;
    return bits % 8 == 0 || (address.bytes[whole] ^ other.bytes[whole]) >> (8 - bits % 8) == 0;
}

std::optional<IpAddress> ip_address(const std::string& text) {
    IpAddress address;
    if (inet_pton(AF_INET, text.c_str(), address.bytes.data()) == 1) return address;
    address.v6 = true;
    if (inet_pton(AF_INET6, text.c_str(), address.bytes.data()) == 1) return address;
    return std::nullopt;
}

bool PeerGate::allows(const IpAddress& address) const {
    return settings_.allow.empty() ||
           std::ranges::any_of(settings_.allow, [&](const AddressRange& range) { return range.holds(address); });
}

PeerGate::Judgement PeerGate::judge(const Endpoint& from, Time arrival) {
    if (!allows(from.address)) return {Reject::not_allowed, false};
    if (!settings_.first_host || !holder_ || *holder_ == from) return {};
    if (arrival - heard_ < settings_.silence) return {Reject::other_host, false};
    holder_.reset();
    return {std::nullopt, true};
}

void PeerGate::taken(const Endpoint& from, Time arrival) {
    holder_ = from;
    heard_ = arrival;
}

ReplyRate::ReplyRate(double rate) : rate_(rate), most_(std::max(1.0, rate / 10.0)), left_(most_) {}

bool ReplyRate::take(Time now) {
    const std::chrono::duration<double> passed = std::max(now - last_.value_or(now), Time(0));
    left_ = std::min(most_, left_ + rate_ * passed.count());
    last_ = now;
    if (left_ < 1.0) return false;
    left_ -= 1.0;
    return true;
}

}  // namespace quadrig::host
