#include "ig_core/scene/solid_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ig_core/geometry/quadric_line.h"

namespace quadrig {
namespace {

constexpr Interval kNothing{1.0, 0.0};
static_assert(kMaxPlanes * (kMaxPlanes - 1) < 256, "a vertex's index is a byte");

/// A plane whose equation along a line is this small beside its terms holds the line.
constexpr double kHolds = 1e-13;

/// A part of a line and the planes it ends in.
struct KeptPart {
    Interval part;
    std::uint8_t from_plane = SolidVertex::kNoPlane, to_plane = SolidVertex::kNoPlane;
};

/// The part of a line that planes other than i and j, in which it lies, keep.
KeptPart keep_by_planes(std::span<const SolidPlane> planes, std::size_t i, std::size_t j, double size,
                        const glm::dvec3& origin, const glm::dvec3& direction) {
    constexpr double kNoEnd = std::numeric_limits<double>::infinity();
    KeptPart kept{{-kNoEnd, kNoEnd}};
    for (std::size_t k = 0; k < planes.size(); ++k) {
        if (k == i || k == j) continue;
        const double slope = glm::dot(planes[k].normal, direction);
        const double reach = glm::dot(planes[k].normal, origin), here = reach + planes[k].offset;
        // A third plane through the line takes nothing of it but by rounding.
        if (slope * slope <= kHolds * kHolds * glm::dot(direction, direction) &&
            std::abs(here) <= kHolds * (std::abs(reach) + std::abs(planes[k].offset) + size))
            continue;
        // What has no face is no plane to end in.
        const auto plane = planes[k].surface == 0 ? SolidVertex::kNoPlane : static_cast<std::uint8_t>(k);
        const double crossed = -here / slope;
        if (slope > 0.0 && crossed > kept.part.from)
            kept.part.from = crossed, kept.from_plane = plane;
        else if (slope < 0.0 && crossed < kept.part.to)
            kept.part.to = crossed, kept.to_plane = plane;
        else if (slope == 0.0 && here <= 0.0)
            return {kNothing};
    }
    return kept;
}

SolidVertex vertex(const glm::dvec3& at, std::size_t i, std::size_t j, std::uint8_t third) {
    SolidVertex result{at, {static_cast<std::uint8_t>(j), static_cast<std::uint8_t>(i), third}};
    std::sort(result.planes.begin(), result.planes.end());
    return result;
}

std::uint8_t add_vertex(const SolidVertex& vertex, std::vector<SolidVertex>& vertices) {
    const bool shared = vertex.planes[2] != SolidVertex::kNoPlane;
    const auto same = std::find_if(vertices.begin(), vertices.end(),
                                   [&](const SolidVertex& known) { return shared && known.planes == vertex.planes; });
    const auto index = static_cast<std::uint8_t>(same - vertices.begin());
    if (same == vertices.end()) vertices.push_back(vertex);
    return index;
}

}  // namespace

std::optional<EdgeEnds> edge_between(const Solid& solid, std::span<const SolidPlane> planes, std::size_t i,
                                     std::size_t j) {
    const SolidPlane &a = planes[i], &b = planes[j];
    const glm::dvec3 direction = glm::cross(a.normal, b.normal);
    const double length2 = glm::dot(direction, direction);
    if (!(length2 > 0.0)) return std::nullopt;
    const glm::dvec3 origin = glm::cross(direction, a.offset * b.normal - b.offset * a.normal) / length2;
    const double size = std::isfinite(solid.radius) ? solid.radius : 0.0;
    const KeptPart kept = keep_by_planes(planes, i, j, size, origin, direction);
    if (!(kept.part.from < kept.part.to)) return std::nullopt;

    const glm::dvec3 moment = glm::cross(origin, direction);
    std::array<Interval, 2> pieces;
    const int count =
        inside_quadric(value(solid.m, direction), value(solid.m, origin, direction) + glm::dot(solid.w, direction),
                       value(solid.m, origin) + 2.0 * glm::dot(solid.w, origin) + solid.c,
                       line_discriminant(solid, {direction, moment}), kFlat * length2, pieces);
    for (int n = 0; n < count; ++n) {
        const Interval& piece = pieces[static_cast<std::size_t>(n)];
        const double from = std::max(kept.part.from, piece.from), to = std::min(kept.part.to, piece.to);
        if (!(from < to)) continue;
        const auto from_plane = kept.part.from >= piece.from ? kept.from_plane : SolidVertex::kNoPlane;
        const auto to_plane = kept.part.to <= piece.to ? kept.to_plane : SolidVertex::kNoPlane;
        return EdgeEnds{vertex(origin + from * direction, i, j, from_plane),
                        vertex(origin + to * direction, i, j, to_plane)};
    }
    return std::nullopt;
}

void find_edges(Solid& solid) {
    for (std::size_t i = 0; i < solid.planes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (solid.planes[i].surface != 0 && solid.planes[j].surface != 0)
                if (const auto ends = edge_between(solid, solid.planes, i, j))
                    solid.edges.push_back({add_vertex(ends->from, solid.vertices), add_vertex(ends->to, solid.vertices),
                                           static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)});
    solid.edges.shrink_to_fit(), solid.vertices.shrink_to_fit();
}

}  // namespace quadrig
