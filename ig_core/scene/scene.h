/// The world as plain data: exactly the numbers a scene file gives, in scene space, metres and radians per metre.
/// Colours are linear light, 0..1. What a picture of it is: see the image model in ig_core/README.md.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ig_core/geometry/space.h"

namespace quadrig {

using Colour = glm::dvec3;

/// Parameters of the texturing function (Gardner 1984, Eq 15): at most kMaxTextureTerms terms.
inline constexpr int kMaxTextureTerms = 7;
struct TextureTerm {
    double coefficient = 1.0;
    double frequency = 1.0;  ///< rad/m, > 0
    double phase = 0.0;      ///< rad
};
struct Texture {
    std::string name;
    std::vector<TextureTerm> terms;  ///< 1..kMaxTextureTerms, sum of coefficients > 0, in file order
    double vertical = 0.0;           ///< vertical variation u >= 0
    glm::dvec2 drift{0.0};           ///< m/s, east and north
    double rise{};                   ///< m/s upwards, seen by vertical variation
    double churn{};                  ///< rad/s added to all phases: the pattern changes in place
};

/// Thresholds of the texturing function below which a surface is a hole (2.2): limb_threshold >= threshold, softness >
/// 0.
struct Translucence {
    double threshold = 0.0;
    double limb_threshold = 0.0;
    double softness = 0.1;
};

/// How a surface is painted. `texture` indexes Scene::textures; without one T is taken as 0 with weight 0 and
/// opacity 1.
struct Paint {
    Colour colour{1.0};
    std::optional<std::uint32_t> texture;
    double texture_weight = 0.0;  ///< 0..1
    std::optional<Translucence> translucence;
};

struct Ellipsoid {
    ScenePoint centre;
    glm::dvec3 semi_axes{1.0};  ///< right, forward, up in the ellipsoid's own axes, > 0
    Attitude attitude;
};
/// Lower sheet of a two-sheet hyperboloid of revolution, and all below it: apex, radius of curvature there, far slope.
/// (Z - h - c)^2/c^2 - ((X-X0)^2 + (Y-Y0)^2)/a^2 = 1 with c = r m^2, a = r m.
struct Hill {
    ScenePoint apex;
    double radius_of_curvature = 1.0;  ///< > 0
    double slope = 1.0;                ///< > 0
};
/// Eq 1: Q1 X2, Q2 Y2, Q3 Z2, Q4 XY, Q5 YZ, Q6 XZ, Q7 X, Q8 Y, Q9 Z, Q0. Inside is negative.
struct GeneralQuadric {
    std::array<double, 10> coefficients{};
};
using Shape = std::variant<Ellipsoid, Hill, GeneralQuadric>;

/// Eq 2, 9: B1 X + B2 Y + B3 Z + B4, kept where positive. Not normalised.
struct BoundingPlane {
    std::array<double, 4> coefficients{};
};

/// Leaning to and fro about the lowest point, east and west, as a wind from the west does.
struct Sway {
    Degrees angle;              ///< either way
    double period = 4.0;        ///< s, > 0
    double wavelength = 200.0;  ///< m between gusts, > 0
};
/// How an object moves with scene time; without `within` it is where the file puts it at time 0.
struct Motion {
    glm::dvec3 velocity{0.0};                     ///< m/s, east, north, up
    std::optional<std::array<double, 4>> within;  ///< west, south, east, north: what is outside comes in opposite
    std::optional<Sway> sway;                     ///< not for hills
};

/// A convex solid {Q <= 0 and every P_j > 0}. Surface 0 is the quadric, surface j its j-th plane (1-based).
struct Object {
    std::string name;
    Shape shape;
    std::vector<BoundingPlane> planes;
    Paint paint;
    std::optional<Motion> motion{};
};
inline constexpr int kMaxPlanes = 16;

/// Something that a host may put down in the scene and move about: objects in its own axes (X right, Y forward, Z up,
/// metres), without textures and hills.
struct Model {
    std::string name;
    std::vector<Object> objects;
};

struct Sun {
    Degrees azimuth{180.0};  ///< clockwise from north
    Degrees elevation{45.0};
    double ambient = 0.3;  ///< 0..1
};
struct Sky {
    Colour horizon{0.62, 0.72, 0.82};
    Colour zenith{0.18, 0.34, 0.62};
};
/// Visibility is the meteorological optical range (5 % contrast): e = exp(-2.996 R / V).
struct Haze {
    double visibility = 20000.0;  ///< m, > 0; infinite: clear air, unless a host says otherwise
    Colour colour{0.62, 0.72, 0.82};
};
/// The plane Z = 0, seen from either side.
struct Ground {
    Paint paint;  ///< opaque: never translucent
};
/// A part of the plane Z = 0 with a paint of its own: a runway, its markings. Convex, corners in order either way
/// round; where polygons overlap the last one in the file is seen. In ids it is ground.
struct GroundPolygon {
    std::vector<glm::dvec2> corners;  ///< 3..kMaxCorners
    Paint paint;                      ///< opaque: never translucent
};
inline constexpr std::size_t kMaxCorners = 16;

/// A light that is seen as a disc facing the eye, at the depth of its centre. From afar the disc stays
/// kLeastLightPixels wide and as bright as it is. Haze dims it like everything else, but what is brighter than white
/// can lose more before it goes; the picture shows it in its own colour, as bright as the brightest channel allows. It
/// has no id.
struct LightPoint {
    ScenePoint position;
    Colour colour{1.0};
    double intensity = 1.0;  ///< times white, > 0
    double diameter = 0.3;   ///< m, > 0
    /// Where it can be seen from: bearings from the light within half the width of the heading.
    struct Beam {
        Degrees heading;
        Degrees width{360.0};
    };
    std::optional<Beam> beam;
};
/// Pixels (rows) across.
inline constexpr double kLeastLightPixels = 1.5;

/// A plane at an altitude above scene Z = 0, normal up.
struct CloudDeck {
    double altitude = 0.0;
    Paint paint;
};

struct Scene {
    std::string name;
    GeodeticPosition origin;
    Sun sun;
    Sky sky;
    std::optional<Haze> haze;
    std::optional<Ground> ground;
    std::vector<GroundPolygon> ground_polygons;
    std::vector<LightPoint> lights;
    std::vector<CloudDeck> cloud_decks;
    std::vector<Texture> textures;
    std::vector<Object> objects;
    std::vector<Model> models;  ///< not in the picture but where Environment::bodies puts them
};

/// Ids of what is not an object, in object-id planes.
inline constexpr std::int32_t kSkyId = -1;
inline constexpr std::int32_t kGroundId = -2;
/// Solids that a ray enters at a depth of k_near or less are not drawn on that ray.
inline constexpr double kNearDepth = 0.1;

}  // namespace quadrig
