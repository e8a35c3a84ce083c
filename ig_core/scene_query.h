/// What a straight line meets in a scene: nearest surface, where, which, and how it faces. Closed form, no picture.
///
/// Space: scene, metres. Objects count as solids by their shapes alone, whatever their paint; cloud decks do not count,
/// the ground does. A solid that holds the line's beginning is not met, as the image generator does not draw it.
/// Error: 1e-6 m or 1e-9 of the distance, whichever is larger, where the line is not tangent to the surface within
/// 1e-6 of its distance. Source: Gardner 1984, Eq 4 (quadric along a ray), Eq 9 (bounding planes).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "ig_core/geometry/space.h"
#include "ig_core/scene/scene.h"
#include "ig_core/scene/solid.h"

namespace quadrig {

struct SurfaceHit {
    double distance = 0.0;  ///< m from the line's beginning
    ScenePoint point;
    glm::dvec3 normal{0.0};           ///< unit; out of the solid, up from the ground
    std::int32_t object = kGroundId;  ///< index in the file, or kGroundId
    std::int32_t surface = 0;         ///< 0 the quadric or the ground, j the object's j-th plane
};

/// A scene's solids, ready to be asked. Costs memory and a look at each object's bounding sphere per question; asking
/// allocates nothing and may go on in several threads.
class SceneQuery {
  public:
    explicit SceneQuery(const Scene& scene);

    /// The nearest surface entered from `from` along the unit vector `direction`, further than `least` and at most
    /// `most` metres away.
    [[nodiscard]] std::optional<SurfaceHit> nearest(const ScenePoint& from, const glm::dvec3& direction, double least,
                                                    double most) const;

    /// The highest surface on the vertical through X, Y, looked for within 1000 km of Z = 0.
    [[nodiscard]] std::optional<SurfaceHit> highest(double x, double y) const;

  private:
    std::vector<Solid> solids_;
    bool ground_ = false;
};

}  // namespace quadrig
