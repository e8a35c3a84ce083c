/// What a session asks the scene for its host: lines, and the first surface on each. Who knows the scene answers.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "ig_core/geometry/space.h"

namespace quadrig::host {

struct SurveyLine {
    ScenePoint from;
    glm::dvec3 direction{0.0};  ///< unit
    double least = 0.0;         ///< m: nearer surfaces do not count
    double most = 0.0;          ///< m
};

struct SurveyHit {
    double distance = 0.0;  ///< m
    ScenePoint point;
    glm::dvec3 normal{0.0};      ///< unit, out of the surface
    std::uint32_t material = 0;  ///< code that the host gets
};

/// Called on a link's thread; has to be safe there beside the frame loop.
using Surveyor = std::function<std::optional<SurveyHit>(const SurveyLine&)>;

}  // namespace quadrig::host
