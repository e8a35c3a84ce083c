#include "config/ground_section.h"

#include <iterator>
#include <string>

#include "config/object_section.h"
#include "ig_core/clusters/runway.h"

namespace quadrig::config {
namespace {

constexpr std::size_t kMostPositions = 100'000;
constexpr NumberRule kIntensity{"times white, 1e-3..1e6", [](double x) { return x >= 1e-3 && x <= 1e6; }};
constexpr NumberRule kLightDiameter{"metres in 1e-3..1000", [](double x) { return x >= 1e-3 && x <= 1000.0; }};
constexpr NumberRule kBeamWidth{"degrees above 0, at most 360", [](double x) { return x > 0.0 && x <= 360.0; }};
constexpr NumberRule kRunwayLength{"metres in 100..20000", [](double x) { return x >= 100.0 && x <= 20'000.0; }};
constexpr NumberRule kRunwayWidth{"metres in 5..200", [](double x) { return x >= 5.0 && x <= 200.0; }};
constexpr NumberRule kEdgeLightSpacing{"metres in 1..1000", [](double x) { return x >= 1.0 && x <= 1000.0; }};
constexpr NumberRule kApproach{"metres in 0..3000", [](double x) { return x >= 0.0 && x <= 3000.0; }};

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

/// Whether the corners turn one way all round, and round once.
bool is_convex(const std::vector<glm::dvec2>& corners) {
    const std::size_t count = corners.size();
    bool left = false, right = false;
    int changes_of_direction = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % count], &c = corners[(i + 2) % count];
        const double t = turn(a, b, c);
        if (a == b) return false;
        left = left || t > 0.0, right = right || t < 0.0;
        changes_of_direction += (b.x > a.x || (b.x == a.x && b.y > a.y)) != (c.x > b.x || (c.x == b.x && c.y > b.y));
    }
    return left != right && changes_of_direction == 2;
}

GroundPolygon read_polygon(const TomlSection& section, Textures& textures) {
    GroundPolygon polygon;
    for (const auto& row : section.rows("corners", kCoordinate, 2, kMaxCorners))
        polygon.corners.emplace_back(row[0], row[1]);
    if (polygon.corners.size() < 3)
        section.refuse("corners", "3 to 16 corners [X, Y]", "an array of " + std::to_string(polygon.corners.size()));
    if (!is_convex(polygon.corners))
        section.refuse("corners", "the corners of a convex polygon, in order", "a polygon that is not convex");
    polygon.paint = read_paint(section, textures);
    return polygon;
}

void add_lights(const TomlSection& section, std::vector<LightPoint>& lights) {
    LightPoint light;
    if (section.has("colour")) light.colour = section.triple("colour", kColour);
    light.intensity = section.number_or("intensity", kIntensity, 20.0);
    light.diameter = section.number_or("diameter", kLightDiameter, light.diameter);
    if (const auto beam = section.optional_table("beam", {"heading", "width"}))
        light.beam = LightPoint::Beam{{beam->number("heading", kTurn)}, {beam->number("width", kBeamWidth)}};
    const auto places = section.rows("positions", kCoordinate, 3, kMostPositions);
    if (places.empty()) section.refuse("positions", "at least one position [X, Y, Z]", "none");
    for (const auto& place : places) {
        light.position = {{place[0], place[1], place[2]}};
        lights.push_back(light);
    }
}

clusters::Runway read_runway(const TomlSection& section, Textures& textures) {
    clusters::Runway runway;
    runway.threshold = section.pair("threshold", kCoordinate);
    runway.heading = {section.number("heading", kTurn)};
    runway.length = section.number("length", kRunwayLength);
    runway.width = section.number_or("width", kRunwayWidth, runway.width);
    const Colour asphalt = runway.paint.colour;
    runway.paint = read_paint(section, textures);
    if (!section.has("colour")) runway.paint.colour = asphalt;
    runway.markings = section.flag_or("markings", true);
    if (section.has("marking_colour")) runway.marking_colour = section.triple("marking_colour", kColour);
    if (const auto lights = section.optional_table("lights", {"intensity", "spacing", "approach"})) {
        clusters::RunwayLights& l = runway.lights.emplace();
        l.intensity = lights->number_or("intensity", kIntensity, l.intensity);
        l.spacing = lights->number_or("spacing", kEdgeLightSpacing, l.spacing);
        l.approach = lights->number_or("approach", kApproach, l.approach);
    }
    return runway;
}

template <class Value>
void append(std::vector<Value>& all, std::vector<Value> more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

void add_ground_features(const TomlSection& root, Textures& textures, Scene& scene) {
    for (const TomlSection& section :
         root.tables("runway", {"threshold", "heading", "length", "width", "colour", "texture", "texture_weight",
                                "markings", "marking_colour", "lights"})) {
        const clusters::Runway runway = read_runway(section, textures);
        append(scene.ground_polygons, polygons_of(runway));
        append(scene.lights, lights_of(runway));
    }
    for (const TomlSection& section : root.tables("ground_polygon", {"corners", "colour", "texture", "texture_weight"}))
        scene.ground_polygons.push_back(read_polygon(section, textures));
    for (const TomlSection& section : root.tables("light", {"positions", "colour", "intensity", "diameter", "beam"}))
        add_lights(section, scene.lights);
}

}  // namespace quadrig::config
