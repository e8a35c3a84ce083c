/// Smooth motion between host samples: where the body is at a frame's own time, whenever its samples happened to come.
#pragma once

#include <optional>

#include "frame_scheduler/frame_clock.h"
#include "frame_scheduler/sample_clock.h"
#include "host_link/host_state.h"
#include "ig_core/geometry/space.h"

namespace quadrig::scheduler {

struct MotionSettings {
    /// The picture shows the host this much behind its newest time: at 60 Hz, with up to 3 ms of jitter, the frame's
    /// time then lies between the last two samples. It adds to the motion's latency.
    Time delay = std::chrono::milliseconds(20);
    /// The picture goes on for this long after the next sample was due, as long after the newest as that was after the
    /// one before, and then holds.
    Time longest_extrapolation = std::chrono::milliseconds(100);
    /// Samples further apart than these are a jump, not a motion: the newest is shown as it is.
    Time longest_gap = std::chrono::seconds(1);
    double fastest = 3000.0;  ///< m/s
};

/// The pose at `at`, on the straight line and the turn about one axis that lead from one pose at `earlier_time` to
/// another at `newest_time` (> earlier_time); before and beyond them as well. Position linear, orientation by the
/// shorter way round (spherical linear interpolation: Shoemake, "Animating Rotation with Quaternion Curves", 1985), so
/// that headings pass through north. Orthonormal to 1e-12.
ScenePose pose_between(const ScenePose& earlier, Time earlier_time, const ScenePose& newest, Time newest_time, Time at);

/// Poses for frames. A function of the latched states and the settings alone: two channels fed alike draw alike, and a
/// replay gives what the flight gave.
class MotionSmoother {
  public:
    explicit MotionSmoother(const MotionSettings& settings = {}) : settings_(settings) {}
    /// The body's pose for a frame due at `frame_time`, on the clock of the samples' arrivals. To be called once a
    /// frame with the state latched for it. Nothing before the host's first pose. The newest pose as it came where the
    /// host asks for no smoothing, until the samples' times are known, and after a jump.
    ///
    /// An ownship that the host has given rates goes on by them after its newest sample, until another comes or the
    /// host is gone.
    std::optional<ScenePose> pose_at(const host::HostState& state, Time frame_time);
    /// The time that a frame due at `frame_time` shows.
    [[nodiscard]] Time shown_time(const host::HostState& state, Time frame_time) const {
        return state.smoothing ? frame_time - settings_.delay : frame_time;
    }

  private:
    MotionSettings settings_;
    SampleClock clock_;
};

}  // namespace quadrig::scheduler
