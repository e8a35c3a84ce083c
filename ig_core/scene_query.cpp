#include "ig_core/scene_query.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "ig_core/geometry/quadric_line.h"

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHighest = 1e6;

/// Where a line is inside a solid: from `enter`, through a surface, to `leave`.
struct Stretch {
    double enter = -kInfinity;
    double leave = kInfinity;
    const SolidPlane* plane = nullptr;  ///< entered through; nullptr: through the quadric

    [[nodiscard]] bool is_empty() const { return !(enter < leave); }
};
constexpr Stretch kNothing{kInfinity, -kInfinity};

/// A line in a solid's own coordinates: q + t d about the anchor, t counted from the point nearest to the anchor, so
/// that nothing far away cancels.
struct Line {
    glm::dvec3 q, d;
};

void cut(Stretch& stretch, const SolidPlane& plane, const Line& line) {
    const double here = glm::dot(plane.normal, line.q) + plane.offset, along = glm::dot(plane.normal, line.d);
    if (along == 0.0) {
        if (!(here > 0.0)) stretch = kNothing;
        return;
    }
    const double at = -here / along;
    if (along < 0.0) {
        stretch.leave = std::min(stretch.leave, at);
    } else if (at > stretch.enter) {
        stretch.enter = at;
        stretch.plane = &plane;
    }
}

/// What of a stretch is inside the quadric (Eq 4). A cone, hill or the like leaves two parts, of which a convex solid
/// has one.
Stretch cut_by_quadric(const Stretch& stretch, const Solid& solid, const Line& line) {
    const glm::dvec3 gradient = solid.m * line.q + solid.w;
    const double a = value(solid.m, line.d), b = glm::dot(gradient, line.d);
    const double c = glm::dot(gradient + solid.w, line.q) + solid.c;
    std::array<Interval, 2> pieces;
    const int count = inside_quadric(a, b, c, b * b - a * c, 0.0, pieces);
    for (const Interval& piece : std::span(pieces).first(static_cast<std::size_t>(count))) {
        Stretch part = stretch;
        if (piece.from > part.enter) part.enter = piece.from, part.plane = nullptr;
        part.leave = std::min(part.leave, piece.to);
        if (!part.is_empty()) return part;
    }
    return kNothing;
}

glm::dvec3 normal_at(const Solid& solid, const SolidPlane* plane, const glm::dvec3& q) {
    if (plane != nullptr) return -plane->normal;
    return glm::normalize(solid.m * q + solid.w);
}

}  // namespace

SceneQuery::SceneQuery(const Scene& scene) : ground_(scene.ground.has_value()) {
    solids_.reserve(scene.objects.size());
    for (const Object& object : scene.objects) solids_.push_back(make_solid(object));
}

std::optional<SurfaceHit> SceneQuery::nearest(const ScenePoint& from, const glm::dvec3& direction, double least,
                                              double most) const {
    std::optional<SurfaceHit> best;
    for (std::size_t i = 0; i < solids_.size(); ++i) {
        const Solid& solid = solids_[i];
        const glm::dvec3 offset = from.metres - solid.anchor.metres;
        const double to_nearest = -glm::dot(offset, direction);
        const Line line{offset + to_nearest * direction, direction};
        const double limit = best ? best->distance : most;
        const bool far = glm::dot(line.q, line.q) > solid.radius * solid.radius;
        if (far || to_nearest - solid.radius > limit || to_nearest + solid.radius < least) continue;
        Stretch stretch;
        for (const SolidPlane& plane : solid.planes) cut(stretch, plane, line);
        for (const SolidPlane& side : solid.flat_sides) cut(stretch, side, line);
        if (stretch.is_empty()) continue;
        if (solid.flat_sides.empty()) stretch = cut_by_quadric(stretch, solid, line);
        const double distance = to_nearest + stretch.enter;
        const bool nearer = best ? distance < best->distance : distance <= most;
        if (stretch.is_empty() || !(distance > least) || !nearer) continue;
        const glm::dvec3 q = line.q + stretch.enter * direction;
        best = SurfaceHit{distance,
                          {solid.anchor.metres + q},
                          normal_at(solid, stretch.plane, q),
                          static_cast<std::int32_t>(i),
                          stretch.plane != nullptr ? stretch.plane->surface : 0};
    }
    if (ground_ && direction.z != 0.0) {
        const double distance = -from.metres.z / direction.z;
        if (distance > least && (best ? distance < best->distance : distance <= most)) {
            const glm::dvec3 point = from.metres + distance * direction;
            best = SurfaceHit{distance, {{point.x, point.y, 0.0}}, {0.0, 0.0, 1.0}, kGroundId, 0};
        }
    }
    return best;
}

std::optional<SurfaceHit> SceneQuery::highest(double x, double y) const {
    return nearest({{x, y, kHighest}}, {0.0, 0.0, -1.0}, 0.0, 2.0 * kHighest);
}

}  // namespace quadrig
