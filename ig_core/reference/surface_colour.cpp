#include "ig_core/reference/surface_colour.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace quadrig::reference {

double texturing_function(const Texture& texture, const ScenePoint& point, double seconds) {
    constexpr double pi = std::numbers::pi;
    const glm::dvec3& p = point.metres;
    double east = 0.0, north = 0.0, coefficients = 0.0;
    const double up = p.z - texture.rise * seconds;
    for (const auto& [c, w, start] : texture.terms) {
        const double phase = start + texture.churn * seconds;
        const double px = pi / 2 * std::sin(w * p.y / 2 + phase) +
                          pi * texture.vertical * std::sin(w * up / 2 + phase) + w * texture.drift.x * seconds;
        const double py = pi / 2 * std::sin(w * p.x / 2 + phase) +
                          pi * texture.vertical * std::cos(w * up / 2 + phase) + w * texture.drift.y * seconds;
        east += c * (std::sin(w * p.x + px) + 1) / 2;
        north += c * (std::sin(w * p.y + py) + 1) / 2;
        coefficients += c;
    }
    return east * north / (coefficients * coefficients);
}

glm::dvec3 direction_to(const Sun& sun) {
    const double azimuth = sun.azimuth.radians(), elevation = sun.elevation.radians();
    return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

Air air_of(const Scene& scene, const Environment& environment) {
    const Sun sun = environment.sun.value_or(scene.sun);
    Air air{environment.seconds, direction_to(sun), sun.ambient, scene.sky, scene.haze};
    if (environment.visibility) {
        if (!air.haze) air.haze = Haze{0.0, scene.sky.horizon};
        air.haze->visibility = *environment.visibility;
    }
    return air;
}

Coat coat_of(const Paint& paint, const std::vector<Texture>& textures, const SurfacePoint& at, const Air& air) {
    const double light = air.ambient + (1 - air.ambient) * std::max(0.0, glm::dot(at.normal, air.to_sun));
    Coat coat{paint.colour * light, 1.0};
    if (paint.texture) {
        const double t = texturing_function(textures[*paint.texture], at.point, air.seconds);
        coat.colour = paint.colour * ((1 - paint.texture_weight) * light + paint.texture_weight * t);
        if (const auto& holes = paint.translucence) {
            const double threshold = holes->threshold + (holes->limb_threshold - holes->threshold) * (1 - at.limb);
            coat.opacity = std::clamp((t - threshold) / holes->softness + 0.5, 0.0, 1.0);
        }
    }
    if (air.haze) {
        const double clearness = std::exp(-2.996 * at.range / air.haze->visibility);
        coat.colour = clearness * coat.colour + (1 - clearness) * air.haze->colour;
    }
    return coat;
}

Coat coat_of(const LightPoint& light, double range, const Air& air) {
    const double clearness = air.haze ? std::exp(-2.996 * range / air.haze->visibility) : 1.0;
    const Colour haze = air.haze ? (1 - clearness) * air.haze->colour : Colour(0.0);
    double brightness = clearness * light.intensity;
    double brightest_haze = 0.0, brightest_light = 0.0;
    for (int c = 0; c < 3; ++c)
        brightest_haze = std::max(brightest_haze, haze[c]),
        brightest_light = std::max(brightest_light, light.colour[c]);
    if (brightest_haze + brightness * brightest_light > 1.0)
        brightness = brightest_light > 0.0 ? std::max(0.0, (1.0 - brightest_haze) / brightest_light) : 0.0;
    return {haze + brightness * light.colour, 1.0};
}

std::optional<std::uint32_t> polygon_at(const std::vector<GroundPolygon>& polygons, const glm::dvec2& point) {
    for (auto index = static_cast<std::uint32_t>(polygons.size()); index-- > 0;) {
        const auto& corners = polygons[index].corners;
        bool left = true, right = true;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i], to = point - corners[i];
            const double turn = side.x * to.y - side.y * to.x;
            left = left && turn >= 0, right = right && turn <= 0;
        }
        if (left || right) return index;
    }
    return std::nullopt;
}

Colour sky_colour(const Sky& sky, double sine_of_elevation) {
    return glm::mix(sky.horizon, sky.zenith, std::clamp(sine_of_elevation, 0.0, 1.0));
}

}  // namespace quadrig::reference
