#include "ig_core/scene/solid_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ig_core/geometry/quadric_line.h"

namespace quadrig {
namespace {

constexpr Interval kNothing{1.0, 0.0};

/// A plane whose equation along a line is this small beside its terms holds the line.
constexpr double kHolds = 1e-13;

/// The part of a line that planes other than i and j, in which it lies, keep.
Interval keep_by_planes(std::span<const SolidPlane> planes, std::size_t i, std::size_t j, double size,
                        const glm::dvec3& origin, const glm::dvec3& direction) {
    constexpr double kNoEnd = std::numeric_limits<double>::infinity();
    Interval kept{-kNoEnd, kNoEnd};
    for (std::size_t k = 0; k < planes.size(); ++k) {
        if (k == i || k == j) continue;
        const double slope = glm::dot(planes[k].normal, direction);
        const double reach = glm::dot(planes[k].normal, origin), here = reach + planes[k].offset;
        // A third plane through the line takes nothing of it but by rounding.
        if (slope * slope <= kHolds * kHolds * glm::dot(direction, direction) &&
            std::abs(here) <= kHolds * (std::abs(reach) + std::abs(planes[k].offset) + size))
            continue;
        if (slope > 0.0)
            kept.from = std::max(kept.from, -here / slope);
        else if (slope < 0.0)
            kept.to = std::min(kept.to, -here / slope);
        else if (here <= 0.0)
            return kNothing;
    }
    return kept;
}

}  // namespace

std::optional<SolidEdge> edge_between(const Solid& solid, std::span<const SolidPlane> planes, std::size_t i,
                                      std::size_t j) {
    const SolidPlane &a = planes[i], &b = planes[j];
    const glm::dvec3 direction = glm::cross(a.normal, b.normal);
    const double length2 = glm::dot(direction, direction);
    if (!(length2 > 0.0)) return std::nullopt;
    const glm::dvec3 origin = glm::cross(direction, a.offset * b.normal - b.offset * a.normal) / length2;
    const double size = std::isfinite(solid.radius) ? solid.radius : 0.0;
    const Interval kept = keep_by_planes(planes, i, j, size, origin, direction);
    if (!(kept.from < kept.to)) return std::nullopt;

    const glm::dvec3 moment = glm::cross(origin, direction);
    std::array<Interval, 2> pieces;
    const int count =
        inside_quadric(value(solid.m, direction), value(solid.m, origin, direction) + glm::dot(solid.w, direction),
                       value(solid.m, origin) + 2.0 * glm::dot(solid.w, origin) + solid.c,
                       line_discriminant(solid, {direction, moment}), kFlat * length2, pieces);
    for (int n = 0; n < count; ++n) {
        const Interval& piece = pieces[static_cast<std::size_t>(n)];
        const double from = std::max(kept.from, piece.from), to = std::min(kept.to, piece.to);
        if (from < to)
            return SolidEdge{origin + from * direction, origin + to * direction, static_cast<std::uint8_t>(i),
                             static_cast<std::uint8_t>(j)};
    }
    return std::nullopt;
}

std::vector<SolidEdge> edges_of(const Solid& solid) {
    std::vector<SolidEdge> edges;
    for (std::size_t i = 0; i < solid.planes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (solid.planes[i].surface != 0 && solid.planes[j].surface != 0)
                if (const auto edge = edge_between(solid, solid.planes, i, j)) edges.push_back(*edge);
    edges.shrink_to_fit();
    return edges;
}

}  // namespace quadrig
