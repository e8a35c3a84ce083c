/// Texturing function, light, opacity and haze of a single surface point (MODEL: "Texturing function", "Shade"), in
/// double: exact to about 1e-12 for arguments below 1e4 rad, no frequency is faded out.
#pragma once

#include "ig_core/scene/scene.h"
#include "ig_core/view.h"

namespace quadrig::reference {

/// Gardner 1984, Eq 15, with vertical variation and drift: T in 0..1 at a surface point in scene space, `seconds` scene
/// time.
double texturing_function(const Texture& texture, const ScenePoint& point, double seconds);

/// Unit vector towards the sun: azimuth clockwise from north, elevation from the horizon.
glm::dvec3 direction_to(const Sun& sun);

/// The scene's light and air after the environment has had its say.
struct Air {
    double seconds = 0.0;
    glm::dvec3 to_sun{0.0, 0.0, 1.0};
    double ambient = 0.0;
    Sky sky;
    std::optional<Haze> haze;
};
Air air_of(const Scene& scene, const Environment& environment);

/// A point of a surface as the eye sees it.
struct SurfacePoint {
    ScenePoint point;
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, outward
    double limb = 1.0;                 ///< limb function g
    double range = 0.0;                ///< slant range, m
};

/// Colour after light, texture and haze, and how much of what lies behind it covers.
struct Coat {
    Colour colour{0.0};
    double opacity = 1.0;
};
Coat coat_of(const Paint& paint, const std::vector<Texture>& textures, const SurfacePoint& at, const Air& air);

/// Colour of a light's disc at a slant range (metres).
Coat coat_of(const LightPoint& light, double range, const Air& air);

/// The last polygon that holds a point of the ground, as its place in the scene.
std::optional<std::uint32_t> polygon_at(const std::vector<GroundPolygon>& polygons, const glm::dvec2& point);

/// Colour of the sky at a sine of elevation; below the horizon it is the horizon's.
Colour sky_colour(const Sky& sky, double sine_of_elevation);

}  // namespace quadrig::reference
