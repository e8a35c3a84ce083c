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
    const auto first = segments_.begin(), end = first + static_cast<std::ptrdiff_t>(segment_count_);
    const auto known = std::find_if(
        first, end, [&](const auto& s) { return s.entity == packet.entity && s.segment == packet.segment; });
    if (!cigi::below(kFarthestOffset, packet.from) || !cigi::below(kFarthestOffset, packet.to) ||
        (packet.enable && packet.from == packet.to)) {
        reject(Reject::out_of_range);
        return;
    }
    if (!packet.enable) {
        if (known != end) *known = segments_[--segment_count_];
        return;
    }
    if (known == end && segment_count_ == segments_.size()) {
        ++statistics_.answers_dropped;
        return;
    }
    if (known == end) ++segment_count_;
    *known = packet;
}

void Session::tell_collisions(const Asking& asking) {
    if (!options_.surveyor) return;
    for (std::size_t i = 0; i < segment_count_; ++i) {
        const cigi::CollisionSegmentDefinition& segment = segments_[i];
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
    const auto first = sensors_.begin(), end = first + static_cast<std::ptrdiff_t>(sensor_count_);
    auto place =
        std::find_if(first, end, [&](const auto& s) { return s.view == packet.view && s.sensor == packet.sensor; });
    const bool tracks = packet.on && packet.track_mode != 0;
    if (!tracks) {
        if (place != end) *place = sensors_[--sensor_count_];
        return tell_sensor(packet, asking);
    }
    if (place == end && sensor_count_ == sensors_.size()) {
        ++statistics_.answers_dropped;
        return;
    }
    // It is told of with all others that track, once this message has been taken.
    if (place == end) ++sensor_count_;
    *place = packet;
}

void Session::tell_sensor(const cigi::SensorControl& sensor, const Asking& asking) {
    // No picture of a sensor's is drawn, so that there is nothing that it could track: it searches.
    const cigi::SensorResponse searching{
        .view = sensor.view, .sensor = sensor.sensor, .host_frame = state_.host_frame.value_or(0)};
    if (sensor.extended_response) return respond(cigi::SensorExtendedResponse{searching}, asking.format);
    respond(searching, asking.format);
}

void Session::tell_sensors(const Asking& asking) {
    for (std::size_t i = 0; i < sensor_count_; ++i) tell_sensor(sensors_[i], asking);
}

}  // namespace quadrig::host
