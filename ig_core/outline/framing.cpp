#include "ig_core/outline/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ig_core/outline/outline.h"

namespace quadrig {
namespace {

/// From so far away that a solid fits in this window (image plane at distance 1), rays are all but parallel.
constexpr double kNarrow = 1e-3;
constexpr double kNearest = 1e3, kFarthest = 1e12;
constexpr int kRows = 1 << 30;
constexpr int kRowsOfBand = 32;

/// How far a solid reaches from a point along an eye's right and up axes, m.
struct Reach {
    glm::dvec2 low, high;
};

/// Reach from `point`, seen from so far before it.
std::optional<Reach> reach_from(const Solid& solid, const glm::dvec3& point, const glm::dmat3& eye_from_scene,
                                double distance) {
    const glm::dvec3 forward = glm::transpose(eye_from_scene)[1];
    Outline outline;
    make_outline(solid, 0, {point - distance * forward}, eye_from_scene, {kNarrow, 2.0 * kNarrow / kRows, kRows},
                 outline);
    if (outline.direct || !(outline.zeta_from < outline.zeta_to)) return std::nullopt;
    const double z0 = outline.solid.z0;
    Reach reach{{kNarrow, z0 + outline.zeta_from}, {-kNarrow, z0 + outline.zeta_to}};
    // Within a band nothing turns a corner.
    std::vector<ZBand> bands = outline.bands;
    if (outline.limb_only) bands.push_back({outline.zeta_from, outline.zeta_to, 0, 0});
    for (const ZBand& band : bands)
        for (int i = 0; i <= kRowsOfBand; ++i) {
            std::array<Cut, kMaxCuts> cuts;
            const double part = 0.5 - 0.5 * std::cos(std::numbers::pi * i / kRowsOfBand);
            const double zeta = std::lerp(band.zeta_from, band.zeta_to, part);
            const int count = cuts_on_row(outline, z0 + zeta, cuts.data());
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

std::optional<Reach> reach_about(const Solid& solid, const glm::dvec3& point, const glm::dmat3& eye_from_scene) {
    for (double distance = kNearest; distance <= kFarthest; distance *= 100.0)
        if (const auto reach = reach_from(solid, point, eye_from_scene, distance)) return reach;
    return std::nullopt;
}

/// A box along an eye's axes (right, forward, up), m about a point.
struct Box {
    glm::dvec3 low, high;
    [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (low + high); }
};

std::optional<Box> box_about(const Solid& solid, const glm::dvec3& point, const glm::dmat3& eye_from_scene) {
    const glm::dmat3 axes = glm::transpose(eye_from_scene);
    const auto front = reach_about(solid, point, eye_from_scene);
    // From the right side, what was forward is to the right.
    const auto side = reach_about(solid, point, glm::transpose(glm::dmat3{axes[1], -axes[0], axes[2]}));
    if (!front || !side) return std::nullopt;
    return Box{{front->low.x, side->low.x, front->low.y}, {front->high.x, side->high.x, front->high.y}};
}

}  // namespace

std::optional<ScenePoint> eye_that_frames(const Solid& solid, const glm::dmat3& eye_from_scene, double x_reach,
                                          double z_reach) {
    const glm::dmat3 axes = glm::transpose(eye_from_scene);
    // Twice: about an anchor far from the solid, perspective would count.
    const auto rough = box_about(solid, solid.anchor.metres, eye_from_scene);
    if (!rough) return std::nullopt;
    const glm::dvec3 inside = solid.anchor.metres + axes * rough->middle();
    const auto box = box_about(solid, inside, eye_from_scene);
    if (!box) return std::nullopt;
    const glm::dvec3 half = 0.5 * (box->high - box->low), middle = box->middle();
    const double distance = std::max({half.x / x_reach, half.z / z_reach, 2.0 * kNearDepth});
    return ScenePoint{inside + axes * glm::dvec3(middle.x, box->low.y - distance, middle.z)};
}

}  // namespace quadrig
