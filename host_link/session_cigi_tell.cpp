// What a CIGI host is told without having asked a question: collisions, sensors, warnings.
#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <glm/geometric.hpp>

#include "host_link/cigi_axes.h"
#include "host_link/cigi_query.h"
#include "host_link/session.h"

namespace quadrig::host {

namespace {

/// The same warning comes no more often than this.
constexpr Time kWarningInterval = std::chrono::seconds(10);
/// Where the scene's tangent plane and the earth are 800 m apart.
constexpr double kFarthestView = 1e5;

}  // namespace

void Session::warn(Warning warning, const Asking& asking, const char* form, ...) {
    auto& last = warned_[static_cast<std::size_t>(warning)];
    if (last && asking.arrival - *last < kWarningInterval && asking.arrival >= *last) return;
    last = asking.arrival;
    std::array<char, cigi::IgMessage::kMostCharacters + 1> text{};
    va_list values;
    va_start(values, form);
    std::vsnprintf(text.data(), text.size(), form, values);
    va_end(values);
    respond(cigi::IgMessage{static_cast<std::uint16_t>(warning), text.data()}, asking.format, false);
}

void Session::look_around(const Asking& asking) {
    if (!state_.pose) return;
    const double away = glm::length(state_.pose->pose.position.metres);
    if (away > kFarthestView)
        warn(Warning::far_from_scene, asking, "view is %.0f km from the scene's origin", away / 1000.0);
}

void Session::apply(const cigi::CollisionSegmentDefinition& packet) {
    const auto known = std::ranges::find_if(
        segments_, [&](const auto& s) { return s.entity == packet.entity && s.segment == packet.segment; });
    const bool is_known = known != segments_.end();
    if (!cigi::below(kFarthestOffset, packet.from) || !cigi::below(kFarthestOffset, packet.to) ||
        (packet.enable && packet.from == packet.to)) {
        reject(Reject::out_of_range);
        return;
    }
    if (is_known && packet.enable)
        *known = packet;
    else if (is_known)
        segments_.erase(known);
    else if (packet.enable && segments_.full())
        ++statistics_.answers_dropped;
    else if (packet.enable)
        segments_.push_back(packet);
}

void Session::tell_collisions(const Asking& asking) {
    if (!options_.surveyor) return;
    for (const cigi::CollisionSegmentDefinition& segment : segments_) {
        const Entity* entity = state_.entities.find(segment.entity);
        const auto body = body_of(segment.entity, asking.arrival);
        if (entity == nullptr || !entity->detects_collisions || !body) continue;
        const auto point = [&](const std::array<float, 3>& p) {
            return place_on(*body, cigi::turn_axes(p[0], p[1], p[2])).metres;
        };
        const glm::dvec3 from = point(segment.from), way = point(segment.to) - from;
        const double length = glm::length(way);
        if (!(length > 0.0)) continue;  // it meets nothing
        const auto hit = options_.surveyor({{from}, way / length, 0.0, length});
        if (!hit) continue;
        respond(cigi::CollisionSegmentNotification{.entity = segment.entity,
                                                   .segment = segment.segment,
                                                   .material = hit->material,
                                                   .distance = static_cast<float>(hit->distance)},
                asking.format);
    }
}

void Session::apply(const cigi::SensorControl& packet, const Asking& asking) {
    const auto known = std::ranges::find_if(
        sensors_, [&](const auto& s) { return s.view == packet.view && s.sensor == packet.sensor; });
    const bool is_known = known != sensors_.end(), tracks = packet.on && packet.track_mode != 0;
    if (!tracks) {
        if (is_known) sensors_.erase(known);
        return tell_sensor(packet, asking);
    }
    // It is told of with all others that track, once this message has been taken.
    if (is_known)
        *known = packet;
    else if (sensors_.full())
        ++statistics_.answers_dropped;
    else
        sensors_.push_back(packet);
}

void Session::tell_sensor(const cigi::SensorControl& sensor, const Asking& asking) {
    // No picture of a sensor's is drawn, so that there is nothing that it could track: it searches.
    const cigi::SensorResponse searching{
        .view = sensor.view, .sensor = sensor.sensor, .host_frame = state_.host_frame.value_or(0)};
    if (sensor.extended_response) return respond(cigi::SensorExtendedResponse{searching}, asking.format);
    respond(searching, asking.format);
}

void Session::tell_sensors(const Asking& asking) {
    for (const cigi::SensorControl& sensor : sensors_) tell_sensor(sensor, asking);
}

}  // namespace quadrig::host
