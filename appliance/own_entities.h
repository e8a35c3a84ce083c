/// Models that the appliance places itself, for hosts that have no words for other bodies than their own: where a file
/// puts them, or where a link of their own does.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/appliance_file.h"
#include "frame_scheduler/motion.h"
#include "host_link/live_link.h"
#include "host_link/recorder.h"
#include "ig_core/view.h"

namespace quadrig::appliance {

/// Those of them that stay where a file puts them, about the scene's origin.
std::vector<PlacedModel> standing_models(const std::vector<config::ApplianceSettings::EntityModel>& entities,
                                         const GeodeticPosition& origin);

class OwnEntities {
  public:
    struct Recording {
        std::filesystem::path file;  ///< the driving host's
        host::FrameNumbering numbering;
    };
    /// Opens the entities' links, each with a recording of its own beside the host's where there is one
    /// (host::recording_of_entity). Throws std::runtime_error with the URL or file and the system's reason.
    OwnEntities(const std::vector<config::ApplianceSettings::EntityModel>& entities,
                const std::optional<Recording>& recording);

    /// Puts down what has a place of its own, about the scene's origin, and begins to listen.
    void start(const GeodeticPosition& origin);
    /// Those that are somewhere at a frame of that status, due at `due`: a link's from its first pose on, smoothed as a
    /// host's is. Once a frame; good until the next call. Allocates nothing.
    std::span<const PlacedModel> at(const host::FrameStatus& status, scheduler::Time due);
    /// Ends the links and their recordings; what their reports say.
    std::vector<nlohmann::ordered_json> stop();

  private:
    struct Driven {
        std::uint32_t model = 0;
        std::string name;
        std::unique_ptr<host::Recorder> recorder;  // goes after the link, which tells it what it hears
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
