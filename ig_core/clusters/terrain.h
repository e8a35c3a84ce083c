/// Hills as ground to stand on: their height above a point of the ground plane, in closed form.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "ig_core/scene/scene.h"

namespace quadrig::clusters {

class Terrain {
  public:
    /// Takes the object if it is a hill; others are nothing to stand on.
    void add(const Object& object);

    /// Z of the highest hill above that point within the hills' planes, and at least 0, the ground plane. A point in a
    /// plane that two hills share belongs to both.
    [[nodiscard]] double height(const glm::dvec2& point) const;

  private:
    struct Rise {
        Hill hill;
        std::vector<BoundingPlane> planes;
    };
    std::vector<Rise> rises_;
};

/// Z of the hill's surface, the lower sheet: h + c - sqrt(c^2 + m^2 d^2), d the distance from its axis.
double surface_height(const Hill& hill, const glm::dvec2& point);

}  // namespace quadrig::clusters
