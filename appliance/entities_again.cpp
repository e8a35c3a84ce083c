#include "appliance/entities_again.h"

#include <iostream>
#include <stdexcept>

#include "appliance/own_entities.h"
#include "appliance/playback.h"
#include "appliance/run_report.h"
#include "frame_scheduler/motion.h"
#include "host_link/recorded_frames.h"

namespace quadrig::appliance {
namespace {

host::RecordedFrames frames_of(const std::filesystem::path& recording) {
    auto frames = host::read_recorded_frames(recording);
    if (!frames) throw std::runtime_error(host::recorded_frames_file(recording).string() + ": not there");
    return *std::move(frames);
}

/// A link that nobody spoke over has a recording without a host in it.
std::optional<host::Capture> capture_of(const std::filesystem::path& recording, host::Protocol protocol,
                                        const host::RecordedFrames& frames) {
    if (frames.frames.empty() || frames.frames.back().heard == 0) return std::nullopt;
    return read_capture(recording, protocol, true);
}

}  // namespace

struct EntitiesAgain::Driven {
    Driven(std::uint32_t model_number, const std::string& model_name, const host::LinkUrl& link,
           const GeodeticPosition& origin, const std::filesystem::path& file)
        : model(model_number),
          name(model_name),
          url(link.text),
          recording(file),
          frames(frames_of(file)),
          capture(capture_of(file, link.protocol, frames)) {
        if (capture) run.emplace(*capture, session_options(link, origin), frames);
    }
    std::uint32_t model;
    std::string name, url;
    std::filesystem::path recording;
    host::RecordedFrames frames;
    std::optional<host::Capture> capture;
    std::optional<RunAgain> run;
    std::size_t next = 0;  ///< of the frames
    scheduler::MotionSmoother smoother;
};

EntitiesAgain::EntitiesAgain(const std::vector<config::ApplianceSettings::EntityModel>& entities,
                             const GeodeticPosition& origin, const std::optional<std::filesystem::path>& recording)
    : placed_(standing_models(entities, origin)), staying_(placed_.size()) {
    for (std::size_t i = 0; i < entities.size(); ++i) {
        const auto* url = std::get_if<host::LinkUrl>(&entities[i].placed_by);
        if (url == nullptr) continue;
        if (!recording) {
            std::cerr << "quadrig: " << entities[i].model << " of " << url->text
                      << " is left out: the recording does not say what was seen of it\n";
            continue;
        }
        driven_.push_back(std::make_unique<Driven>(static_cast<std::uint32_t>(i), entities[i].model, *url, origin,
                                                   host::recording_of_entity(*recording, i + 1, url->protocol)));
    }
    placed_.reserve(staying_ + driven_.size());
}

EntitiesAgain::~EntitiesAgain() = default;

std::span<const PlacedModel> EntitiesAgain::at(std::uint64_t number) {
    placed_.resize(staying_);
    for (const auto& driven : driven_) {
        const auto& frames = driven->frames.frames;
        while (driven->next < frames.size() && frames[driven->next].number < number) ++driven->next;
        // A killed run may have told of fewer frames here than of the host's.
        if (!driven->run || driven->next == frames.size() || frames[driven->next].number != number) continue;
        const host::HostState& state = driven->run->state_at(driven->next);
        if (const auto pose = driven->smoother.pose_at(state, frames[driven->next].due))
            placed_.push_back({driven->model, *pose});
    }
    return placed_;
}

std::vector<nlohmann::ordered_json> EntitiesAgain::reports() const {
    std::vector<nlohmann::ordered_json> told;
    for (const auto& driven : driven_) {
        told.push_back(link_report(driven->url, driven->run ? driven->run->statistics() : host::LinkStatistics{}));
        told.back()["entity"] = driven->name;
        told.back()["recording"] = driven->recording.string();
    }
    return told;
}

}  // namespace quadrig::appliance
