/// The models that a live run's appliance file placed, once more in a replay.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "config/appliance_file.h"
#include "ig_core/view.h"

namespace quadrig::appliance {

class EntitiesAgain {
  public:
    /// Entities with a link of their own are where their recordings beside that of the driving host have them
    /// (host::recording_of_entity). `recording`: the host's, with frames beside it; without it those entities are left
    /// out, and that is said. Throws std::runtime_error with the file's name where one is missing or damaged.
    EntitiesAgain(const std::vector<config::ApplianceSettings::EntityModel>& entities, const GeodeticPosition& origin,
                  const std::optional<std::filesystem::path>& recording);
    ~EntitiesAgain();

    /// Those that are somewhere at the live run's frame of that number. In the order of the frames; good until the next
    /// call. Allocates nothing.
    std::span<const PlacedModel> at(std::uint64_t number);
    [[nodiscard]] std::vector<nlohmann::ordered_json> reports() const;

  private:
    struct Driven;
    std::vector<std::unique_ptr<Driven>> driven_;
    std::vector<PlacedModel> placed_;  ///< those that stay first
    std::size_t staying_ = 0;
};

}  // namespace quadrig::appliance
