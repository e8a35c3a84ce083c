#include "ig_core/spans/seen_features.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace quadrig {
namespace {

bool reaches(const LightPoint& light, const ScenePoint& eye) {
    if (!light.beam) return true;
    const glm::dvec3 to_eye = eye.metres - light.position.metres;
    const double heading = light.beam->heading.radians();
    const double along = to_eye.x * std::sin(heading) + to_eye.y * std::cos(heading);
    const double across = to_eye.x * std::cos(heading) - to_eye.y * std::sin(heading);
    return std::abs(std::atan2(across, along)) <= 0.5 * light.beam->width.radians();
}

}  // namespace

void look_at(const std::vector<GroundPolygon>& polygons, const View& view, std::vector<SeenPolygon>& seen) {
    seen.clear();
    const ImagePlane& image = view.image;
    const double bottom = image.z(image.height);
    for (std::uint32_t index = 0; index < polygons.size(); ++index) {
        const std::vector<glm::dvec2>& corners = polygons[index].corners;
        std::array<glm::dvec3, kMaxCorners> about_eye;
        glm::dvec3 middle(0.0);
        bool whole = true;
        double z_from = image.top, z_to = bottom;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            about_eye[i] = view.eye_from_scene * (glm::dvec3(corners[i], 0.0) - view.eye.metres);
            middle += about_eye[i] / static_cast<double>(corners.size());
            whole = whole && about_eye[i].y > kNearDepth;
            const double z = about_eye[i].z / about_eye[i].y;
            z_from = std::min(z_from, z), z_to = std::max(z_to, z);
        }
        if (!whole) z_from = bottom, z_to = image.top;
        if (z_to < bottom || z_from > image.top) continue;
        SeenPolygon polygon;
        polygon.polygon = index;
        polygon.z_from = z_from, polygon.z_to = z_to;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec3 edge = glm::cross(about_eye[i], about_eye[(i + 1) % corners.size()]);
            polygon.edges[polygon.edge_count++] = glm::dot(edge, middle) < 0.0 ? -edge : edge;
        }
        seen.push_back(polygon);
    }
}

void look_at(const std::vector<LightPoint>& lights, const View& view, double least_diameter,
             std::vector<SeenLight>& seen) {
    seen.clear();
    const ImagePlane& image = view.image;
    for (std::uint32_t index = 0; index < lights.size(); ++index) {
        const LightPoint& light = lights[index];
        const glm::dvec3 p = view.eye_from_scene * (light.position.metres - view.eye.metres);
        if (!(p.y > kNearDepth) || !reaches(light, view.eye)) continue;
        SeenLight out;
        out.light = index;
        out.x = p.x / p.y, out.z = p.z / p.y, out.u = 1.0 / p.y;
        const double radius = 0.5 * std::max(light.diameter * out.u, least_diameter);
        out.rows = radius / image.row_step, out.columns = radius / image.column_step;
        if (out.x + radius < image.left || out.x - radius > image.x(image.width)) continue;
        if (out.z + radius < image.z(image.height) || out.z - radius > image.top) continue;
        seen.push_back(out);
    }
}

}  // namespace quadrig
