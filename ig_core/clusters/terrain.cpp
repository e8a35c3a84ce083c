#include "ig_core/clusters/terrain.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace quadrig::clusters {
namespace {

/// The highest point of the solid on the vertical line through (x, y), if there is one.
std::optional<double> top(const Hill& hill, const std::vector<BoundingPlane>& planes, const glm::dvec2& point) {
    double highest = surface_height(hill, point);
    double lowest = -INFINITY;
    for (const BoundingPlane& plane : planes) {
        const auto& b = plane.coefficients;
        const double level = b[0] * point.x + b[1] * point.y + b[3];
        if (b[2] > 0.0) {
            lowest = std::max(lowest, -level / b[2]);
        } else if (b[2] < 0.0) {
            highest = std::min(highest, -level / b[2]);
        } else if (level < 0.0) {
            return std::nullopt;
        }
    }
    return highest >= lowest ? std::optional(highest) : std::nullopt;
}

}  // namespace

double surface_height(const Hill& hill, const glm::dvec2& point) {
    const double m2 = hill.slope * hill.slope, c = hill.radius_of_curvature * m2;
    const double dx = point.x - hill.apex.metres.x, dy = point.y - hill.apex.metres.y;
    const double fall = m2 * (dx * dx + dy * dy);
    // c - sqrt(c^2 + fall) without its cancellation near the apex.
    return hill.apex.metres.z - fall / (c + std::sqrt(c * c + fall));
}

void Terrain::add(const Object& object) {
    if (const Hill* hill = std::get_if<Hill>(&object.shape)) rises_.push_back({*hill, object.planes});
}

double Terrain::height(const glm::dvec2& point) const {
    double highest = 0.0;
    for (const Rise& rise : rises_) {
        // No hill is higher beside its apex than there; most of a wide landscape's are not even that high.
        if (rise.hill.apex.metres.z <= highest) continue;
        if (const auto z = top(rise.hill, rise.planes, point)) highest = std::max(highest, *z);
    }
    return highest;
}

}  // namespace quadrig::clusters
