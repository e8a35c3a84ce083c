#include "host_link/entity_motion.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace quadrig::host {

namespace {

/// A body that has turned about a fixed axis for a while, and where a velocity that turned with it has brought it.
struct Turned {
    glm::dmat3 rotation;  ///< exp([w] t)
    glm::dmat3 reach;     ///< the integral of exp([w] s) over s from 0 to t, s
};

// Rodrigues' formula and its integral: with a = |w| t and n = w / |w|,
//   exp = 1 + sin a [n] + (1 - cos a) [n]^2,   integral = t + (1 - cos a) / |w| [n] + (t - sin a / |w|) [n]^2.
Turned turned(const glm::dvec3& turn, double seconds) {
    const glm::dmat3 one(1.0);
    const double rate = glm::length(turn);
    // So slow that it shows in neither.
    if (rate * std::abs(seconds) < 1e-12) return {one, seconds * one};
    const glm::dvec3 n = turn / rate;
    const glm::dmat3 cross(0.0, n.z, -n.y, -n.z, 0.0, n.x, n.y, -n.x, 0.0);
    const glm::dmat3 square = cross * cross;
    const double sine = std::sin(rate * seconds), versine = 1.0 - std::cos(rate * seconds);
    return {one + sine * cross + versine * square,
            seconds * one + versine / rate * cross + (seconds - sine / rate) * square};
}

}  // namespace

ScenePose predicted(const Entity& entity, Time at) {
    const Rates& rates = entity.rates;
    if (rates.zero()) return entity.pose;
    const double seconds = std::chrono::duration<double>(at - entity.since).count();
    const glm::dmat3 scene_from_body = glm::transpose(entity.pose.eye_from_scene);
    if (rates.own_axes) {
        const Turned way = turned(rates.turn, seconds);
        return {{entity.pose.position.metres + scene_from_body * (way.reach * rates.velocity)},
                glm::transpose(scene_from_body * way.rotation)};
    }
    const glm::dmat3 scene_from_level = glm::transpose(entity.level_from_scene);
    const Turned way = turned(scene_from_level * rates.turn, seconds);
    return {{entity.pose.position.metres + seconds * (scene_from_level * rates.velocity)},
            glm::transpose(way.rotation * scene_from_body)};
}

ScenePose moved_on(const Entity& entity, Time at) {
    ScenePose pose = predicted(entity, at);
    const HeldBack& held = entity.held_back;
    const Time gone = std::max(at - held.since, Time(0));
    if (gone >= held.lasts) return pose;
    const double part = 1.0 - std::chrono::duration<double>(gone) / std::chrono::duration<double>(held.lasts);
    pose.position.metres += part * held.way;
    pose.eye_from_scene = turned(part * held.turn, 1.0).rotation * pose.eye_from_scene;
    return pose;
}

HeldBack held_back(const Entity& entity, const ScenePose& pose, Time now) {
    const Time apart = now - entity.since;
    if (!entity.smoothing || apart <= Time(0) || apart > kLongestGap) return {};
    const ScenePose shown = moved_on(entity, now);
    const glm::dvec3 way = shown.position.metres - pose.position.metres;
    if (glm::length(way) > kFastestMotion * std::chrono::duration<double>(apart).count()) return {};
    // The rotation that leads from the new attitude to what was shown, as axis times angle.
    const glm::dmat3 turn = shown.eye_from_scene * glm::transpose(pose.eye_from_scene);
    const glm::dvec3 axis = 0.5 * glm::dvec3(turn[1][2] - turn[2][1], turn[2][0] - turn[0][2], turn[0][1] - turn[1][0]);
    const double sine = glm::length(axis), cosine = 0.5 * (turn[0][0] + turn[1][1] + turn[2][2] - 1.0);
    const double scale = sine > 1e-12 ? std::atan2(sine, cosine) / sine : 1.0;
    return {way, scale * axis, now, std::min(apart, kLetIn)};
}

std::optional<ScenePose> pose_of(const EntityList& entities, std::uint16_t id, Time at,
                                 const std::optional<std::pair<std::uint16_t, ScenePose>>& ownship) {
    std::optional<ScenePose> pose;
    for (int depth = 0; depth <= kDeepestAttachment; ++depth) {
        const Entity* entity = entities.find(id);
        const bool is_ownship = ownship && ownship->first == id;
        if (is_ownship && (entity == nullptr || !entity->parent))
            return pose ? pose_on(ownship->second, *pose) : ownship->second;
        if (entity == nullptr || !entity->placed) return std::nullopt;
        const ScenePose own = moved_on(*entity, at);
        pose = pose ? pose_on(own, *pose) : own;
        if (!entity->parent) return pose;
        id = *entity->parent;
    }
    return std::nullopt;
}

bool is_shown(const EntityList& entities, const Entity& entity) {
    const Entity* next = &entity;
    for (int depth = 0; depth <= kDeepestAttachment; ++depth) {
        if (next == nullptr || !next->active || !next->placed) return false;
        if (!next->parent) return true;
        next = entities.find(*next->parent);
    }
    return false;
}

bool may_attach(const EntityList& entities, std::uint16_t id, std::uint16_t parent) {
    for (int depth = 1; depth <= kDeepestAttachment; ++depth) {
        if (parent == id) return false;
        const Entity* next = entities.find(parent);
        if (next == nullptr || !next->parent) return true;
        parent = *next->parent;
    }
    return false;
}

}  // namespace quadrig::host
