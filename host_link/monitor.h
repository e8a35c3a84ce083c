/// A link as its integrator wants to see it: last values, rates, and whatever is odd, with its likely cause in words.
/// Pure: bytes and times go in, text comes out.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host_link/fields.h"
#include "host_link/link_statistics.h"
#include "host_link/recording.h"
#include "host_link/session.h"

namespace quadrig::host {

/// Why a host may send what is refused so, in one sentence. `message`: what was refused, where it is at hand.
std::string likely_cause(Protocol protocol, Reject reason, std::span<const std::byte> message = {});

/// Follows what a live link hears in a Session of its own. Not to be used by two threads at once.
class Monitor {
  public:
    /// Packets shown, and lines about oddities that wait to be taken: of more, only their number is kept.
    static constexpr std::size_t kMostRows = 256;
    static constexpr std::size_t kMostLines = 1000;

    explicit Monitor(const LinkUrl& url);

    void hear(const Heard& heard);
    /// What a link refused before its session heard it: `link` is a snapshot taken before this call.
    void hear_refusals(const LinkStatistics& link);

    /// The link now, a line for each packet with the last value of every field; rates are since the last view.
    std::string view(Time now);

    /// Lines about what was odd since the last call: "0.100 s, message 7: lost 2: frame number 12 after 9".
    std::vector<std::string> take_oddities();
    [[nodiscard]] std::uint64_t oddities() const { return oddities_; }
    [[nodiscard]] const LinkStatistics& statistics() const { return session_->statistics(); }

  private:
    struct Row {
        std::uint64_t count = 0;
        std::vector<Field> fields;
    };

    void odd(const std::string& what);
    void compare(const LinkStatistics& before, std::optional<std::uint32_t> frame_before, const Heard& heard,
                 bool field_told);
    bool tell(const ToldPacket& packet);

    LinkUrl url_;
    std::unique_ptr<Session> session_;
    std::map<std::string, Row> rows_;
    std::uint64_t rows_left_out_ = 0;
    std::vector<std::string> lines_;
    std::uint64_t lines_left_out_ = 0, oddities_ = 0;
    std::array<std::uint64_t, kRejectCount> refused_{};  ///< by the link
    std::array<std::string, kRejectCount> causes_;       ///< of the newest of each reason
    std::optional<Time> first_;
    Time newest_{};
    Time viewed_{};
    std::uint64_t datagrams_viewed_ = 0, poses_viewed_ = 0;
};

}  // namespace quadrig::host
