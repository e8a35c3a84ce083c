#include "ig_core/outline/framing.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "ig_core/outline/outline.h"

namespace quadrig {
namespace {

/// From so far away that a solid is within this of the look direction (image plane at distance 1), rays are all but
/// parallel.
constexpr double kNarrow = 1e-3;
constexpr double kNearest = 1e3, kFarthest = 1e12;
constexpr int kRows = 1 << 30;

struct Interval {
    double from, to;
};

/// How far a solid reaches along `up`, m from a point, seen in the direction `forward`: an outline's first and last row
/// are exact.
std::optional<Interval> reach_along(const Solid& solid, const glm::dvec3& point, const glm::dvec3& up,
                                    const glm::dvec3& forward) {
    const glm::dmat3 eye_from_scene = glm::transpose(glm::dmat3{glm::cross(forward, up), forward, up});
    Outline outline;
    for (double distance = kNearest; distance <= kFarthest; distance *= 100.0) {
        make_outline(solid, 0, {point - distance * forward}, eye_from_scene, {kNarrow, 2.0 * kNarrow / kRows, kRows},
                     outline);
        if (outline.direct) return std::nullopt;
        const double from = outline.solid.z0 + outline.zeta_from, to = outline.solid.z0 + outline.zeta_to;
        if (from < to && from > -0.99 * kNarrow && to < 0.99 * kNarrow) return Interval{distance * from, distance * to};
    }
    return std::nullopt;
}

/// A box along axes (right, forward, up), m about a point.
struct Box {
    glm::dvec3 low, high;
};

std::optional<Box> box_about(const Solid& solid, const glm::dvec3& point, const glm::dmat3& axes) {
    const auto across = reach_along(solid, point, axes[0], axes[1]);
    const auto along = reach_along(solid, point, axes[1], axes[2]);
    const auto upwards = reach_along(solid, point, axes[2], axes[1]);
    if (!across || !along || !upwards) return std::nullopt;
    return Box{{across->from, along->from, upwards->from}, {across->to, along->to, upwards->to}};
}

}  // namespace

std::optional<ScenePoint> eye_that_frames(const Solid& solid, const glm::dmat3& eye_from_scene, double x_reach,
                                          double z_reach) {
    const glm::dmat3 axes = glm::transpose(eye_from_scene);
    // Twice: about an anchor far from the solid, perspective would count.
    const auto rough = box_about(solid, solid.anchor.metres, axes);
    if (!rough) return std::nullopt;
    const glm::dvec3 inside = solid.anchor.metres + axes * (0.5 * (rough->low + rough->high));
    const auto box = box_about(solid, inside, axes);
    if (!box) return std::nullopt;
    const glm::dvec3 half = 0.5 * (box->high - box->low), middle = 0.5 * (box->high + box->low);
    const double distance = std::max({half.x / x_reach, half.z / z_reach, 2.0 * kNearDepth});
    return ScenePoint{inside + axes * glm::dvec3(middle.x, box->low.y - distance, middle.z)};
}

}  // namespace quadrig
