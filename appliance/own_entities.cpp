#include "appliance/own_entities.h"

#include <iostream>

#include "appliance/run_report.h"
#include "host_link/geodesy.h"

namespace quadrig::appliance {

OwnEntities::OwnEntities(const std::vector<config::ApplianceSettings::EntityModel>& entities) : entities_(entities) {
    for (std::size_t i = 0; i < entities_.size(); ++i) {
        const auto* url = std::get_if<host::LinkUrl>(&entities_[i].placed_by);
        if (url == nullptr) continue;
        auto& driven = driven_.emplace_back(std::make_unique<Driven>());
        driven->model = static_cast<std::uint32_t>(i);
        driven->name = entities_[i].model;
        driven->link = host::open_link(*url);
        std::cerr << "quadrig: " << url->text << " listens on " << driven->link->place() << " for " << driven->name
                  << '\n';
    }
}

void OwnEntities::start(const GeodeticPosition& origin) {
    host::SceneFrame frame(origin);
    for (std::size_t i = 0; i < entities_.size(); ++i) {
        const auto model = static_cast<std::uint32_t>(i);
        if (const auto* pose = std::get_if<ScenePose>(&entities_[i].placed_by)) placed_.push_back({model, *pose});
        if (const auto* pose = std::get_if<host::GeodeticPose>(&entities_[i].placed_by))
            placed_.push_back({model, frame.pose(pose->position, pose->attitude)});
    }
    staying_ = placed_.size();
    placed_.reserve(staying_ + driven_.size());
    for (const auto& driven : driven_) driven->link->start(session_options(driven->link->url(), origin));
}

std::span<const PlacedModel> OwnEntities::at(const host::FrameStatus& status, scheduler::Time due) {
    placed_.resize(staying_);
    for (const auto& driven : driven_) {
        driven->link->take_newest(driven->state);
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
    }
    return told;
}

}  // namespace quadrig::appliance
