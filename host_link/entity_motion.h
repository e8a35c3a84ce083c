/// Where entities are at a time: moved on by their rates, placed by their parents.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

#include "host_link/host_state.h"

namespace quadrig::host {

/// Parents above an entity that are followed: of an entity that hangs deeper nothing is known.
inline constexpr int kDeepestAttachment = 8;

/// The entity's own pose (of an attached one in its parent's axes) at `at`: from its packets' on at constant rates. In
/// its own axes it flies a helix, otherwise its point of reference a straight line while it turns about a fixed axis.
/// Closed form; before Entity::since as well. Orthonormal to 1e-12.
ScenePose predicted(const Entity& entity, Time at);

/// The same with what smoothing still holds back, which fades evenly.
ScenePose moved_on(const Entity& entity, Time at);

/// Smoothing lets a new pose in over this time, or that between the two packets where it is less.
inline constexpr Time kLetIn = std::chrono::milliseconds(100);
/// Packets further apart, in time or in speed, are a jump and not smoothed: s, m/s.
inline constexpr Time kLongestGap = std::chrono::seconds(1);
inline constexpr double kFastestMotion = 3000.0;

/// What has to be held back of a pose that comes at `now`, in place of `entity`'s (in the same axes), so that nothing
/// jumps; nothing where that is meant to.
HeldBack held_back(const Entity& entity, const ScenePose& pose, Time now);

/// An entity's pose in scene space at `at`. `ownship`: where the ownship is then; without it that is by its packets,
/// too. Absent where the entity or one of its parents is not there or not placed, or hangs too deep.
std::optional<ScenePose> pose_of(const EntityList& entities, std::uint16_t id, Time at,
                                 const std::optional<std::pair<std::uint16_t, ScenePose>>& ownship = {});

/// Whether an entity is to be shown: it and all its parents are active.
bool is_shown(const EntityList& entities, const Entity& entity);

/// Whether `id` may hang on `parent`: no loop, and not too deep.
bool may_attach(const EntityList& entities, std::uint16_t id, std::uint16_t parent);

}  // namespace quadrig::host
