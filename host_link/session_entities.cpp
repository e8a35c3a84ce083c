// Where a CIGI host puts its entities, the ownship among them.
#include <algorithm>
#include <array>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "host_link/cigi_axes.h"
#include "host_link/entity_motion.h"
#include "host_link/session.h"

namespace quadrig::host {

namespace {

// m/s and degrees a second: more is garbled.
constexpr double kFastest = 1e5;

Attitude attitude_of(const cigi::EntityPosition& packet) { return {{packet.yaw}, {packet.pitch}, {packet.roll}}; }

void put(Entity& entity, const ScenePose& pose, const glm::dmat3& level_from_scene, std::optional<std::uint16_t> parent,
         Time arrival) {
    const bool comparable = entity.placed && entity.parent == parent;
    entity.held_back = comparable ? held_back(entity, pose, arrival) : HeldBack{};
    entity.pose = pose;
    entity.level_from_scene = level_from_scene;
    entity.parent = parent;
    entity.placed = true;
    entity.since = arrival;
}

}  // namespace

Entity* Session::entity_for(std::uint16_t id) {
    EntityList& list = state_.entities;
    const auto known = std::ranges::find(list, id, &Entity::id);
    if (known != list.end()) return known;
    const bool ownship = id == options_.ownship;
    // The last place is the ownship's alone.
    const bool has_ownship = list.find(options_.ownship) != nullptr;
    if (!ownship && list.size() - (has_ownship ? 1 : 0) == EntityList::kMost) {
        const auto idle =
            std::ranges::find_if(list, [&](const Entity& e) { return !e.active && e.id != options_.ownship; });
        if (idle == list.end()) {
            ++statistics_.entities_dropped;
            return nullptr;
        }
        list.erase(idle);
    }
    Entity& entity = list.push_back({});
    entity.id = id;
    entity.active = ownship;
    return &entity;
}

void Session::apply(const cigi::EntityControl& packet, const cigi::Message& message, const Asking& asking) {
    const bool ownship = packet.entity == options_.ownship;
    // Smoothing is on only where both the message and the entity ask for it; before 3.3 neither could.
    const bool could = message.ig_control.minor_version >= 3 || message.format.version == cigi::Version::four;
    const bool smoothing = could && message.ig_control.smoothing && packet.smoothing && !options_.synchronous;
    if (ownship && could) state_.smoothing = smoothing;
    if (packet.state == cigi::EntityState::destroyed) {
        const auto gone = std::ranges::find(state_.entities, packet.entity, &Entity::id);
        if (!ownship && gone != state_.entities.end()) state_.entities.erase(gone);
        return;
    }
    Entity* entity = entity_for(packet.entity);
    if (entity != nullptr) {
        entity->detects_collisions = packet.collision_detection;
        entity->smoothing = smoothing;
    }
    if (entity != nullptr && !ownship) {
        entity->type = packet.extended_type ? std::nullopt : std::optional(packet.type);
        entity->active = packet.state == cigi::EntityState::active;
        // Type 0 is nothing to be seen by convention.
        const bool known = std::ranges::find(options_.entity_types, int{packet.type}) != options_.entity_types.end();
        if (entity->active && (packet.extended_type || (packet.type != 0 && !known)))
            warn(Warning::unknown_type, asking, "no model for entity %d, type %d", int{packet.entity},
                 int{packet.type});
        const auto active = std::ranges::count_if(
            state_.entities, [&](const Entity& e) { return e.active && e.id != options_.ownship; });
        statistics_.other_entities = std::max(statistics_.other_entities, static_cast<std::uint64_t>(active));
    }
    if (message.format.version == cigi::Version::three) apply(static_cast<const cigi::EntityPosition&>(packet), asking);
}

void Session::apply(const cigi::EntityPosition& packet, const Asking& asking) {
    if (packet.attached) return attach(packet, asking);
    const GeodeticPose pose{{{packet.latitude}, {packet.longitude}, packet.altitude}, attitude_of(packet)};
    if (packet.entity == options_.ownship) {
        ownship_pose_ = pose;
        return;
    }
    GeodeticPosition position = pose.position;
    position.altitude += options_.altitude_offset;
    if (!in_range(position, pose.attitude)) {
        reject(Reject::out_of_range);
        return;
    }
    Entity* entity = entity_for(packet.entity);
    if (entity == nullptr) return;
    const glm::dmat3 level_from_scene = scene_frame_.pose(position, {}).eye_from_scene;
    put(*entity, scene_frame_.pose(position, pose.attitude), level_from_scene, std::nullopt, asking.arrival);
}

void Session::place_ownship(const PoseSample& sample) {
    Entity* entity = entity_for(options_.ownship);
    const glm::dmat3 level_from_scene =
        glm::transpose(eye_from_scene_rotation(sample.attitude)) * sample.pose.eye_from_scene;
    // It is smoothed with the samples before and after it, and not here.
    entity->smoothing = false;
    put(*entity, sample.pose, level_from_scene, std::nullopt, sample.arrival);
}

void Session::attach(const cigi::EntityPosition& packet, const Asking& asking) {
    const Attitude attitude = attitude_of(packet);
    if (!cigi::below(kFarthestOffset, std::array{packet.latitude, packet.longitude, packet.altitude}) ||
        !in_range(GeodeticPosition{}, attitude)) {
        reject(Reject::out_of_range);
        return;
    }
    if (!may_attach(state_.entities, packet.entity, packet.parent)) {
        reject(Reject::bad_attachment);
        warn(Warning::bad_attachment, asking, "entity %d cannot hang on entity %d: loop, or too deep",
             int{packet.entity}, int{packet.parent});
        return;
    }
    Entity* entity = entity_for(packet.entity);
    if (entity == nullptr) return;
    const glm::dvec3 offset = cigi::turn_axes(packet.latitude, packet.longitude, packet.altitude);
    put(*entity, {{offset}, eye_from_scene_rotation(attitude)}, glm::dmat3(1.0), packet.parent, asking.arrival);
}

void Session::apply(const cigi::RateControl& packet, Time arrival) {
    if (packet.apply_to_part) return;
    if (!cigi::below(kFastest, std::array{packet.x, packet.y, packet.z, packet.roll, packet.pitch, packet.yaw})) {
        reject(Reject::out_of_range);
        return;
    }
    Entity* entity = entity_for(packet.entity);
    if (entity == nullptr) return;
    // Where the rates till now have brought it.
    entity->pose = predicted(*entity, arrival);
    entity->since = arrival;
    const auto turn = cigi::turn_axes(packet.roll, packet.pitch, packet.yaw);
    entity->rates = {cigi::turn_axes(packet.x, packet.y, packet.z), glm::radians(turn), packet.local};
}

}  // namespace quadrig::host
