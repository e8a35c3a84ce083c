/// What tests know of a cluster's objects: whether a point lies in one, by the equations of a scene file's numbers in
/// 64-bit mantissa, sharing no code with the generator.
#pragma once

#include <cmath>
#include <span>

#include "ig_core/scene/scene.h"

namespace quadrig::test {

using Long = long double;
struct LongPoint {
    Long x, y, z;
};

/// Below 0 inside, of the size of 1 at a semi-axis's distance; a hill's upper sheet is outside.
inline Long quadric_at(const Object& object, const LongPoint& p) {
    if (const auto* hill = std::get_if<Hill>(&object.shape)) {
        const Long m = hill->slope, c = hill->radius_of_curvature * m * m, a = hill->radius_of_curvature * m;
        const Long dx = p.x - hill->apex.metres.x, dy = p.y - hill->apex.metres.y, dz = p.z - hill->apex.metres.z - c;
        return dz > 0 ? 1 : (dx * dx + dy * dy) / (a * a) - dz * dz / (c * c) + 1;
    }
    const auto& e = std::get<Ellipsoid>(object.shape);
    const auto radians = [](Degrees d) { return static_cast<Long>(d.value) * std::acos(Long(-1)) / 180; };
    const Long h = radians(e.attitude.heading), t = radians(e.attitude.pitch), r = radians(e.attitude.roll);
    const Long x = p.x - e.centre.metres.x, y = p.y - e.centre.metres.y, z = p.z - e.centre.metres.z;
    // Heading, then pitch, then roll, one after the other.
    const Long right = x * std::cos(h) - y * std::sin(h), level = x * std::sin(h) + y * std::cos(h);
    const Long forward = level * std::cos(t) + z * std::sin(t), lifted = z * std::cos(t) - level * std::sin(t);
    const Long across = right * std::cos(r) - lifted * std::sin(r), up = right * std::sin(r) + lifted * std::cos(r);
    const auto square = [](Long v) { return v * v; };
    return square(across / e.semi_axes.x) + square(forward / e.semi_axes.y) + square(up / e.semi_axes.z) - 1;
}

inline Long plane_at(const BoundingPlane& plane, const LongPoint& p) {
    const auto& b = plane.coefficients;
    return b[0] * p.x + b[1] * p.y + b[2] * p.z + b[3];
}

inline bool within_planes(const Object& object, const LongPoint& p) {
    for (const BoundingPlane& plane : object.planes)
        if (!(plane_at(plane, p) > 0)) return false;
    return true;
}

/// Whether any of the solids holds the point.
inline bool in_any(std::span<const Object> objects, const LongPoint& p) {
    for (const Object& object : objects)
        if (within_planes(object, p) && quadric_at(object, p) <= 0) return true;
    return false;
}

}  // namespace quadrig::test
