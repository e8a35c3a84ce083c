#include "config/object_section.h"

#include <algorithm>
#include <cmath>

#include "config/convexity.h"

namespace quadrig::config {
namespace {

constexpr NumberRule kSpeed{"m/s in -1e6..1e6", [](double x) { return x >= -1e6 && x <= 1e6; }};
constexpr NumberRule kLean{"degrees in 0..90", [](double x) { return x >= 0.0 && x <= 90.0; }};
constexpr NumberRule kPeriod{"seconds in 1e-3..1e9", [](double x) { return x >= 1e-3 && x <= 1e9; }};
constexpr NumberRule kThreshold{"a threshold in -10..10", [](double x) { return x >= -10.0 && x <= 10.0; }};

Translucence read_translucence(const TomlSection& section) {
    Translucence translucence;
    translucence.threshold = section.number("threshold", kThreshold);
    translucence.limb_threshold = section.number_or("limb_threshold", kThreshold, translucence.threshold);
    translucence.softness = section.number_or("softness", kPositive, translucence.softness);
    if (translucence.limb_threshold < translucence.threshold) {
        section.refuse("limb_threshold", "at least the threshold", "less");
    }
    return translucence;
}

Ellipsoid read_ellipsoid(const TomlSection& section) {
    Ellipsoid ellipsoid;
    ellipsoid.centre = {section.triple("centre", kCoordinate)};
    ellipsoid.semi_axes = section.triple("semi_axes", kLength);
    if (section.has("attitude")) {
        ellipsoid.attitude = attitude_in(section);
        if (section.has("heading")) section.refuse("heading", "either heading or attitude", "both");
    }
    if (section.has("heading")) ellipsoid.attitude.heading = {section.number("heading", kTurn)};
    return ellipsoid;
}

Hill read_hill(const TomlSection& section) {
    return {{section.triple("apex", kCoordinate)},
            section.number("radius_of_curvature", kLength),
            section.number("slope", kSlope)};
}

Shape read_shape(const TomlSection& object) {
    const int shapes = int{object.has("ellipsoid")} + int{object.has("hill")} + int{object.has("quadric")};
    if (shapes != 1) {
        object.refuse(std::string("expected one of ellipsoid, hill, quadric, found ") +
                      (shapes == 0 ? "none" : "more"));
    }
    if (const auto ellipsoid = object.optional_table("ellipsoid", {"centre", "semi_axes", "heading", "attitude"})) {
        return read_ellipsoid(*ellipsoid);
    }
    if (const auto hill = object.optional_table("hill", {"apex", "radius_of_curvature", "slope"}))
        return read_hill(*hill);
    GeneralQuadric quadric;
    const auto numbers =
        object.numbers("quadric", kCoefficient, quadric.coefficients.size(), quadric.coefficients.size());
    std::copy(numbers.begin(), numbers.end(), quadric.coefficients.begin());
    return quadric;
}

constexpr double kShortestNormal = 1e-60;  // its square is a number still

std::vector<BoundingPlane> read_planes(const TomlSection& object) {
    std::vector<BoundingPlane> planes;
    for (const auto& row : object.rows("planes", kCoefficient, 4, kMaxPlanes)) {
        if (std::max({std::abs(row[0]), std::abs(row[1]), std::abs(row[2])}) < kShortestNormal) {
            object.refuse("planes", planes.size(), "B1, B2 or B3 of at least 1e-60", "a normal next to 0");
        }
        planes.push_back({{row[0], row[1], row[2], row[3]}});
    }
    return planes;
}

Motion read_motion(const TomlSection& section, const Object& object) {
    Motion motion;
    if (section.has("velocity")) motion.velocity = section.triple("velocity", kSpeed);
    if (section.has("within")) {
        if (std::holds_alternative<GeneralQuadric>(object.shape))
            section.refuse("within", "an ellipsoid or a hill to keep there", "a quadric");
        const auto sides = section.numbers("within", kCoordinate, 4, 4);
        if (sides[0] >= sides[2] || sides[1] >= sides[3])
            section.refuse("within", "[west, south, east, north]", "west not below east or south not below north");
        motion.within = {sides[0], sides[1], sides[2], sides[3]};
    }
    if (const auto sway = section.optional_table("sway", {"angle", "period", "wavelength"})) {
        if (!std::holds_alternative<Ellipsoid>(object.shape)) section.refuse("sway", "an ellipsoid to sway", "another");
        motion.sway = Sway{{sway->number("angle", kLean)},
                           sway->number_or("period", kPeriod, Sway{}.period),
                           sway->number_or("wavelength", kLength, Sway{}.wavelength)};
    }
    return motion;
}

}  // namespace

Paint read_paint(const TomlSection& section, Textures& textures) {
    Paint paint;
    if (section.has("colour")) paint.colour = section.triple("colour", kColour);
    if (const auto name = section.optional_text("texture")) {
        paint.texture = textures.index_of(section, *name);
    }
    paint.texture_weight = section.number_or("texture_weight", kFraction, paint.texture_weight);
    if (paint.texture_weight > 0.0 && !paint.texture) section.refuse("texture_weight", "a texture beside it", "none");
    if (!section.has("translucence")) return paint;
    if (!paint.texture) section.refuse("translucence", "a texture beside it", "none");
    paint.translucence = read_translucence(section.table("translucence", {"threshold", "limb_threshold", "softness"}));
    return paint;
}

Object read_object(const TomlSection& section, Textures& textures) {
    Object object;
    object.shape = read_shape(section);
    object.planes = read_planes(section);
    object.paint = read_paint(section, textures);
    if (const auto motion = section.optional_table("motion", {"velocity", "within", "sway"}))
        object.motion = read_motion(*motion, object);
    if (const auto* quadric = std::get_if<GeneralQuadric>(&object.shape)) {
        if (const auto reason = why_not_convex(*quadric, object.planes)) {
            section.refuse("quadric", "a solid Q <= 0 that is one convex piece within its planes", "that " + *reason);
        }
    }
    return object;
}

}  // namespace quadrig::config
