#include "appliance/host_eye.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "frame_scheduler/host_view.h"
#include "host_link/entity_motion.h"
#include "host_link/sun_position.h"

namespace quadrig::appliance {

std::optional<View> HostEye::view(const host::HostState& state, scheduler::Time frame_time) {
    shown_time_ = state.while_there(smoother_.shown_time(state, frame_time));
    ownship_.reset();
    if (const auto pose = smoother_.pose_at(state, frame_time)) ownship_.emplace(state.ownship, *pose);
    const auto body_of = [&](std::uint16_t id) { return host::pose_of(state.entities, id, shown_time_, ownship_); };
    std::optional<ScenePose> body = state.view_entity ? body_of(*state.view_entity) : std::nullopt;
    if (!body) body = body_of(state.ownship);
    if (!body) return std::nullopt;
    const ImagePlane plane = surroundings_.ignore_host_window
                                 ? surroundings_.channel
                                 : scheduler::host_image_plane(state.window, surroundings_.channel);
    const View view = scheduler::host_view(*body, state.mount, plane);
    eye_ = view.eye;
    return view;
}

Environment HostEye::environment(const host::HostState& state, scheduler::Time elapsed,
                                 std::span<const PlacedModel> others) {
    Environment environment;
    environment.seconds = std::chrono::duration<double>(elapsed).count();
    environment.visibility = state.visibility;
    if (weather_) weather_->add(state, eye_, environment);
    if (state.utc) {
        const host::SunPosition sun = host::sun_position(*state.utc, surroundings_.origin);
        environment.sun = Sun{sun.azimuth, sun.elevation, surroundings_.sun.ambient};
    }
    std::ranges::copy(others, bodies_.begin());
    std::size_t count = others.size();
    const std::vector<int>& types = surroundings_.entity_types;
    for (const host::Entity& entity : state.entities) {
        if (entity.id == state.ownship || !entity.type || !is_shown(state.entities, entity)) continue;
        const auto model = std::find(types.begin(), types.end(), *entity.type);
        if (model == types.end()) continue;
        const auto pose = host::pose_of(state.entities, entity.id, shown_time_, ownship_);
        if (pose) bodies_[count++] = {static_cast<std::uint32_t>(model - types.begin()), *pose};
    }
    environment.bodies = {bodies_.data(), count};
    return environment;
}

std::optional<scheduler::Time> HostEye::fresh_arrival(const host::HostState& state) {
    if (!state.pose || state.pose->sequence == shown_) return std::nullopt;
    shown_ = state.pose->sequence;
    return state.pose->arrival;
}

HostEye::Surroundings surroundings_of(const Scene& scene, const ImagePlane& channel, bool ignore_host_window,
                                      std::vector<int> entity_types) {
    return {channel, ignore_host_window, scene.origin, scene.sun, std::move(entity_types)};
}

host::ViewWindow window_of(const ImagePlane& plane) {
    const auto angle = [](double tangent) { return Degrees::from_radians(std::atan(tangent)); };
    return {angle(plane.left), angle(plane.x(plane.width)), angle(plane.top), angle(plane.z(plane.height))};
}

View standby_view(const ImagePlane& plane) { return {{{0.0, 0.0, 2.0}}, eye_from_scene_rotation({}), plane}; }

}  // namespace quadrig::appliance
