#include "ig_core/reference/seen_scene.h"

namespace quadrig::reference {

SeenScene::SeenScene(const Scene& s, const View& v) : scene(s), view(v) {
    for (const Object& object : scene.objects) {
        exact.push_back(solid_about_eye(object, view.eye));
        values.push_back(rounded<long double>(exact.back()));
        triage.push_back(rounded<double>(exact.back()));
        spheres.push_back(bounding_sphere(exact.back()));
    }
}

Vector<double> SeenScene::direction(double column, double row) const {
    const auto d = ray_direction<long double>(view, column, row);
    return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
}

}  // namespace quadrig::reference
