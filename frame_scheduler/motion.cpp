#include "frame_scheduler/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "host_link/entity_motion.h"

namespace quadrig::scheduler {

ScenePose pose_between(const ScenePose& earlier, Time earlier_time, const ScenePose& newest, Time newest_time,
                       Time at) {
    const auto seconds = [&](Time t) { return std::chrono::duration<double>(t - earlier_time).count(); };
    const double part = seconds(at) / seconds(newest_time);
    const glm::dvec3& from = earlier.position.metres;
    const glm::dvec3& to = newest.position.metres;

    const glm::dquat start = glm::quat_cast(earlier.eye_from_scene);
    glm::dquat turn = glm::quat_cast(newest.eye_from_scene) * glm::conjugate(start);
    if (turn.w < 0.0) turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);  // times the sine of half the angle
    const double sine = glm::length(axis);
    const double half_angle = part * std::atan2(sine, turn.w);
    // For a turn too small to have an axis, sin(part a) / sin(a) is part.
    const double scale = sine > 1e-12 ? std::sin(half_angle) / sine : part;
    const glm::dquat partial(std::cos(half_angle), scale * axis.x, scale * axis.y, scale * axis.z);
    return {{from + part * (to - from)}, glm::mat3_cast(glm::normalize(partial * start))};
}

std::optional<ScenePose> MotionSmoother::pose_at(const host::HostState& state, Time frame_time) {
    if (!state.pose) return std::nullopt;
    clock_.observe(state);
    const ScenePose& newest = state.pose->pose;
    const std::optional<SampleClock::PairTimes> times = clock_.times(state);
    const host::Entity* own = state.entities.find(state.ownship);
    const bool goes_on = own != nullptr && !own->rates.zero();
    const auto gone_on = [&](Time at) { return moved_on(*own, state.while_there(at)); };
    const auto as_it_came = [&] { return goes_on ? gone_on(shown_time(state, frame_time)) : newest; };
    if (!state.smoothing || !state.earlier || !times) return as_it_came();

    const ScenePose& earlier = state.earlier->pose;
    const Time apart = times->newest - times->earlier;
    const double way = glm::distance(newest.position.metres, earlier.position.metres);
    if (apart > settings_.longest_gap || way > settings_.fastest * std::chrono::duration<double>(apart).count())
        return as_it_came();
    const Time shown = shown_time(state, frame_time);
    // The sample's own time is before its arrival, from which on the rates count.
    if (goes_on && shown > times->newest) return gone_on(shown + (state.pose->arrival - times->newest));
    const Time reach = apart + settings_.longest_extrapolation;
    const Time at = std::clamp(shown, times->earlier - reach, times->newest + reach);
    return pose_between(earlier, times->earlier, newest, times->newest, at);
}

}  // namespace quadrig::scheduler
