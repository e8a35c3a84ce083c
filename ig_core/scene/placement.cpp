#include "ig_core/scene/placement.h"

#include <glm/geometric.hpp>

namespace quadrig {
namespace {

using Long = long double;

/// Q(p) = p' M p + 2 v.p + s about the model's origin becomes Q(R (p - t)): M' = R' M R, v' = R' v - M' t,
/// s' = s - 2 v.R t + t' M' t.
GeneralQuadric placed(const GeneralQuadric& quadric, const ScenePose& pose) {
    const auto& q = quadric.coefficients;
    const Long m[3][3] = {
        {q[0], q[3] / 2.0L, q[5] / 2.0L}, {q[3] / 2.0L, q[1], q[4] / 2.0L}, {q[5] / 2.0L, q[4] / 2.0L, q[2]}};
    const Long v[3] = {q[6] / 2.0L, q[7] / 2.0L, q[8] / 2.0L};
    const auto r = [&](int row, int column) { return static_cast<Long>(pose.eye_from_scene[column][row]); };
    Long rotated[3][3] = {}, turned[3] = {};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b) rotated[i][k] += r(a, i) * m[a][b] * r(b, k);
            turned[i] += r(k, i) * v[k];
        }
    const Long t[3] = {pose.position.metres.x, pose.position.metres.y, pose.position.metres.z};
    Long linear[3] = {}, constant = q[9];
    for (int i = 0; i < 3; ++i) {
        linear[i] = turned[i];
        for (int k = 0; k < 3; ++k) {
            linear[i] -= rotated[i][k] * t[k];
            constant += t[i] * rotated[i][k] * t[k];
        }
        constant -= 2.0L * turned[i] * t[i];
    }
    const auto d = [](Long x) { return static_cast<double>(x); };
    return {{d(rotated[0][0]), d(rotated[1][1]), d(rotated[2][2]), d(2 * rotated[0][1]), d(2 * rotated[1][2]),
             d(2 * rotated[0][2]), d(2 * linear[0]), d(2 * linear[1]), d(2 * linear[2]), d(constant)}};
}

}  // namespace

std::optional<Object> placed(const Object& object, const ScenePose& pose) {
    const glm::dmat3 scene_from_model = glm::transpose(pose.eye_from_scene);
    Object result = object;
    if (auto* ellipsoid = std::get_if<Ellipsoid>(&result.shape)) {
        ellipsoid->centre = place_on(pose, ellipsoid->centre.metres);
        ellipsoid->attitude = attitude_of(eye_from_scene_rotation(ellipsoid->attitude) * pose.eye_from_scene);
    } else if (auto* quadric = std::get_if<GeneralQuadric>(&result.shape)) {
        *quadric = placed(*quadric, pose);
    } else {
        return std::nullopt;
    }
    for (BoundingPlane& plane : result.planes) {
        auto& b = plane.coefficients;
        const glm::dvec3 normal = scene_from_model * glm::dvec3(b[0], b[1], b[2]);
        b = {normal.x, normal.y, normal.z, b[3] - glm::dot(normal, pose.position.metres)};
    }
    return result;
}

}  // namespace quadrig
