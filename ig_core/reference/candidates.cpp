#include "ig_core/reference/candidates.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <glm/geometric.hpp>
#include <limits>
#include <thread>

namespace quadrig::reference {
namespace {

constexpr int kTileSize = 16;
constexpr double kMargin = 1e-6;

/// weight Q added to a sum of quadratic forms.
void add(Quadric<Quad>& sum, const Quadric<Quad>& q, Quad weight) {
    for (std::size_t i = 0; i < 6; ++i) sum.m[i] += weight * q.m[i];
    for (std::size_t i = 0; i < 3; ++i) sum.v[i] += weight * q.v[i];
    sum.s += weight * q.s;
}

/// Sum of -P_i P_j over the pairs of planes that face each other, normals brought to length 1.
Quadric<Quad> facing_planes(std::vector<HalfSpace<Quad>> planes) {
    for (auto& plane : planes) {
        const Quad size = square_root(dot(plane.normal, plane.normal));
        if (size == 0) continue;
        for (Quad& component : plane.normal) component /= size;
        plane.offset /= size;
    }
    Quadric<Quad> sum;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        for (std::size_t j = i + 1; j < planes.size(); ++j) {
            const auto& [n, b, first] = planes[i];
            const auto& [l, c, second] = planes[j];
            if (dot(n, l) >= 0) continue;
            Quadric<Quad> product{{n[0] * l[0], n[1] * l[1], n[2] * l[2], (n[0] * l[1] + n[1] * l[0]) / 2,
                                   (n[1] * l[2] + n[2] * l[1]) / 2, (n[0] * l[2] + n[2] * l[0]) / 2},
                                  {},
                                  b * c};
            for (std::size_t k = 0; k < 3; ++k) product.v[k] = (b * l[k] + c * n[k]) / 2;
            add(sum, product, -1);
        }
    }
    return sum;
}

/// The sphere about {q <= 0} if that is an ellipsoid: radius^2 = -q(centre) trace(M^-1).
BoundingSphere sphere_about(const Quadric<Quad>& q) {
    const BoundingSphere unbounded{{}, std::numeric_limits<double>::infinity()};
    const auto& [xx, yy, zz, xy, yz, xz] = q.m;
    const Quad size = magnitude(xx) + magnitude(yy) + magnitude(zz);
    const std::array<Quad, 6> adjugate{yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                                       yz * xz - xy * zz, xy * xz - xx * yz, xy * yz - yy * xz};
    const Quad determinant = xx * adjugate[0] + xy * adjugate[3] + xz * adjugate[5];
    const Quad rounding = 1e-20 * size * size * size;
    const bool positive_definite = xx > 0 && adjugate[2] > 0 && determinant > rounding;
    if (!positive_definite) return unbounded;

    Vector<Quad> centre = times(adjugate, q.v);
    for (Quad& component : centre) component /= -determinant;
    const Quad depth = std::max(Quad(0), -(q.s + dot(q.v, centre)));
    const Quad trace_of_inverse = (adjugate[0] + adjugate[1] + adjugate[2]) / determinant;
    const glm::dvec3 middle(static_cast<double>(centre[0]), static_cast<double>(centre[1]),
                            static_cast<double>(centre[2]));
    const auto radius = static_cast<double>(square_root(depth * trace_of_inverse));
    return {middle, radius * (1 + kMargin) + kMargin * glm::length(middle)};
}

/// The cone about a block of pixels: every ray through it lies within `half_angle` of the axis.
struct Cone {
    glm::dvec3 axis;
    double half_angle = 0.0;
};

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

glm::dvec3 direction_at(const View& view, double column, double row) {
    const auto d = ray_direction<long double>(view, column, row);
    return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
}

Cone cone_about(const View& view, const Tile& tile) {
    Cone cone{direction_at(view, 0.5 * (tile.first_column + tile.end_column), 0.5 * (tile.first_row + tile.end_row)),
              0.0};
    for (const int column : {tile.first_column, tile.end_column})
        for (const int row : {tile.first_row, tile.end_row})
            cone.half_angle = std::max(cone.half_angle, angle_between(cone.axis, direction_at(view, column, row)));
    return cone;
}

bool may_meet(const BoundingSphere& sphere, const Cone& cone) {
    const double distance = glm::length(sphere.centre);
    if (distance <= sphere.radius) return true;
    const double reach = std::asin(sphere.radius / distance);
    return angle_between(cone.axis, sphere.centre) <= cone.half_angle + reach + kMargin;
}

}  // namespace

BoundingSphere bounding_sphere(const Solid<Quad>& solid) {
    const Quadric<Quad> planes = facing_planes(solid.half_spaces);
    BoundingSphere best = sphere_about(planes);
    if (solid.quadric.m_scale == 0) return best;
    for (const double weight : {0.0, 0.5, 2.0, 8.0}) {
        Quadric<Quad> sum;
        add(sum, solid.quadric, 1 / Quad(solid.quadric.m_scale));
        add(sum, planes, weight);
        const BoundingSphere sphere = sphere_about(sum);
        if (sphere.radius < best.radius) best = sphere;
    }
    return best;
}

bool may_meet(const BoundingSphere& sphere, const glm::dvec3& direction) {
    const double distance_squared = glm::dot(sphere.centre, sphere.centre);
    const double radius_squared = sphere.radius * sphere.radius;
    if (distance_squared <= radius_squared) return true;
    if (glm::dot(sphere.centre, direction) < 0) return false;
    const glm::dvec3 moment = glm::cross(sphere.centre, direction);
    return glm::dot(moment, moment) <= radius_squared * glm::dot(direction, direction);
}

void for_each_tile(const View& view, const std::vector<BoundingSphere>& spheres,
                   const std::function<void(const Tile&)>& draw) {
    const int across = (view.image.width + kTileSize - 1) / kTileSize;
    const int down = (view.image.height + kTileSize - 1) / kTileSize;
    std::atomic<int> next{0};
    const auto work = [&] {
        Tile tile;
        for (int i = next++; i < across * down; i = next++) {
            tile.first_column = i % across * kTileSize;
            tile.first_row = i / across * kTileSize;
            tile.end_column = std::min(tile.first_column + kTileSize, view.image.width);
            tile.end_row = std::min(tile.first_row + kTileSize, view.image.height);
            const Cone cone = cone_about(view, tile);
            tile.candidates.clear();
            for (std::uint32_t object = 0; object < spheres.size(); ++object)
                if (may_meet(spheres[object], cone)) tile.candidates.push_back(object);
            draw(tile);
        }
    };
    std::vector<std::future<void>> others;
    for (unsigned thread = 1; thread < std::thread::hardware_concurrency(); ++thread)
        others.push_back(std::async(std::launch::async, work));
    work();
    for (auto& other : others) other.get();
}

}  // namespace quadrig::reference
