/// Who may drive a link, who is answered, and how often. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host_link/host_state.h"
#include "host_link/network_packet.h"
#include "host_link/reject.h"

namespace quadrig::host {

/// All addresses whose first `bits` are those of `address`.
struct AddressRange {
    IpAddress address;
    unsigned bits = 0;
    [[nodiscard]] bool holds(const IpAddress& other) const;
};

struct Endpoint {
    IpAddress address;
    std::uint16_t port = 0;
    friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// Replies a second that a link sends where nothing else is said: one a frame at the highest frame rate there is.
inline constexpr double kDefaultReplyRate = 1000.0;

struct TrustSettings {
    std::vector<AddressRange> allow;        ///< whom the link hears; empty: everybody who reaches it
    bool first_host = false;                ///< the first that speaks holds the link; else the newest message counts
    std::optional<Endpoint> reply;          ///< where replies go; absent: to where the newest message taken came from
    double reply_rate = kDefaultReplyRate;  ///< a second
    Time silence = kSilence;                ///< a host unheard for so long no longer holds the link
};

/// Reads IPv4, IPv6 without brackets; absent where it is neither.
std::optional<IpAddress> ip_address(const std::string& text);

/// Judges datagrams by their senders.
class PeerGate {
  public:
    explicit PeerGate(TrustSettings settings) : settings_(std::move(settings)) {}

    struct Judgement {
        std::optional<Reject> refused;  ///< not_allowed or other_host
        bool passes_on = false;         ///< the link was another's until now
    };
    Judgement judge(const Endpoint& from, Time arrival);
    /// What judge let through was taken for a host's message.
    void taken(const Endpoint& from, Time arrival);
    [[nodiscard]] bool allows(const IpAddress& address) const;

  private:
    TrustSettings settings_;
    std::optional<Endpoint> holder_;
    Time heard_{};
};

/// A token bucket: `rate` a second on average, at most a tenth of a second's worth at once.
class ReplyRate {
  public:
    explicit ReplyRate(double rate);
    /// Whether one more may go.
    bool take(Time now);

  private:
    double rate_, most_, left_;
    std::optional<Time> last_;
};

}  // namespace quadrig::host
