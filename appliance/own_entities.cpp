#include "appliance/own_entities.h"

#include <iostream>

#include "appliance/run_report.h"
#include "host_link/geodesy.h"

namespace quadrig::appliance {

using EntityModels = std::vector<config::ApplianceSettings::EntityModel>;

std::vector<PlacedModel> standing_models(const EntityModels& entities, const GeodeticPosition& origin) {
    std::vector<PlacedModel> placed;
    host::SceneFrame frame(origin);
    for (std::size_t i = 0; i < entities.size(); ++i) {
        const auto model = static_cast<std::uint32_t>(i);
        if (const auto* pose = std::get_if<ScenePose>(&entities[i].placed_by)) placed.push_back({model, *pose});
        if (const auto* pose = std::get_if<host::GeodeticPose>(&entities[i].placed_by))
            placed.push_back({model, frame.pose(pose->position, pose->attitude)});
    }
    return placed;
}

OwnEntities::OwnEntities(const EntityModels& entities, const std::optional<Recording>& recording)
    : entities_(entities) {
    for (std::size_t i = 0; i < entities_.size(); ++i) {
        const auto* url = std::get_if<host::LinkUrl>(&entities_[i].placed_by);
        if (url == nullptr) continue;
        auto& driven = driven_.emplace_back(std::make_unique<Driven>());
        driven->model = static_cast<std::uint32_t>(i);
        driven->name = entities_[i].model;
        driven->link = host::open_link(*url);
        if (recording)
            driven->recorder = std::make_unique<host::Recorder>(
                *driven->link,
                host::Recorder::Settings{host::recording_of_entity(recording->file, i + 1, url->protocol),
                                         recording->numbering});
        std::cerr << "quadrig: " << url->text << " listens on " << driven->link->place() << " for " << driven->name
                  << '\n';
    }
}

void OwnEntities::start(const GeodeticPosition& origin) {
    placed_ = standing_models(entities_, origin);
    staying_ = placed_.size();
    placed_.reserve(staying_ + driven_.size());
    for (const auto& driven : driven_) driven->link->start(session_options(driven->link->url(), origin));
}

std::span<const PlacedModel> OwnEntities::at(const host::FrameStatus& status, scheduler::Time due) {
    placed_.resize(staying_);
    for (const auto& driven : driven_) {
        driven->link->take_newest(driven->state);
        if (driven->recorder) driven->recorder->frame({status.frame, due, driven->link->heard(), 0});
        driven->link->frame_begins(status);
        if (const auto pose = driven->smoother.pose_at(driven->state, due)) placed_.push_back({driven->model, *pose});
    }
    return placed_;
}

std::vector<nlohmann::ordered_json> OwnEntities::stop() {
    std::vector<nlohmann::ordered_json> told;
    for (const auto& driven : driven_) {
        driven->link->stop();
        told.push_back(live_link_report(*driven->link));
        told.back()["entity"] = driven->name;
        if (!driven->recorder) continue;
        driven->recorder->finish();
        told.back()["recorded"] = json_of(*driven->recorder);
    }
    return told;
}

}  // namespace quadrig::appliance
