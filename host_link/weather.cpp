#include "host_link/weather.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace quadrig::host {

double WeatherRegion::share_at(const ScenePoint& eye) const {
    const glm::dvec3 from_middle = middle.eye_from_scene * (eye.metres - middle.position.metres);
    // A rounded rectangle is all that is within the corner's radius of a smaller one.
    const glm::dvec2 within = 0.5 * glm::dvec2(width, length) - corner_radius;
    const glm::dvec2 beyond = glm::max(glm::abs(glm::dvec2(from_middle)) - within, 0.0);
    const double outside = glm::length(beyond) - corner_radius;
    if (outside <= 0.0) return 1.0;
    return outside < transition_perimeter ? 1.0 - outside / transition_perimeter : 0.0;
}

}  // namespace quadrig::host
