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
    /// Where the host says nothing else, the channel has its own window, the scene its own light and air.
    /// `entity_types` are those of the scene's models, in their order.
    HostEye(const Scene& scene, const ImagePlane& channel, host::Protocol protocol, bool ignore_host_window,
            std::vector<int> entity_types);

    /// The view for a frame due at `frame_time`, by the clock of the state's arrivals. To be called once a frame with
    /// the state latched for it. Nothing before the host's first pose. The eye rides on the entity that the host has
    /// put it on, as long as that is there, and else on the ownship.
    std::optional<View> view(const host::HostState& state, scheduler::Time frame_time);
    /// For the frame that view() was asked about last. `elapsed`: the scene's time. `others`: models that this host
    /// does not place, config::kMostEntityModels at most. What the environment refers to is good until the next call.
    [[nodiscard]] Environment environment(const host::HostState& state, scheduler::Time elapsed,
                                          std::span<const PlacedModel> others);
    /// When the newest pose came in, where no frame before has asked for it.
    std::optional<scheduler::Time> fresh_arrival(const host::HostState& state);

  private:
    ImagePlane channel_;
    bool ignore_host_window_;
    GeodeticPosition origin_;
    double ambient_;  ///< as of Sun
    std::vector<int> entity_types_;
    std::optional<HostWeather> weather_;  ///< of the protocols only CIGI has words for it
    std::array<PlacedModel, config::kMostEntityModels + host::EntityList::kMost> bodies_;
    scheduler::MotionSmoother smoother_;
    /// Of the frame that view() was asked about last.
    scheduler::Time shown_time_{};
    std::optional<std::pair<std::uint16_t, ScenePose>> ownship_;
    ScenePoint eye_;
    std::uint64_t shown_ = 0;  ///< sequence of the newest pose seen by fresh_arrival
};

/// Options of a link's URL over a scene: its decks and entity types, and the channel's window, which fills up what a
/// host's View Definition leaves out.
host::SessionOptions session_options(const host::LinkUrl& url, const Scene& scene, const ImagePlane& channel,
                                     std::vector<int> entity_types);

/// Where the eye stands until a host says otherwise: 2 m above the scene's origin, looking north.
View standby_view(const ImagePlane& plane);

}  // namespace quadrig::appliance
