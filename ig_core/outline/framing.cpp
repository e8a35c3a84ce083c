#include "ig_core/outline/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ig_core/outline/outline.h"

namespace quadrig {
namespace {

/// From so far away that a solid fits in this window (image plane at distance 1), rays are all but parallel.
constexpr double kNarrow = 0.01;
constexpr double kNearest = 1e3, kFarthest = 1e12;
constexpr int kRows = 1 << 30;
constexpr int kSampledRows = 64;

/// How far a solid reaches from its anchor along an eye's right and up axes, m.
struct Reach {
    glm::dvec2 low, high;
};

std::optional<Reach> reach_from(const Solid& solid, const glm::dmat3& eye_from_scene, double distance) {
    const glm::dvec3 forward = glm::transpose(eye_from_scene)[1];
    Outline outline;
    make_outline(solid, 0, {solid.anchor.metres - distance * forward}, eye_from_scene,
                 {kNarrow, 2.0 * kNarrow / kRows, kRows}, outline);
    if (outline.direct || !(outline.zeta_from < outline.zeta_to)) return std::nullopt;
    Reach reach{{kNarrow, outline.zeta_from}, {-kNarrow, outline.zeta_to}};
    std::array<Cut, kMaxCuts> cuts;
    for (int i = 1; i < kSampledRows; ++i) {
        const double part = 0.5 - 0.5 * std::cos(std::numbers::pi * i / kSampledRows);
        const int count = cuts_on_row(outline, std::lerp(outline.zeta_from, outline.zeta_to, part), cuts.data());
        if (count == 0) continue;
        reach.low.x = std::min(reach.low.x, cuts[0].from);
        reach.high.x = std::max(reach.high.x, cuts[static_cast<std::size_t>(count) - 1].to);
    }
    const double nearest_border = 0.99 * kNarrow;
    const auto inside = [&](double edge) { return std::abs(edge) < nearest_border; };
    if (!(inside(reach.low.x) && inside(reach.low.y) && inside(reach.high.x) && inside(reach.high.y)))
        return std::nullopt;
    return Reach{distance * reach.low, distance * reach.high};
}

std::optional<Reach> reach_of(const Solid& solid, const glm::dmat3& eye_from_scene) {
    for (double distance = kNearest; distance <= kFarthest; distance *= 100.0)
        if (const auto reach = reach_from(solid, eye_from_scene, distance)) return reach;
    return std::nullopt;
}

}  // namespace

std::optional<ScenePoint> eye_that_frames(const Solid& solid, const glm::dmat3& eye_from_scene, double x_reach,
                                          double z_reach) {
    const glm::dmat3 axes = glm::transpose(eye_from_scene);  // right, forward, up
    const auto front = reach_of(solid, eye_from_scene);
    // From the right side, what was forward is to the right.
    const auto side = reach_of(solid, glm::transpose(glm::dmat3{axes[1], -axes[0], axes[2]}));
    if (!front || !side) return std::nullopt;
    const glm::dvec2 middle = 0.5 * (front->low + front->high), half = 0.5 * (front->high - front->low);
    const double distance = std::max({half.x / x_reach, half.y / z_reach, 2.0 * kNearDepth});
    return ScenePoint{solid.anchor.metres + middle.x * axes[0] + (side->low.x - distance) * axes[1] +
                      middle.y * axes[2]};
}

}  // namespace quadrig
