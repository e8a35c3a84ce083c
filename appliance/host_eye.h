/// What one host's words come to: the eye, and the light and air about it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "appliance/host_weather.h"
#include "config/appliance_file.h"
#include "frame_scheduler/frame_clock.h"
#include "frame_scheduler/motion.h"
#include "host_link/host_state.h"
#include "host_link/session.h"
#include "ig_core/view.h"

namespace quadrig::appliance {

/// Follows one host, frame by frame.
class HostEye {
  public:
    /// What is drawn where the host says nothing else: the channel's own window, the scene's own light and origin.
    struct Surroundings {
        ImagePlane channel;
        bool ignore_host_window = false;
        GeodeticPosition origin;
        Sun sun;
        std::vector<int> entity_types;  ///< of the scene's models, in their order
    };
    /// Without `weather` the scene has its own, whatever the host says.
    explicit HostEye(const Surroundings& surroundings, std::optional<HostWeather> weather = std::nullopt)
        : surroundings_(surroundings), weather_(std::move(weather)) {}

    /// The view for a frame due at `frame_time`, by the clock of the state's arrivals. To be called once a frame with
    /// the state latched for it. Nothing before the host's first pose. The eye rides on the entity that the host has
    /// put it on, as long as that is there, and else on the ownship.
    std::optional<View> view(const host::HostState& state, scheduler::Time frame_time);
    /// For the frame that view() was asked about last. `elapsed`: the scene's time. `others`: models
    /// that this host does not place, config::kMostEntityModels at most.
    /// What the environment refers to is good until the next call.
    [[nodiscard]] Environment environment(const host::HostState& state, scheduler::Time elapsed,
                                          std::span<const PlacedModel> others = {});
    /// When the newest pose came in, where no frame before has asked for it.
    std::optional<scheduler::Time> fresh_arrival(const host::HostState& state);

  private:
    Surroundings surroundings_;
    std::array<PlacedModel, config::kMostEntityModels + host::EntityList::kMost> bodies_;
    std::optional<HostWeather> weather_;
    scheduler::MotionSmoother smoother_;
    /// Of the frame that view() was asked about last.
    scheduler::Time shown_time_{};
    std::optional<std::pair<std::uint16_t, ScenePose>> ownship_;
    ScenePoint eye_;
    std::uint64_t shown_ = 0;  ///< sequence of the newest pose seen by fresh_arrival
};

HostEye::Surroundings surroundings_of(const Scene& scene, const ImagePlane& channel, bool ignore_host_window,
                                      std::vector<int> entity_types);

/// Half angles of an image plane, which a host's incomplete View Definition is filled up from.
host::ViewWindow window_of(const ImagePlane& plane);

/// Where the eye stands until a host says otherwise: 2 m above the scene's origin, looking north.
View standby_view(const ImagePlane& plane);

}  // namespace quadrig::appliance
