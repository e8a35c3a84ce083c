// Heights and lines of sight: what a CIGI host asks of the scene, and the packets that answer it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "host_link/cigi_query.h"
#include "host_link/session.h"

namespace quadrig::host {

namespace {

// Where the plumb line for a height begins above the test point or the ellipsoid, and ends below the ellipsoid.
constexpr double kAboveAll = 1e5, kBelowAll = 2e4;

bool finite(const std::array<double, 3>& values) {
    return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
}

/// Axes of the wire: X forward, Y right, Z down. Ours: right, forward, up.
glm::dvec3 from_wire(const std::array<double, 3>& v) { return {v[1], v[0], -v[2]}; }
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

std::optional<ScenePoint> Session::point_of(const std::array<double, 3>& at, bool entity, std::uint16_t id) {
    if (!finite(at)) return std::nullopt;
    if (entity) {
        if (id != options_.ownship || !state_.pose) return std::nullopt;
        const ScenePose& body = state_.pose->pose;
        return ScenePoint{body.position.metres + glm::transpose(body.eye_from_scene) * from_wire(at)};
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

template <class P>
void Session::respond(const P& response, ByteOrder order) {
    if (response_count_ == responses_.size()) {
        ++statistics_.answers_dropped;
        return;
    }
    Response& place = responses_[response_count_++];
    place.size = cigi::encode(response, order, place.bytes);
}

void Session::answer(const cigi::HatHotRequest& request, ByteOrder order, std::uint8_t frame) {
    const auto point = point_of(request.point, request.entity_coordinates, request.entity);
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
            cigi::HatHotResponse{request.request, hit.has_value(), of_terrain, frame, of_terrain ? of : above}, order);
    }
    respond(cigi::HatHotExtendedResponse{request.request, hit.has_value(), frame, above, of, hit ? hit->material : 0U,
                                         normal.azimuth, normal.elevation},
            order);
}

void Session::answer_line(const LineRequest& request, const std::optional<SurveyLine>& line, ByteOrder order,
                          std::uint8_t frame) {
    if (!line) reject(Reject::out_of_range);
    const auto hit = line ? options_.surveyor(*line) : std::nullopt;
    const bool valid = line && (request.segment || hit);
    const bool visible = line && request.segment && !hit;
    const double range = hit ? hit->distance : 0.0;
    if (!request.extended)
        return respond(
            cigi::LosResponse{
                .request = request.id, .valid = valid, .visible = visible, .host_frame = frame, .range = range},
            order);
    cigi::LosExtendedResponse response{.request = request.id,
                                       .valid = valid,
                                       .range_valid = hit.has_value(),
                                       .visible = visible,
                                       .host_frame = frame,
                                       .range = range};
    if (hit) {
        const GeodeticPosition there = scene_frame_.geodetic(hit->point);
        glm::dmat3 axes = scene_frame_.pose(there, {}).eye_from_scene;
        response.point = {there.latitude.value, there.longitude.value, there.altitude - options_.altitude_offset};
        if (request.response_entity && state_.pose) {
            axes = state_.pose->pose.eye_from_scene;
            response.point = to_wire(axes * (hit->point.metres - state_.pose->pose.position.metres));
        }
        const Bearing normal = bearing(axes * hit->normal);
        response.material = hit->material;
        response.normal_azimuth = normal.azimuth;
        response.normal_elevation = normal.elevation;
    }
    respond(response, order);
}

void Session::answer(const cigi::LosSegmentRequest& request, ByteOrder order, std::uint8_t frame) {
    const auto from = point_of(request.source, request.source_entity, request.entity);
    const auto to = point_of(request.destination, request.destination_entity,
                             request.destination_id_valid ? request.destination_id : request.entity);
    std::optional<SurveyLine> line;
    if (from && to) {
        const glm::dvec3 way = to->metres - from->metres;
        const double length = glm::length(way);
        if (length > 0.0) line = SurveyLine{*from, way / length, 0.0, length};
    }
    answer_line({request.request, true, request.extended, request.response_entity}, line, order, frame);
}

void Session::answer(const cigi::LosVectorRequest& request, ByteOrder order, std::uint8_t frame) {
    const auto from = point_of(request.source, request.source_entity, request.entity);
    const bool sound = std::isfinite(request.azimuth) && std::isfinite(request.elevation) && request.least >= 0.0F &&
                       request.most > request.least && std::isfinite(request.most);
    std::optional<SurveyLine> line;
    if (from && sound) {
        const glm::dmat3 axes = request.source_entity
                                    ? state_.pose->pose.eye_from_scene
                                    : scene_frame_.pose(scene_frame_.geodetic(*from), {}).eye_from_scene;
        const double azimuth = glm::radians<double>(request.azimuth), up = glm::radians<double>(request.elevation);
        const glm::dvec3 along(std::sin(azimuth) * std::cos(up), std::cos(azimuth) * std::cos(up), std::sin(up));
        line = SurveyLine{*from, glm::transpose(axes) * along, request.least, request.most};
    }
    answer_line({request.request, false, request.extended, request.response_entity}, line, order, frame);
}

bool Session::answer_packet(const cigi::Packet& packet, ByteOrder order, std::uint8_t frame) {
    const auto as = [&]<class P>(P) {
        const P request = cigi::decode<P>(packet.bytes, order);
        answer(request, order, frame);
        return request.period;
    };
    std::uint8_t period = 0;
    switch (packet.id) {
        case cigi::HatHotRequest::kId:
            period = as(cigi::HatHotRequest{});
            break;
        case cigi::LosSegmentRequest::kId:
            period = as(cigi::LosSegmentRequest{});
            break;
        case cigi::LosVectorRequest::kId:
            period = as(cigi::LosVectorRequest{});
            break;
        default:
            return false;
    }
    // Before 3.2 the field is reserved.
    return period != 0 && reply_->separate_counters;
}

void Session::answer_request(const cigi::Packet& packet, const cigi::Message& message) {
    if (!options_.surveyor) return;
    const bool periodic = answer_packet(packet, message.order, frame_nibble(message.ig_control));
    const auto same = [&](const Standing& s) {
        return s.packet.front() == packet.bytes.front() && s.packet[2] == packet.bytes[2] &&
               s.packet[3] == packet.bytes[3];
    };
    const auto end = standing_.begin() + static_cast<std::ptrdiff_t>(standing_count_);
    auto place = std::find_if(standing_.begin(), end, same);
    if (!periodic) {
        // Asked once: whatever was repeated under that number no longer is.
        if (place != end) *place = standing_[--standing_count_];
        return;
    }
    if (place == end) {
        if (standing_count_ == standing_.size()) {
            ++statistics_.answers_dropped;
            return;
        }
        place = standing_.begin() + static_cast<std::ptrdiff_t>(standing_count_++);
    }
    std::ranges::copy(packet.bytes, place->packet.begin());
    place->size = packet.bytes.size();
    place->order = message.order;
    place->asked = message.ig_control.host_frame;
}

void Session::answer_standing(const cigi::Message& message) {
    for (std::size_t i = 0; i < standing_count_; ++i) {
        const Standing& standing = standing_[i];
        const cigi::Packet packet{std::to_integer<std::uint8_t>(standing.packet[0]),
                                  std::span(standing.packet).first(standing.size)};
        const std::size_t period_at = packet.id == cigi::HatHotRequest::kId       ? 5
                                      : packet.id == cigi::LosSegmentRequest::kId ? 60
                                                                                  : 52;
        const auto period = std::to_integer<std::uint32_t>(standing.packet[period_at]);
        const std::uint32_t since = message.ig_control.host_frame - standing.asked;
        if (since != 0 && since % period == 0) answer_packet(packet, standing.order, frame_nibble(message.ig_control));
    }
}

std::uint8_t Session::frame_nibble(const cigi::IgControl& ig_control) {
    return ig_control.last_ig_frame ? static_cast<std::uint8_t>(ig_control.host_frame & 0x0FU) : std::uint8_t{0};
}

}  // namespace quadrig::host
