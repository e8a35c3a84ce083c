#include "tests/bench/gl_peer/polytope.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <variant>

namespace quadrig::gl_peer {
namespace {

/// normal.q + offset >= 0, q from the anchor.
struct HalfSpace {
    glm::dvec3 normal;
    double offset;
};

/// Tangent planes of the hill's sheet at its apex and, eight ways, where it is half as steep as it gets (squared): with
/// z = -c sqrt(1 + r^2/a^2) from the hyperboloid's centre, at r = a the slope is m / sqrt 2 and the plane's height over
/// the centre -c / sqrt 2.
void add_tangent_planes(const Hill& hill, const ScenePoint& anchor, std::vector<HalfSpace>& planes) {
    const double c = hill.radius_of_curvature * hill.slope * hill.slope;
    const double apex = hill.apex.metres.z - anchor.metres.z;
    planes.push_back({{0, 0, -1}, apex});
    const double slope = hill.slope / std::numbers::sqrt2, length = std::hypot(1.0, slope);
    for (int i = 0; i < 8; ++i) {
        const double angle = i * std::numbers::pi / 4.0;
        const glm::dvec3 normal(-slope * std::cos(angle), -slope * std::sin(angle), -1.0);
        planes.push_back({normal / length, (apex + c - c / std::numbers::sqrt2) / length});
    }
}

}  // namespace

std::vector<glm::dvec3> polytope_about(const Solid& solid, const Shape& shape, const BoundingEllipsoid& bounds) {
    std::vector<HalfSpace> planes;
    for (const SolidPlane& plane : solid.planes) planes.push_back({plane.normal, plane.offset});
    if (const auto* hill = std::get_if<Hill>(&shape)) add_tangent_planes(*hill, solid.anchor, planes);
    const glm::dvec3 middle = bounds.centre.metres - solid.anchor.metres;
    const glm::dvec3 half(std::sqrt(bounds.spread.xx), std::sqrt(bounds.spread.yy), std::sqrt(bounds.spread.zz));
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 normal(0.0);
            normal[axis] = side;
            planes.push_back({normal, half[axis] - side * middle[axis]});
        }
    const double margin = 1e-6 * (half.x + half.y + half.z);
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j)
            for (std::size_t k = j + 1; k < planes.size(); ++k) {
                const glm::dmat3 rows(planes[i].normal, planes[j].normal, planes[k].normal);
                if (std::abs(glm::determinant(rows)) < 1e-9) continue;
                const glm::dvec3 corner = -glm::inverse(glm::transpose(rows)) *
                                          glm::dvec3(planes[i].offset, planes[j].offset, planes[k].offset);
                if (std::all_of(planes.begin(), planes.end(), [&](const HalfSpace& plane) {
                        return glm::dot(plane.normal, corner) + plane.offset >= -margin;
                    }))
                    corners.push_back(corner);
            }
    return corners;
}

std::optional<Extent> narrowed(const Extent& extent, const View& view, const ScenePoint& anchor,
                               const std::vector<glm::dvec3>& corners) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(kInfinity), high(-kInfinity);
    double nearest = kInfinity;
    const auto meet = [&](const glm::dvec3& p) {
        const glm::dvec2 at(p.x / p.y, p.z / p.y);
        low = glm::min(low, at), high = glm::max(high, at);
        nearest = std::min(nearest, p.y);
    };
    std::vector<glm::dvec3> before, behind;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 p = view.eye_from_scene * (anchor.metres - view.eye.metres + corner);
        (p.y > kNearDepth ? before : behind).push_back(p);
    }
    if (before.empty()) return corners.empty() ? std::optional(extent) : std::nullopt;
    for (const glm::dvec3& p : before) {
        meet(p);
        // Of all lines from one side to the other some are edges; the rest lie within.
        for (const glm::dvec3& q : behind) meet(glm::mix(p, q, (p.y - kNearDepth) / (p.y - q.y)));
    }
    const ImagePlane& image = view.image;
    const double right = image.x(image.width), bottom = image.z(image.height);
    constexpr double kMargin = 1e-5;
    const auto clip = [](double x, double from, double to) {
        return static_cast<float>(std::clamp(2.0 * (x - from) / (to - from) - 1.0, -1.0, 1.0));
    };
    Extent result = extent;
    result.left = std::max(extent.left, clip(low.x - kMargin, image.left, right));
    result.right = std::min(extent.right, clip(high.x + kMargin, image.left, right));
    result.bottom = std::max(extent.bottom, clip(low.y - kMargin, bottom, image.top));
    result.top = std::min(extent.top, clip(high.y + kMargin, bottom, image.top));
    result.inverse_depth = std::min(extent.inverse_depth, (1.0 + kMargin) / nearest);
    if (!(result.left < result.right && result.bottom < result.top)) return std::nullopt;
    return result;
}

}  // namespace quadrig::gl_peer
