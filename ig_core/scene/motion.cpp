#include "ig_core/scene/motion.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "ig_core/scene/placement.h"

namespace quadrig {
namespace {

/// The point by which an object is carried; what sways turns about its lowest point.
glm::dvec3 middle(const Object& object) {
    if (const auto* ellipsoid = std::get_if<Ellipsoid>(&object.shape)) return ellipsoid->centre.metres;
    if (const auto* hill = std::get_if<Hill>(&object.shape)) return hill->apex.metres;
    return glm::dvec3(0.0);
}
glm::dvec3 foot(const Object& object) {
    const auto* ellipsoid = std::get_if<Ellipsoid>(&object.shape);
    if (ellipsoid == nullptr) return middle(object);
    const glm::dmat3 own_from_scene = eye_from_scene_rotation(ellipsoid->attitude);
    return middle(object) - glm::dvec3(0.0, 0.0, glm::length(ellipsoid->semi_axes * own_from_scene[2]));
}

/// A coordinate that went out of low..high on one side comes in on the other.
double wrapped(double x, double low, double high) {
    const double width = high - low;
    return width > 0.0 ? low + (x - low) - width * std::floor((x - low) / width) : x;
}

glm::dvec3 way(const Motion& motion, const glm::dvec3& from, double seconds) {
    glm::dvec3 to = from + seconds * motion.velocity;
    if (motion.within) {
        to.x = wrapped(to.x, (*motion.within)[0], (*motion.within)[2]);
        to.y = wrapped(to.y, (*motion.within)[1], (*motion.within)[3]);
    }
    return to - from;
}

/// Leaning east by an angle that a wave from the west brings: neighbours follow one another.
double lean(const Sway& sway, const glm::dvec3& at, double seconds) {
    const double phase = 2.0 * std::numbers::pi * (seconds / sway.period - (at.x + 0.37 * at.y) / sway.wavelength);
    return sway.angle.radians() * std::sin(phase);
}

}  // namespace

ScenePose pose_at(const Object& object, double seconds) {
    ScenePose pose;
    if (!object.motion) return pose;
    pose.position = {way(*object.motion, middle(object), seconds)};
    if (!object.motion->sway) return pose;
    const glm::dvec3 pivot = foot(object);
    const double angle = lean(*object.motion->sway, pivot, seconds);
    pose.eye_from_scene = eye_from_scene_rotation({{}, {}, Degrees::from_radians(angle)});
    pose.position.metres += pivot - glm::transpose(pose.eye_from_scene) * pivot;
    return pose;
}

Scene scene_at(const Scene& scene, double seconds) {
    Scene still = scene;
    for (Object& object : still.objects) {
        if (!object.motion) continue;
        const ScenePose pose = pose_at(object, seconds);
        if (auto* hill = std::get_if<Hill>(&object.shape)) {
            // Hills only travel: what stands upright stays so.
            hill->apex.metres += pose.position.metres;
            for (BoundingPlane& plane : object.planes) {
                auto& b = plane.coefficients;
                b[3] -= glm::dot(glm::dvec3(b[0], b[1], b[2]), pose.position.metres);
            }
        } else {
            object = *placed(object, pose);
        }
        object.motion.reset();
    }
    return still;
}

void move(const Solid& at_rest, const ScenePose& pose, Solid& moved) {
    const glm::dmat3 scene_from_own = glm::transpose(pose.eye_from_scene);
    moved = at_rest;
    moved.anchor = place_on(pose, at_rest.anchor.metres);
    moved.m = congruent(at_rest.m, pose.eye_from_scene);
    moved.adjugate = congruent(at_rest.adjugate, pose.eye_from_scene);
    moved.w = scene_from_own * at_rest.w;
    moved.axis = scene_from_own * at_rest.axis;
    for (SolidPlane& plane : moved.planes) plane.normal = scene_from_own * plane.normal;
    for (SolidVertex& vertex : moved.vertices) vertex.at = scene_from_own * vertex.at;
    for (SolidPlane& plane : moved.flat_sides) plane.normal = scene_from_own * plane.normal;
}

}  // namespace quadrig
