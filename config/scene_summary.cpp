#include "config/scene_summary.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace quadrig::config {
namespace {

struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    void include(const glm::dvec3& centre, const glm::dvec3& half) {
        low = glm::min(low, centre - half);
        high = glm::max(high, centre + half);
    }
};

/// The box of an ellipsoid: along scene axis i it reaches sqrt(sum over its own axes k of (a_k R_ki)^2).
void include(Extent& extent, const Ellipsoid& ellipsoid) {
    const glm::dmat3 own_from_scene = eye_from_scene_rotation(ellipsoid.attitude);
    glm::dvec3 half;
    for (int i = 0; i < 3; ++i) half[i] = glm::length(ellipsoid.semi_axes * own_from_scene[i]);
    extent.include(ellipsoid.centre.metres, half);
}

std::string count(std::size_t n, const std::string& noun) {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

struct ObjectCounts {
    std::size_t ellipsoids = 0, hills = 0, quadrics = 0, textured = 0, translucent = 0, planes = 0, most_planes = 0;
    Extent extent;
};

ObjectCounts count_objects(const Scene& scene) {
    ObjectCounts counts;
    for (const Object& object : scene.objects) {
        if (const auto* ellipsoid = std::get_if<Ellipsoid>(&object.shape)) {
            ++counts.ellipsoids;
            include(counts.extent, *ellipsoid);
        } else if (const auto* hill = std::get_if<Hill>(&object.shape)) {
            ++counts.hills;
            counts.extent.include(hill->apex.metres, glm::dvec3(0.0));
        } else {
            ++counts.quadrics;
        }
        counts.textured += object.paint.texture ? 1 : 0;
        counts.translucent += object.paint.translucence ? 1 : 0;
        counts.planes += object.planes.size();
        counts.most_planes = std::max(counts.most_planes, object.planes.size());
    }
    return counts;
}

void write_objects(std::ostream& out, const ObjectCounts& counts, std::size_t total) {
    out << "objects:     " << total;
    if (total > 0) {
        out << " (" << count(counts.ellipsoids, "ellipsoid") << ", " << count(counts.hills, "hill") << ", "
            << count(counts.quadrics, "general quadric") << "); " << counts.textured << " textured, "
            << counts.translucent << " translucent";
    }
    out << "\nplanes:      " << counts.planes;
    if (counts.planes > 0) out << ", at most " << counts.most_planes << " on one object";
    out << '\n';
    if (counts.ellipsoids + counts.hills == 0) return;
    const auto range = [&](int axis) {
        std::ostringstream text;
        text << std::fixed << std::setprecision(1) << counts.extent.low[axis] << " to " << counts.extent.high[axis]
             << " m";
        return text.str();
    };
    out << "extents:     east " << range(0) << ", north " << range(1) << ", up " << range(2)
        << " (ellipsoids and hills' apexes)\n";
}

std::string texture_name(const Paint& paint, const Scene& scene) {
    return paint.texture ? ", texture " + scene.textures[*paint.texture].name : "";
}

}  // namespace

std::string summary(const Scene& scene) {
    std::ostringstream out;
    out << "scene:       " << (scene.name.empty() ? "(no name)" : scene.name) << '\n';
    out << "origin:      latitude " << std::setprecision(10) << scene.origin.latitude.value << ", longitude "
        << scene.origin.longitude.value << ", altitude " << scene.origin.altitude << " m\n"
        << std::setprecision(6);
    write_objects(out, count_objects(scene), scene.objects.size());
    out << "textures:    " << scene.textures.size();
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        out << (i == 0 ? " (" : ", ") << scene.textures[i].name << ' ' << count(scene.textures[i].terms.size(), "term");
    }
    out << (scene.textures.empty() ? "\n" : ")\n");
    out << "ground:      " << (scene.ground ? "Z = 0" + texture_name(scene.ground->paint, scene) : "none") << '\n';
    if (!scene.ground_polygons.empty())
        out << "markings:    " << count(scene.ground_polygons.size(), "polygon") << '\n';
    if (!scene.lights.empty()) out << "lights:      " << scene.lights.size() << '\n';
    out << "cloud decks: " << scene.cloud_decks.size();
    for (const CloudDeck& deck : scene.cloud_decks)
        out << "; at " << deck.altitude << " m" << texture_name(deck.paint, scene);
    out << "\nhaze:        ";
    if (scene.haze && std::isfinite(scene.haze->visibility))
        out << "visibility " << scene.haze->visibility << " m";
    else
        out << "none";
    out << "\nsun:         azimuth " << scene.sun.azimuth.value << ", elevation " << scene.sun.elevation.value
        << ", ambient " << scene.sun.ambient << '\n';
    return out.str();
}

}  // namespace quadrig::config
