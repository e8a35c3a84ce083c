/// The newest thing known of the host, whatever protocol it speaks: every link ends here.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

#include "host_link/inplace_vector.h"
#include "host_link/weather.h"
#include "ig_core/geometry/space.h"

namespace quadrig::host {

/// Time since the epoch of some clock: a receiver's CLOCK_MONOTONIC, a capture file's, or the host's own.
using Time = std::chrono::nanoseconds;

/// Unheard for this long, a host is taken for gone, unless its link says otherwise.
inline constexpr Time kSilence = std::chrono::seconds(1);

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

/// How something goes on moving.
struct Rates {
    glm::dvec3 velocity{0.0};  ///< m/s to the right (east), forward (north) and up
    glm::dvec3 turn{0.0};      ///< rad/s about the same axes, right-handed
    bool own_axes = false;     ///< the axes turn with the body, or else are level (of an attached one, its parent's)
    [[nodiscard]] bool zero() const { return velocity == glm::dvec3(0.0) && turn == glm::dvec3(0.0); }
};

/// What smoothing still holds back of an entity's newest pose: all of it at `since`, nothing once it `lasts` no longer.
struct HeldBack {
    glm::dvec3 way{0.0};   ///< m, in the axes that the pose is in: from the new pose to what was shown
    glm::dvec3 turn{0.0};  ///< rad about an axis of the new pose's own, right-handed
    Time since{}, lasts{};
};

/// An entity as the host's packets have it, the ownship included.
struct Entity {
    std::uint16_t id = 0;
    std::optional<std::uint16_t> type;  ///< absent where 4.0 tells it in full (SISO-REF-010)
    bool active = false;                ///< to be shown, as far as its parents are
    bool placed = false;                ///< `pose` is known
    bool detects_collisions = false;    ///< its segments are looked along
    std::optional<std::uint16_t> parent;
    ScenePose pose;  ///< at `since`; of an attached entity in its parent's axes, as if those were the scene's
    glm::dmat3 level_from_scene{1.0};  ///< level axes there; of an attached entity its parent's
    Rates rates;
    Time since{};
    bool smoothing = false;
    HeldBack held_back;
};

/// The entities that a host has named, in the order in which it did. A plain value.
struct EntityList : InplaceVector<Entity, 65> {
    /// Beside the ownship. Of more, those that stand by make room first, then the newest are left out.
    static constexpr std::size_t kMost = InplaceVector::kMost - 1;
    [[nodiscard]] const Entity* find(std::uint16_t id) const {
        const Entity* found = std::find_if(begin(), end(), [&](const Entity& e) { return e.id == id; });
        return found == end() ? nullptr : found;
    }
};

/// Everything latched at a frame start. A plain value, copied through a mailbox: no allocation in it.
struct HostState {
    Mode mode = Mode::operate;
    bool smoothing = true;              ///< host asks for motion smoothing (CIGI 3.3; on for protocols that cannot say)
    std::optional<PoseSample> pose;     ///< newest pose of the ownship
    std::optional<PoseSample> earlier;  ///< the one accepted before it
    std::optional<glm::dvec3> velocity;  ///< m/s east, north, up at the ownship, where the host says so
    std::optional<ViewMount> mount;
    std::optional<ViewWindow> window;
    std::optional<double> visibility;  ///< m, meteorological optical range
    WeatherLayers weather;             ///< everywhere; absent: as the scene has it
    WeatherRegions regions;            ///< where it is another
    bool test_pattern = false;
    std::optional<bool> overlay;              ///< absent: as the appliance was asked
    std::optional<CivilTime> utc;             ///< date and time of day for the sun
    std::optional<std::uint32_t> host_frame;  ///< newest host frame number
    std::optional<Time> newest_arrival;       ///< arrival of the newest accepted datagram
    Time silence = kSilence;                  ///< after which the host is taken for gone
    EntityList entities;
    std::uint16_t ownship = 0;                 ///< its id
    std::optional<std::uint16_t> view_entity;  ///< what the eye rides on; absent: the ownship

    [[nodiscard]] bool gone(Time now) const { return newest_arrival && now - *newest_arrival >= silence; }
    /// Rates count until the host is gone: `at`, or that moment where it is earlier.
    [[nodiscard]] Time while_there(Time at) const {
        return newest_arrival ? std::min(at, *newest_arrival + silence) : at;
    }
};

}  // namespace quadrig::host
