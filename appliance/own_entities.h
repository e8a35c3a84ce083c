/// Models that the appliance places itself, for hosts that have no words for other bodies than their own: where a file
/// puts them, or where a link of their own does.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/appliance_file.h"
#include "frame_scheduler/motion.h"
#include "host_link/live_link.h"
#include "ig_core/view.h"

namespace quadrig::appliance {

class OwnEntities {
  public:
    /// Opens the entities' links. Throws std::runtime_error with the URL and the system's reason.
    explicit OwnEntities(const std::vector<config::ApplianceSettings::EntityModel>& entities);

    /// Puts down what has a place of its own, about the scene's origin, and begins to listen.
    void start(const GeodeticPosition& origin);
    /// Those that are somewhere at a frame of that status, due at `due`: a link's from its first pose on, smoothed as a
    /// host's is. Once a frame; good until the next call. Allocates nothing.
    std::span<const PlacedModel> at(const host::FrameStatus& status, scheduler::Time due);
    /// Ends the links; what their reports say.
    std::vector<nlohmann::ordered_json> stop();

  private:
    struct Driven {
        std::uint32_t model = 0;
        std::string name;
        std::unique_ptr<host::LiveLink> link;
        host::HostState state;
        scheduler::MotionSmoother smoother;
    };

    std::vector<config::ApplianceSettings::EntityModel> entities_;
    std::vector<std::unique_ptr<Driven>> driven_;
    std::vector<PlacedModel> placed_;  ///< those that stay first
    std::size_t staying_ = 0;
};

}  // namespace quadrig::appliance
