/// The newest thing known of the host, whatever protocol it speaks: every link ends here.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>

#include "ig_core/geometry/space.h"

namespace quadrig::host {

/// Time since the epoch of some clock: a receiver's CLOCK_MONOTONIC, a capture file's, or the host's own.
using Time = std::chrono::nanoseconds;

/// A pose as protocols tell it: WGS-84, the attitude in the local level frame at that position.
struct GeodeticPose {
    GeodeticPosition position;
    Attitude attitude;
};

/// One pose as the host sent it, with both of its times.
struct PoseSample {
    GeodeticPosition position;        ///< WGS-84, the link's datum offset applied
    Attitude attitude;                ///< true heading, in the local level frame at that position
    ScenePose pose;                   ///< the same in scene space
    std::optional<Time> source_time;  ///< by the host's own clock, unwrapped; absent where the protocol carries none
    Time arrival{};                   ///< when the datagram came in (live) or was captured (replay)
    std::uint64_t sequence = 0;       ///< counts accepted poses of the link from 1
};

/// Where the eye sits on the ownship: offset in body axes (metres, right, forward, up) and a turn from the body's axes.
struct ViewMount {
    glm::dvec3 offset{0.0};
    Attitude attitude;
};

/// Half angles of the view window; left and bottom negative.
struct ViewWindow {
    Degrees left, right, top, bottom;
};

struct CivilTime {
    int year = 2000, month = 1, day = 1, hour = 0, minute = 0;
    double second = 0.0;
};

enum class Mode { standby, operate, debug };

/// An entity other than the ownship, as the host shows it: in scene space, where its newest packet has it.
struct Entity {
    std::uint16_t id = 0;
    std::uint16_t type = 0;
    ScenePose pose;
};
/// Most that are shown at a time; the first to appear count.
inline constexpr std::size_t kMostShownEntities = 64;

/// Everything latched at a frame start. A plain value, copied through a mailbox: no allocation in it.
struct HostState {
    Mode mode = Mode::operate;
    bool smoothing = true;              ///< host asks for motion smoothing (CIGI 3.3; on for protocols that cannot say)
    std::optional<PoseSample> pose;     ///< newest pose of the ownship
    std::optional<PoseSample> earlier;  ///< the one accepted before it
    std::optional<glm::dvec3> velocity;  ///< m/s east, north, up at the ownship, where the host says so
    std::optional<ViewMount> mount;
    std::optional<ViewWindow> window;
    std::optional<double> visibility;         ///< m, meteorological optical range
    std::optional<CivilTime> utc;             ///< date and time of day for the sun
    std::optional<std::uint32_t> host_frame;  ///< newest host frame number
    std::optional<Time> newest_arrival;       ///< arrival of the newest accepted datagram
    std::array<Entity, kMostShownEntities> entities{};
    std::size_t entity_count = 0;
};

}  // namespace quadrig::host
