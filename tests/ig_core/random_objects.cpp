#include "tests/ig_core/random_objects.h"

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace quadrig::test {
namespace {

/// xx x^2 + yy y^2 + zz z^2 + z z + one in the solid's own axes, and which of its half-spaces z < 0 picks a sheet.
struct LocalForm {
    double xx, yy, zz, z, one;
    bool lower_half = false;
};

LocalForm local_form(Randomness& random, Kind kind, double size) {
    const double a = size * random.log_between(0.2, 1), b = size * random.log_between(0.2, 1);
    const double xx = 1 / (a * a), yy = 1 / (b * b), c = size * random.log_between(0.05, 1), zz = 1 / (c * c);
    switch (kind) {
        case Kind::elliptic_cylinder:
            return {xx, yy, 0, 0, -1};
        case Kind::cone:
            return {xx, yy, -zz, 0, 0, true};
        case Kind::two_sheets:
            return {xx, yy, -zz, 0, 1, true};
        case Kind::paraboloid:
            return {xx, yy, 0, 1 / c, 0};
        case Kind::parabolic_cylinder:
            return {xx, 0, 0, 1 / c, 0};
        case Kind::hyperbolic_cylinder:
            return {xx, 0, -zz, 0, 1, true};
        case Kind::slab:
            return {xx, 0, 0, 0, -1};
        case Kind::wedge:
            return {xx, 0, -zz, 0, 0, true};
        case Kind::half_space:
            return {0, 0, 0, 1, -c};
        default:
            return {0, 0, 0, 0, -1};
    }
}

BoundingPlane plane_through(const glm::dvec3& point, const glm::dvec3& normal) {
    return {{normal.x, normal.y, normal.z, -glm::dot(normal, point)}};
}

GeneralQuadric expand(const LocalForm& f, const glm::dmat3& axes, const glm::dvec3& centre) {
    using Real3 = glm::tvec3<long double>;
    const Real3 x(axes[0]), y(axes[1]), z(axes[2]), o(centre);
    const long double at_x = glm::dot(x, o), at_y = glm::dot(y, o), at_z = glm::dot(z, o);
    const auto entry = [&](int i, int j) { return f.xx * x[i] * x[j] + f.yy * y[i] * y[j] + f.zz * z[i] * z[j]; };
    const Real3 linear =
        -2.0L * (f.xx * at_x * x + f.yy * at_y * y + f.zz * at_z * z) + static_cast<long double>(f.z) * z;
    const long double one = f.xx * at_x * at_x + f.yy * at_y * at_y + f.zz * at_z * at_z - f.z * at_z + f.one;
    const auto d = [](long double value) { return static_cast<double>(value); };
    return {{d(entry(0, 0)), d(entry(1, 1)), d(entry(2, 2)), d(2 * entry(0, 1)), d(2 * entry(1, 2)), d(2 * entry(0, 2)),
             d(linear.x), d(linear.y), d(linear.z), d(one)}};
}

}  // namespace

Object random_object(Randomness& random, Kind kind, const glm::dvec3& centre, double size, bool capped, int planes) {
    Object object;
    if (kind == Kind::ellipsoid) {
        const auto axis = [&] { return size * random.log_between(0.1, 1); };
        object.shape = Ellipsoid{{centre}, {axis(), axis(), axis()}, random.attitude()};
    } else if (kind == Kind::hill) {
        const double slope = random.log_between(0.1, 3);
        object.shape = Hill{{centre}, size * random.log_between(0.05, 1), slope};
        if (capped) object.planes.push_back({{0, 0, 1, -(centre.z - size * random.between(0.2, 1))}});
    } else {
        const glm::dmat3 axes =
            capped
                ? glm::transpose(eye_from_scene_rotation(random.attitude()))
                : std::array{glm::dmat3{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, glm::dmat3{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                             glm::dmat3{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}[static_cast<std::size_t>(random.below(3))];
        LocalForm form = local_form(random, kind, size);
        // What coefficients far from the origin round to one sheet would not be convex.
        if (form.lower_half)
            form.one = std::max<double>(form.one, 1e-14 * (form.xx + form.yy - form.zz) * glm::dot(centre, centre));
        object.shape = expand(form, axes, centre);
        const auto cut = [&](const glm::dvec3& normal, double distance) {
            object.planes.push_back(plane_through(centre - distance * normal, normal));
        };
        if (form.lower_half) cut(-axes[2], 0);
        if (capped) {
            if (kind != Kind::elliptic_cylinder || random.chance(0.9)) cut(axes[2], size * random.between(0.3, 1));
            if (!form.lower_half) cut(-axes[2], size * random.between(0.3, 1));
            if (form.yy == 0) {
                cut(axes[1], size * random.between(0.3, 1));
                cut(-axes[1], size * random.between(0.3, 1));
            }
            if (form.xx == 0) {
                cut(axes[0], size * random.between(0.3, 1));
                cut(-axes[0], size * random.between(0.3, 1));
            }
        }
    }
    for (int i = 0; i < planes && object.planes.size() < kMaxPlanes; ++i) {
        const glm::dvec3 normal =
            random.chance(0.2) ? glm::dvec3(0, 0, random.chance(0.5) ? 1 : -1) : random.direction();
        const double scale = random.chance(0.5) ? 1.0 : random.log_between(0.01, 100);
        glm::dvec3 through = centre - random.between(0.05, 0.9) * size * normal;
        if (kind == Kind::hill) through.z -= 0.5 * size;
        object.planes.push_back(plane_through(through, scale * normal));
    }
    return object;
}

Kind random_kind(Randomness& random) {
    return random.chance(0.5) ? static_cast<Kind>(random.below(2)) : static_cast<Kind>(random.below(kKinds));
}

Object random_object(Randomness& random, Kind kind, const glm::dvec3& centre, double size) {
    const int planes = random.chance(0.3) ? 0 : random.chance(0.1) ? random.below(kMaxPlanes + 1) : random.below(6);
    return random_object(random, kind, centre, size, random.chance(0.9), planes);
}

Object cut_ball(double distance) {
    Object ball;
    ball.shape = Ellipsoid{{{0, 10, 0}}, {1, 1, 1}, {}};
    for (const double side : {1.0, -1.0}) {
        ball.planes.push_back({{side, 0, 0, distance}});
        ball.planes.push_back({{0, side, 0, distance - 10 * side}});
        ball.planes.push_back({{0, 0, side, distance}});
    }
    return ball;
}

}  // namespace quadrig::test
