#include "appliance/host_eye.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "frame_scheduler/host_view.h"
#include "host_link/entity_motion.h"
#include "host_link/sun_position.h"

namespace quadrig::appliance {
namespace {

/// Half angles of an image plane.
host::ViewWindow window_of(const ImagePlane& plane) {
    const auto angle = [](double tangent) { return Degrees::from_radians(std::atan(tangent)); };
    return {angle(plane.left), angle(plane.x(plane.width)), angle(plane.top), angle(plane.z(plane.height))};
}

}  // namespace

HostEye::HostEye(const Scene& scene, const ImagePlane& channel, host::Protocol protocol, bool ignore_host_window,
                 std::vector<int> entity_types)
    : channel_(channel),
      ignore_host_window_(ignore_host_window),
      origin_(scene.origin),
      ambient_(scene.sun.ambient),
      entity_types_(std::move(entity_types)) {
    if (protocol == host::Protocol::cigi) weather_.emplace(scene);
}

std::optional<View> HostEye::view(const host::HostState& state, scheduler::Time frame_time) {
    shown_time_ = state.while_there(smoother_.shown_time(state, frame_time));
    ownship_.reset();
    if (const auto pose = smoother_.pose_at(state, frame_time)) ownship_.emplace(state.ownship, *pose);
    const auto body_of = [&](std::uint16_t id) { return host::pose_of(state.entities, id, shown_time_, ownship_); };
    std::optional<ScenePose> body = state.view_entity ? body_of(*state.view_entity) : std::nullopt;
    if (!body) body = body_of(state.ownship);
    if (!body) return std::nullopt;
    const ImagePlane plane = ignore_host_window_ ? channel_ : scheduler::host_image_plane(state.window, channel_);
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
        const host::SunPosition sun = host::sun_position(*state.utc, origin_);
        environment.sun = Sun{sun.azimuth, sun.elevation, ambient_};
    }
    std::ranges::copy(others, bodies_.begin());
    std::size_t count = others.size();
    for (const host::Entity& entity : state.entities) {
        if (entity.id == state.ownship || !entity.type || !is_shown(state.entities, entity)) continue;
        const auto model = std::find(entity_types_.begin(), entity_types_.end(), *entity.type);
        if (model == entity_types_.end()) continue;
        const auto pose = host::pose_of(state.entities, entity.id, shown_time_, ownship_);
        if (pose) bodies_[count++] = {static_cast<std::uint32_t>(model - entity_types_.begin()), *pose};
    }
    environment.bodies = {bodies_.data(), count};
    return environment;
}

std::optional<scheduler::Time> HostEye::fresh_arrival(const host::HostState& state) {
    if (!state.pose || state.pose->sequence == shown_) return std::nullopt;
    shown_ = state.pose->sequence;
    return state.pose->arrival;
}

host::SessionOptions session_options(const host::LinkUrl& url, const Scene& scene, const ImagePlane& channel,
                                     std::vector<int> entity_types) {
    host::SessionOptions options = session_options(url, scene.origin);
    options.default_window = window_of(channel);
    options.entity_types = std::move(entity_types);
    options.cloud_decks = scene.cloud_decks.size();
    return options;
}

View standby_view(const ImagePlane& plane) { return {{{0.0, 0.0, 2.0}}, eye_from_scene_rotation({}), plane}; }

}  // namespace quadrig::appliance
