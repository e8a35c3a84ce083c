#include <array>
#include <cmath>
#include <ostream>
#include <span>

#include "config/scene_file.h"
#include "config/toml_text.h"

namespace quadrig::config {
namespace {

std::ostream& operator<<(std::ostream& out, std::span<const double> numbers) {
    out << '[';
    for (std::size_t i = 0; i < numbers.size(); ++i) out << (i > 0 ? ", " : "") << Exact{numbers[i]};
    return out << ']';
}
using Numbers = std::span<const double>;

void write_colour(std::ostream& out, std::string_view key, const Colour& c) {
    out << key << " = " << Numbers(std::array{c.r, c.g, c.b}) << '\n';
}

void write_paint(std::ostream& out, const Paint& paint, const Scene& scene) {
    write_colour(out, "colour", paint.colour);
    if (!paint.texture) return;
    out << "texture = " << Quoted{scene.textures[*paint.texture].name} << '\n';
    out << "texture_weight = " << Exact{paint.texture_weight} << '\n';
    if (!paint.translucence) return;
    out << "translucence = { threshold = " << Exact{paint.translucence->threshold}
        << ", limb_threshold = " << Exact{paint.translucence->limb_threshold}
        << ", softness = " << Exact{paint.translucence->softness} << " }\n";
}

void write_texture(std::ostream& out, const Texture& texture) {
    std::vector<double> coefficients, frequencies, phases;
    for (const TextureTerm& term : texture.terms) {
        coefficients.push_back(term.coefficient);
        frequencies.push_back(term.frequency);
        phases.push_back(term.phase);
    }
    out << "[[texture]]\nname = " << Quoted{texture.name} << "\ncoefficients = " << Numbers(coefficients)
        << "\nfrequencies = " << Numbers(frequencies) << "\nphases = " << Numbers(phases)
        << "\nvertical = " << Exact{texture.vertical}
        << "\ndrift = " << Numbers(std::array{texture.drift.x, texture.drift.y}) << '\n';
    if (texture.rise != 0.0) out << "rise = " << Exact{texture.rise} << '\n';
    if (texture.churn != 0.0) out << "churn = " << Exact{texture.churn} << '\n';
}

struct ShapeWriter {
    std::ostream& out;
    void operator()(const Ellipsoid& e) const {
        const glm::dvec3& c = e.centre.metres;
        out << "ellipsoid = { centre = " << Numbers(std::array{c.x, c.y, c.z})
            << ", semi_axes = " << Numbers(std::array{e.semi_axes.x, e.semi_axes.y, e.semi_axes.z}) << ", attitude = "
            << Numbers(std::array{e.attitude.heading.value, e.attitude.pitch.value, e.attitude.roll.value}) << " }\n";
    }
    void operator()(const Hill& hill) const {
        const glm::dvec3& a = hill.apex.metres;
        out << "hill = { apex = " << Numbers(std::array{a.x, a.y, a.z})
            << ", radius_of_curvature = " << Exact{hill.radius_of_curvature} << ", slope = " << Exact{hill.slope}
            << " }\n";
    }
    void operator()(const GeneralQuadric& q) const { out << "quadric = " << Numbers(q.coefficients) << '\n'; }
};

void write_motion(std::ostream& out, const Motion& motion) {
    const glm::dvec3& v = motion.velocity;
    out << "motion = { velocity = " << Numbers(std::array{v.x, v.y, v.z});
    if (motion.within) out << ", within = " << Numbers(*motion.within);
    if (motion.sway) {
        out << ", sway = { angle = " << Exact{motion.sway->angle.value} << ", period = " << Exact{motion.sway->period}
            << ", wavelength = " << Exact{motion.sway->wavelength} << " }";
    }
    out << " }\n";
}

void write_object(std::ostream& out, const Object& object, const Scene& scene) {
    out << "[[object]]\n";
    if (!object.name.empty()) out << "name = " << Quoted{object.name} << '\n';
    std::visit(ShapeWriter{out}, object.shape);
    if (!object.planes.empty()) {
        out << "planes = [";
        for (std::size_t i = 0; i < object.planes.size(); ++i) {
            out << (i > 0 ? ", " : "") << Numbers(object.planes[i].coefficients);
        }
        out << "]\n";
    }
    write_paint(out, object.paint, scene);
    if (object.motion) write_motion(out, *object.motion);
}

void write_light(std::ostream& out, const LightPoint& light) {
    const glm::dvec3& p = light.position.metres;
    out << "[[light]]\npositions = [[" << Exact{p.x} << ", " << Exact{p.y} << ", " << Exact{p.z} << "]]\n";
    write_colour(out, "colour", light.colour);
    out << "intensity = " << Exact{light.intensity} << "\ndiameter = " << Exact{light.diameter} << '\n';
    if (light.beam)
        out << "beam = { heading = " << Exact{light.beam->heading.value}
            << ", width = " << Exact{light.beam->width.value} << " }\n";
}

}  // namespace

void write_scene(const Scene& scene, std::ostream& out) {
    out << "[scene]\n";
    if (!scene.name.empty()) out << "name = " << Quoted{scene.name} << '\n';
    out << "origin = { latitude = " << Exact{scene.origin.latitude.value}
        << ", longitude = " << Exact{scene.origin.longitude.value} << ", altitude = " << Exact{scene.origin.altitude}
        << " }\n";
    out << "[sun]\nazimuth = " << Exact{scene.sun.azimuth.value} << "\nelevation = " << Exact{scene.sun.elevation.value}
        << "\nambient = " << Exact{scene.sun.ambient} << "\n[sky]\n";
    write_colour(out, "horizon", scene.sky.horizon);
    write_colour(out, "zenith", scene.sky.zenith);
    if (scene.haze) {
        out << "[haze]\n";
        if (std::isfinite(scene.haze->visibility)) out << "visibility = " << Exact{scene.haze->visibility} << '\n';
        write_colour(out, "colour", scene.haze->colour);
    }
    if (scene.ground) {
        out << "[ground]\n";
        write_paint(out, scene.ground->paint, scene);
    }
    for (const GroundPolygon& polygon : scene.ground_polygons) {
        out << "[[ground_polygon]]\ncorners = [";
        for (std::size_t i = 0; i < polygon.corners.size(); ++i)
            out << (i == 0 ? "[" : ", [") << Exact{polygon.corners[i].x} << ", " << Exact{polygon.corners[i].y} << ']';
        out << "]\n";
        write_paint(out, polygon.paint, scene);
    }
    for (const LightPoint& light : scene.lights) write_light(out, light);
    for (const CloudDeck& deck : scene.cloud_decks) {
        out << "[[cloud_deck]]\naltitude = " << Exact{deck.altitude} << '\n';
        write_paint(out, deck.paint, scene);
    }
    for (const Texture& texture : scene.textures) write_texture(out, texture);
    for (const Object& object : scene.objects) write_object(out, object, scene);
}

}  // namespace quadrig::config
