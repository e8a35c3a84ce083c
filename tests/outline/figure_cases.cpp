#include "tests/outline/figure_cases.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/outline/framing.h"

namespace quadrig::test {

ImageWindow window_of(double half_width) { return {-half_width, half_width, -0.75 * half_width, 0.75 * half_width}; }

Case random_case(Randomness& random, bool capped) {
    constexpr Kind kCurved[]{Kind::ellipsoid, Kind::hill,       Kind::elliptic_cylinder,
                             Kind::cone,      Kind::two_sheets, Kind::paraboloid};
    const double size = random.log_between(0.5, 200), distance = random.log_between(1.5, 8) * size;
    const double half_width = random.between(0.2, 1.2);
    const glm::dvec3 eye = random.vector(100);
    const glm::dmat3 eye_from_scene = eye_from_scene_rotation(random.attitude());
    const glm::dvec3 ahead(random.between(-half_width, half_width), 1, random.between(-half_width, half_width));
    const Object object = random_object(random, kCurved[random.below(6)],
                                        eye + distance * (glm::transpose(eye_from_scene) * glm::normalize(ahead)), size,
                                        capped, random.below(7));
    return {object, {eye}, eye_from_scene, window_of(half_width)};
}

Object sphere_with_six_planes() {
    Object sphere;
    sphere.shape = Ellipsoid{{{0, 0, 6}}, {5, 5, 5}, {}};
    sphere.planes = {{{0.38, 0.50, -0.78, 8.84}},  {{0.95, 0.06, -0.30, 5.59}},   {{0.43, 0.90, 0.04, 3.75}},
                     {{-0.65, 0.65, -0.41, 6.64}}, {{-0.50, -0.46, -0.74, 8.86}}, {{0.70, 0.37, 0.61, 0.04}}};
    return sphere;
}

Case documented_case() {
    const Object sphere = sphere_with_six_planes();
    const glm::dmat3 eye_from_scene = eye_from_scene_rotation({{30}, {-20}, {0}});
    const double reach = std::tan(Degrees{15}.radians());
    const auto eye = eye_that_frames(make_solid(sphere), eye_from_scene, 0.8 * reach, 0.8 * reach);
    REQUIRE(eye);
    return {sphere, *eye, eye_from_scene, {-reach, reach, -reach, reach}};
}

Figure figure_of(const Case& given) {
    return make_figure(make_solid(given.object), given.eye, given.eye_from_scene, given.window);
}

double distance_from(const glm::dvec2& p, const std::vector<Polyline>& pieces) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Polyline& piece : pieces)
        for (std::size_t i = 1; i < piece.size(); ++i) {
            const glm::dvec2 along = piece[i] - piece[i - 1];
            const double length2 = glm::dot(along, along);
            const double t = length2 > 0 ? std::clamp(glm::dot(p - piece[i - 1], along) / length2, 0.0, 1.0) : 0.0;
            nearest = std::min(nearest, glm::distance(p, piece[i - 1] + t * along));
        }
    return nearest;
}

}  // namespace quadrig::test
