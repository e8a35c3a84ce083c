#include "config/place_section.h"

namespace quadrig::config {
namespace {

constexpr NumberRule kLatitude{"degrees in -90..90", [](double x) { return x >= -90.0 && x <= 90.0; }};
constexpr NumberRule kLongitude{"degrees in -180..360", [](double x) { return x >= -180.0 && x <= 360.0; }};

}  // namespace

std::optional<GeodeticPosition> optional_geodetic(const TomlSection& section, std::string_view name) {
    const auto place = section.optional_table(name, {"latitude", "longitude", "altitude"});
    if (!place) return std::nullopt;
    return GeodeticPosition{{place->number("latitude", kLatitude)},
                            {place->number("longitude", kLongitude)},
                            place->number("altitude", kCoordinate)};
}

Attitude attitude_in(const TomlSection& section) {
    const glm::dvec3 degrees = section.triple("attitude", kTurn);
    return {{degrees.x}, {degrees.y}, {degrees.z}};
}

ScenePose scene_pose_in(const TomlSection& section) {
    ScenePose pose;
    pose.position = {section.triple("position", kCoordinate)};
    if (section.has("attitude")) pose.eye_from_scene = eye_from_scene_rotation(attitude_in(section));
    return pose;
}

}  // namespace quadrig::config
