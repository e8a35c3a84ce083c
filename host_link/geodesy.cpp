#include "host_link/geodesy.h"

namespace quadrig::host {

SceneFrame::SceneFrame(const GeodeticPosition& origin)
    : local_(origin.latitude.value, origin.longitude.value, origin.altitude), scene_from_level_(9) {}

ScenePose SceneFrame::pose(const GeodeticPosition& position, const Attitude& attitude) {
    ScenePose pose;
    glm::dvec3& at = pose.position.metres;
    local_.Forward(position.latitude.value, position.longitude.value, position.altitude, at.x, at.y, at.z,
                   scene_from_level_);
    const std::vector<double>& m = scene_from_level_;
    // GLM takes columns: row-major numbers read as columns are the transpose, which is the inverse.
    const glm::dmat3 level_from_scene(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]);
    pose.eye_from_scene = eye_from_scene_rotation(attitude) * level_from_scene;
    return pose;
}

GeodeticPosition SceneFrame::geodetic(const ScenePoint& point) const {
    GeodeticPosition position;
    const glm::dvec3& p = point.metres;
    local_.Reverse(p.x, p.y, p.z, position.latitude.value, position.longitude.value, position.altitude);
    return position;
}

}  // namespace quadrig::host
