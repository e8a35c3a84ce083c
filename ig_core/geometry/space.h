/// Points, angles and attitudes, each with the space or unit it belongs to in its type.
///
/// Scene space: X east, Y north, Z up, metres; a local tangent plane at the scene's WGS-84 origin.
/// Eye space:   X right, Y forward (the look direction), Z up, metres; the eyepoint is the origin.
/// Transforms are named target_from_source, so that a chain is right when the inner names touch.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace quadrig {

/// A position in scene space.
struct ScenePoint {
    glm::dvec3 metres{0.0};
    friend bool operator==(const ScenePoint&, const ScenePoint&) = default;
};

/// An angle in degrees: what files, wires and people use.
struct Degrees {
    double value = 0.0;
    [[nodiscard]] constexpr double radians() const { return value * (std::numbers::pi / 180.0); }
    static constexpr Degrees from_radians(double r) { return {r * (180.0 / std::numbers::pi)}; }
    friend constexpr bool operator==(Degrees, Degrees) = default;
};

/// Heading clockwise from north, pitch nose up, roll right wing down; applied in this order.
struct Attitude {
    Degrees heading;
    Degrees pitch;
    Degrees roll;
};

/// WGS-84 position: degrees and metres above the ellipsoid.
struct GeodeticPosition {
    Degrees latitude;
    Degrees longitude;
    double altitude = 0.0;
};

/// A rigid body in scene space. `eye_from_scene` is what a camera fixed to the body's own axes (right, forward, up)
/// would use.
struct ScenePose {
    ScenePoint position;
    glm::dmat3 eye_from_scene{1.0};
};

/// Where a place in a body's own axes (m from its origin) is in the scene.
ScenePoint place_on(const ScenePose& body, const glm::dvec3& place);
/// The pose in the scene of what has `own` in a body's own axes, as if those were the scene's.
ScenePose pose_on(const ScenePose& body, const ScenePose& own);

/// Rotation that takes scene directions into eye space for a look direction of the given attitude.
/// Rows of the result are the eye's right, forward and up axes in scene space. Orthonormal to 2 ulp.
glm::dmat3 eye_from_scene_rotation(const Attitude& attitude);

struct SineCosine {
    double sine = 0.0, cosine = 1.0;
};
/// The same by its angles' sines and cosines: the same bits everywhere if those are.
glm::dmat3 eye_from_scene_rotation(const SineCosine& heading, const SineCosine& pitch, const SineCosine& roll);

/// The attitude of a rotation: heading in 0..360, pitch in -90..90, roll in -180..180.
/// At a pitch of +-90 degrees, where heading and roll turn about one axis, roll is 0.
Attitude attitude_of(const glm::dmat3& eye_from_scene);

/// In single precision, as shading computes.
inline std::array<float, 3> to_float(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace quadrig
