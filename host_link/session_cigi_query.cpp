// Heights and lines of sight: what a CIGI host asks of the scene, and the packets that answer it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "host_link/cigi_axes.h"
#include "host_link/cigi_query.h"
#include "host_link/entity_motion.h"
#include "host_link/session.h"

namespace quadrig::host {

namespace {

// Where the plumb line for a height begins above the test point or the ellipsoid, and ends below the ellipsoid.
constexpr double kAboveAll = 1e5, kBelowAll = 2e4;

glm::dvec3 from_wire(const std::array<double, 3>& v) { return cigi::turn_axes(v[0], v[1], v[2]); }
std::array<double, 3> to_wire(const glm::dvec3& v) { return {v.y, v.x, -v.z}; }

/// Of a direction (right or east, forward or north, up).
struct Bearing {
    float azimuth = 0.0F, elevation = 0.0F;  ///< deg
};
Bearing bearing(const glm::dvec3& d) {
    return {static_cast<float>(glm::degrees(std::atan2(d.x, d.y))),
            static_cast<float>(glm::degrees(std::asin(std::clamp(d.z, -1.0, 1.0))))};
}

}  // namespace

std::optional<ScenePose> Session::body_of(std::uint16_t id, Time at) const { return pose_of(state_.entities, id, at); }

std::optional<ScenePoint> Session::point_of(const std::array<double, 3>& at, bool entity, std::uint16_t id,
                                            Time arrival) {
    if (entity) {
        if (!cigi::below(kFarthestOffset, at)) return std::nullopt;
        const auto body = body_of(id, arrival);
        if (!body) return std::nullopt;
        return place_on(*body, from_wire(at));
    }
    const GeodeticPosition position{{at[0]}, {at[1]}, at[2] + options_.altitude_offset};
    if (!in_range(position, {})) return std::nullopt;
    return scene_frame_.pose(position, {}).position;
}

std::optional<SurveyHit> Session::plumb(const GeodeticPosition& below) {
    GeodeticPosition top = below;
    top.altitude = std::max(below.altitude, 0.0) + kAboveAll;
    const ScenePose level = scene_frame_.pose(top, {});
    const glm::dvec3 down = glm::transpose(level.eye_from_scene) * glm::dvec3(0.0, 0.0, -1.0);
    return options_.surveyor({level.position, down, 0.0, top.altitude + kBelowAll});
}

void Session::answer(const cigi::HatHotRequest& request, const Asking& asking) {
    const auto point = request.kind <= cigi::HeightKind::extended
                           ? point_of(request.point, request.entity_coordinates, request.entity, asking.arrival)
                           : std::nullopt;
    if (!point) reject(Reject::out_of_range);
    const GeodeticPosition test = point ? scene_frame_.geodetic(*point) : GeodeticPosition{};
    const auto hit = point ? plumb(test) : std::nullopt;
    double height = 0.0;
    Bearing normal;
    if (hit) {
        const GeodeticPosition there = scene_frame_.geodetic(hit->point);
        height = there.altitude;
        normal = bearing(scene_frame_.pose(there, {}).eye_from_scene * hit->normal);
    }
    const double above = hit ? test.altitude - height : 0.0;
    const double of = hit ? height - options_.altitude_offset : 0.0;
    if (request.kind != cigi::HeightKind::extended) {
        const bool of_terrain = request.kind == cigi::HeightKind::of_terrain;
        return respond(
            cigi::HatHotResponse{request.request, hit.has_value(), of_terrain, asking.frame, of_terrain ? of : above},
            asking.format);
    }
    respond(cigi::HatHotExtendedResponse{request.request, hit.has_value(), asking.frame, above, of,
                                         hit ? hit->material : 0U, normal.azimuth, normal.elevation},
            asking.format);
}

void Session::answer_line(const LineRequest& request, const std::optional<SurveyLine>& line, const Asking& asking) {
    if (!line) reject(Reject::out_of_range);
    const auto hit = line ? options_.surveyor(*line) : std::nullopt;
    const bool valid = line && (request.segment || hit);
    const bool visible = line && request.segment && !hit;
    const double range = hit ? hit->distance : 0.0;
    if (!request.extended)
        return respond(
            cigi::LosResponse{
                .request = request.id, .valid = valid, .visible = visible, .host_frame = asking.frame, .range = range},
            asking.format);
    cigi::LosExtendedResponse response{.request = request.id,
                                       .valid = valid,
                                       .range_valid = hit.has_value(),
                                       .visible = visible,
                                       .host_frame = asking.frame,
                                       .range = range};
    if (hit) {
        const GeodeticPosition there = scene_frame_.geodetic(hit->point);
        glm::dmat3 axes = scene_frame_.pose(there, {}).eye_from_scene;
        response.point = {there.latitude.value, there.longitude.value, there.altitude - options_.altitude_offset};
        const auto body = request.response_entity ? body_of(request.entity, asking.arrival) : std::nullopt;
        if (body) {
            axes = body->eye_from_scene;
            response.point = to_wire(axes * (hit->point.metres - body->position.metres));
        }
        const Bearing normal = bearing(axes * hit->normal);
        response.material = hit->material;
        response.normal_azimuth = normal.azimuth;
        response.normal_elevation = normal.elevation;
    }
    respond(response, asking.format);
}

void Session::answer(const cigi::LosSegmentRequest& request, const Asking& asking) {
    const auto from = point_of(request.source, request.source_entity, request.entity, asking.arrival);
    const auto to = point_of(request.destination, request.destination_entity,
                             request.destination_id_valid ? request.destination_id : request.entity, asking.arrival);
    std::optional<SurveyLine> line;
    if (from && to) {
        const glm::dvec3 way = to->metres - from->metres;
        const double length = glm::length(way);
        if (length > 0.0) line = SurveyLine{*from, way / length, 0.0, length};
    }
    answer_line({request.request, true, request.extended, request.response_entity, request.entity}, line, asking);
}

void Session::answer(const cigi::LosVectorRequest& request, const Asking& asking) {
    const auto from = point_of(request.source, request.source_entity, request.entity, asking.arrival);
    const bool sound = in_range({}, {{request.azimuth}, {request.elevation}, {}}) && request.least >= 0.0F &&
                       request.most > request.least && std::isfinite(request.most);
    std::optional<SurveyLine> line;
    if (from && sound) {
        const glm::dmat3 axes = request.source_entity
                                    ? body_of(request.entity, asking.arrival)->eye_from_scene
                                    : scene_frame_.pose(scene_frame_.geodetic(*from), {}).eye_from_scene;
        const double azimuth = glm::radians<double>(request.azimuth), up = glm::radians<double>(request.elevation);
        const glm::dvec3 along(std::sin(azimuth) * std::cos(up), std::cos(azimuth) * std::cos(up), std::sin(up));
        line = SurveyLine{*from, glm::transpose(axes) * along, request.least, request.most};
    }
    answer_line({request.request, false, request.extended, request.response_entity, request.entity}, line, asking);
}

std::optional<Session::Asked> Session::answer_packet(const cigi::Packet& packet, const Asking& asking) {
    const auto as = [&]<class P>(P) {
        const P request = cigi::decode<P>(packet.bytes, asking.format);
        answer(request, asking);
        return Asked{request.request, request.period};
    };
    switch (packet.id) {
        case cigi::HatHotRequest::kId:
            return as(cigi::HatHotRequest{});
        case cigi::LosSegmentRequest::kId:
            return as(cigi::LosSegmentRequest{});
        case cigi::LosVectorRequest::kId:
            return as(cigi::LosVectorRequest{});
        default:
            return std::nullopt;
    }
}

void Session::answer_request(const cigi::Packet& packet, const cigi::Message& message, Time arrival) {
    if (!options_.surveyor) return;
    const auto asked = answer_packet(packet, asking_of(message, arrival));
    if (!asked) return;
    const auto known = std::ranges::find_if(
        standing_, [&](const Standing& s) { return s.kind == packet.id && s.asked.request == asked->request; });
    const bool is_known = known != standing_.end();
    // Before 3.2 the field is reserved.
    if (asked->period == 0 || !reply_->separate_counters) {
        // Asked once: whatever was repeated under that number no longer is.
        if (is_known) standing_.erase(known);
        return;
    }
    if (!is_known && standing_.full()) {
        ++statistics_.answers_dropped;
        return;
    }
    Standing& standing = is_known ? *known : standing_.push_back({});
    std::ranges::copy(packet.bytes, standing.packet.begin());
    standing.size = packet.bytes.size();
    standing.kind = packet.id;
    standing.format = message.format;
    standing.asked = *asked;
    standing.since = message.ig_control.host_frame;
}

void Session::answer_standing(const cigi::Message& message, Time arrival) {
    for (const Standing& standing : standing_) {
        const std::uint32_t since = message.ig_control.host_frame - standing.since;
        if (since == 0 || since % standing.asked.period != 0) continue;
        Asking asking = asking_of(message, arrival);
        asking.format = standing.format;
        answer_packet({standing.kind, std::span(standing.packet).first(standing.size)}, asking);
    }
}

Session::Asking Session::asking_of(const cigi::Message& message, Time arrival) {
    const cigi::IgControl& ig_control = message.ig_control;
    const std::uint32_t frame = ig_control.last_ig_frame ? ig_control.host_frame & 0x0FU : 0U;
    return {message.format, static_cast<std::uint8_t>(frame), arrival};
}

}  // namespace quadrig::host
