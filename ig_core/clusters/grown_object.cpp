#include "ig_core/clusters/grown_object.h"

#include <algorithm>
#include <cmath>

#include "ig_core/clusters/turn.h"

namespace quadrig::clusters {
namespace {

double coordinate(double metres) { return std::clamp(metres, -1e9, 1e9); }
glm::dvec3 coordinates(const glm::dvec3& p) { return {coordinate(p.x), coordinate(p.y), coordinate(p.z)}; }
double length(double metres) { return std::clamp(metres, 1e-6, 1e9); }
glm::dvec3 lengths(const glm::dvec3& l) { return {length(l.x), length(l.y), length(l.z)}; }

Degrees turned(Degrees from, Degrees by) { return {std::fmod(from.value + by.value, 360.0)}; }
Attitude turned(const Attitude& from, const Attitude& by) {
    return {turned(from.heading, by.heading), turned(from.pitch, by.pitch), turned(from.roll, by.roll)};
}

glm::dvec3 normal_of(const BoundingPlane& plane) {
    return {plane.coefficients[0], plane.coefficients[1], plane.coefficients[2]};
}
/// The plane of that normal with that value at a point.
BoundingPlane plane_through(const glm::dvec3& normal, const glm::dvec3& point, double value_there) {
    return {{normal.x, normal.y, normal.z, value_there - glm::dot(normal, point)}};
}

CentredQuadric set_down(Ellipsoid& e, std::vector<BoundingPlane>& planes, const glm::dvec3& foot,
                        const Perturbation& change) {
    const Ellipsoid from = e;
    // What lies above the foot stays in proportion: a crown that reaches the ground does so whatever its shape.
    e.centre = {coordinates(foot + from.centre.metres * change.shape * change.size)};
    e.semi_axes = lengths(from.semi_axes * change.shape * change.size);
    e.attitude = turned(from.attitude, change.turn);
    const bool is_turned =
        change.turn.heading.value != 0.0 || change.turn.pitch.value != 0.0 || change.turn.roll.value != 0.0;
    const bool is_stretched = change.shape != glm::dvec3(1.0);
    const glm::dmat3 from_scene = body_from_scene(from.attitude);
    const glm::dmat3 to_scene = glm::transpose(body_from_scene(e.attitude));
    for (BoundingPlane& plane : planes) {
        const double at_centre = glm::dot(normal_of(plane), from.centre.metres) + plane.coefficients[3];
        glm::dvec3 normal = normal_of(plane);
        if (is_turned || is_stretched) normal = to_scene * ((from_scene * normal) / change.shape);
        plane = plane_through(normal, e.centre.metres, at_centre * change.size);
    }
    return centred(e, from.semi_axes, change.size);
}

CentredQuadric set_down(Hill& hill, std::vector<BoundingPlane>& planes, const glm::dvec3& foot,
                        const Perturbation& change) {
    hill.apex = {coordinates(foot + hill.apex.metres * change.size)};
    hill.radius_of_curvature = length(hill.radius_of_curvature * change.size);
    hill.slope = std::clamp(hill.slope * change.shape.x, 1e-6, 1e6);
    for (BoundingPlane& plane : planes)
        plane = plane_through(normal_of(plane), foot, plane.coefficients[3] * change.size);
    return centred(hill, foot.z);
}

}  // namespace

Perturbation perturbation(const Variation& variation, Dice& dice) {
    // One after the other: the order in which arguments are evaluated is the compiler's.
    const auto draw = [&](double centre, double spread) { return dice.about(centre, spread); };
    Perturbation change;
    change.size = draw(1.0, variation.size);
    for (int i = 0; i < 3; ++i) change.shape[i] = draw(1.0, variation.shape);
    const double brightness = draw(1.0, variation.colour);
    for (int i = 0; i < 3; ++i) change.colour[i] = brightness * draw(1.0, 0.5 * variation.colour);
    change.altitude = draw(0.0, variation.altitude);
    change.turn.heading = {draw(0.0, variation.attitude.x)};
    change.turn.pitch = {draw(0.0, variation.attitude.y)};
    change.turn.roll = {draw(0.0, variation.attitude.z)};
    return change;
}

GrownObject grown_object(const Object& from, const glm::dvec3& foot, const Perturbation& change) {
    GrownObject grown{from, {}};
    Object& object = grown.object;
    for (int i = 0; i < 3; ++i) object.paint.colour[i] = std::clamp(from.paint.colour[i] * change.colour[i], 0.0, 1.0);
    if (auto* ellipsoid = std::get_if<Ellipsoid>(&object.shape))
        grown.quadric = set_down(*ellipsoid, object.planes, foot, change);
    else if (auto* hill = std::get_if<Hill>(&object.shape))
        grown.quadric = set_down(*hill, object.planes, foot, change);
    return grown;
}

}  // namespace quadrig::clusters
