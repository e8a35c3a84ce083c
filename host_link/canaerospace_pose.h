/// From CANaerospace's single parameters to whole poses: pairs of halves, the commit rule, redundancy channels. Pure.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "host_link/canaerospace.h"
#include "host_link/host_state.h"
#include "host_link/inplace_vector.h"

namespace quadrig::host::canaerospace {

struct PoseSettings {
    PositionSource position = PositionSource::gps;
    std::optional<std::uint16_t> commit;  ///< the identifier that completes a pose; absent: the position's height
    std::optional<std::uint8_t> channel;  ///< the one that drives; absent: the lowest that is alive
    Time timeout = std::chrono::milliseconds(250);
};

/// The commit rule. Each channel collects pitch, roll, heading, latitude, longitude and height. When the message with
/// the commit identifier has come, the newest of each makes a pose, provided that none is older than the time-out:
/// otherwise the pose is `incomplete_pose`. A float64 counts once both halves are there, DOUBLEH first and DOUBLEL with
/// the next message code, of the same node, within the time-out; a half without its other is a `lone_half`.
///
/// Of the channels that deliver poses, the lowest drives. One that has been silent for the time-out is left for the
/// next pose of another; a lower one that comes back drives again after kSteady of whole poses.
class PoseAssembler {
  public:
    static constexpr std::size_t kMostChannels = 8;
    static constexpr Time kSteady = std::chrono::seconds(1);
    /// A message code this far behind the newest is out of order, unless it comes kLate or more after it; further
    /// behind, the sender counts anew.
    static constexpr std::uint8_t kWindow = 16;
    static constexpr Time kLate = std::chrono::seconds(1);

    explicit PoseAssembler(const PoseSettings& settings);

    enum class Place : std::uint8_t { next, duplicate, late };
    struct Outcome {
        Place place = Place::next;     ///< by the message code; only what is next was taken
        std::optional<Reject> reject;  ///< to be counted
        std::optional<GeodeticPose> pose;
        bool drives = true;  ///< the message is of the channel that drives
    };
    Outcome accept(const Message& message, Time arrival);

    [[nodiscard]] std::uint64_t lost() const { return lost_; }          ///< message codes left out
    [[nodiscard]] std::uint64_t restarts() const { return restarts_; }  ///< of the commit identifier's code

  private:
    static constexpr std::size_t kParts = static_cast<std::size_t>(Role::height) + 1;
    static constexpr std::size_t kMostParameters = 40;

    struct Part {
        double value = 0.0;
        std::optional<Time> arrival;
    };
    struct UpperHalf {
        Message message;
        Time arrival{};
    };
    struct Counter {
        std::optional<Message> newest;
        Time arrival{};
        bool counts = false;  ///< the code has been seen to go up
    };
    struct Channel {
        std::uint8_t number = 0;
        std::array<Part, kParts> parts{};
        std::array<std::optional<UpperHalf>, kParts> upper_halves{};
        std::array<Counter, kMostParameters> counters{};
        std::optional<Time> last_pose;
        Time steady_since{};
    };

    Channel* channel_of(std::uint8_t number);
    Place place_of(Counter& counter, const Message& message, Time arrival);
    std::optional<Reject> store(Channel& channel, const Message& message, Time arrival) const;
    [[nodiscard]] std::optional<GeodeticPose> pose_of(const Channel& channel, Time now) const;
    bool drives(Channel& channel, Time now);

    PoseSettings settings_;
    InplaceVector<Channel, kMostChannels> channels_;
    std::optional<std::size_t> driving_;  ///< index of the channel
    std::uint64_t lost_ = 0;
    std::uint64_t restarts_ = 0;
};

}  // namespace quadrig::host::canaerospace
