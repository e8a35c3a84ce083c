#include "ig_core/geometry/space.h"

#include <cmath>
#include <glm/matrix.hpp>

namespace quadrig {

ScenePoint place_on(const ScenePose& body, const glm::dvec3& place) {
    return {body.position.metres + glm::transpose(body.eye_from_scene) * place};
}

ScenePose pose_on(const ScenePose& body, const ScenePose& own) {
    return {place_on(body, own.position.metres), own.eye_from_scene * body.eye_from_scene};
}

glm::dmat3 eye_from_scene_rotation(const Attitude& attitude) {
    const auto of = [](Degrees angle) { return SineCosine{std::sin(angle.radians()), std::cos(angle.radians())}; };
    return eye_from_scene_rotation(of(attitude.heading), of(attitude.pitch), of(attitude.roll));
}

glm::dmat3 eye_from_scene_rotation(const SineCosine& heading, const SineCosine& pitch, const SineCosine& roll) {
    const auto [sh, ch] = heading;
    const auto [sp, cp] = pitch;
    const auto [sr, cr] = roll;
    const glm::dvec3 forward(sh * cp, ch * cp, sp);
    const glm::dvec3 level_right(ch, -sh, 0.0);
    const glm::dvec3 level_up(-sh * sp, -ch * sp, cp);
    const glm::dvec3 right = cr * level_right - sr * level_up;
    const glm::dvec3 up = sr * level_right + cr * level_up;
    // GLM stores columns; the axes are the rows of eye_from_scene.
    return {right.x, forward.x, up.x, right.y, forward.y, up.y, right.z, forward.z, up.z};
}

Attitude attitude_of(const glm::dmat3& eye_from_scene) {
    const auto row = [&](int r) {
        return glm::dvec3(eye_from_scene[0][r], eye_from_scene[1][r], eye_from_scene[2][r]);
    };
    const glm::dvec3 right = row(0), forward = row(1), up = row(2);
    const double pitch = std::atan2(forward.z, std::hypot(forward.x, forward.y));
    double heading = 0.0, roll = 0.0;
    if (std::hypot(forward.x, forward.y) > 1e-12) {
        heading = std::atan2(forward.x, forward.y);
        roll = std::atan2(-right.z, up.z);
    } else {
        heading = std::atan2(-right.y, right.x);
    }
    double degrees = Degrees::from_radians(heading).value;
    if (degrees < 0.0) degrees += 360.0;
    return {{degrees}, Degrees::from_radians(pitch), Degrees::from_radians(roll)};
}

}  // namespace quadrig
