#include "ig_core/clusters/abutting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "ig_core/clusters/turn.h"

namespace quadrig::clusters {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostPairs = 4'000'000, kMostCompared = 400'000'000;

/// Distance between the axes less both reaches: below 0 where they overlap.
double gap(const CentredQuadric& a, const CentredQuadric& b) {
    const double dx = a.centre.x - b.centre.x, dy = a.centre.y - b.centre.y;
    return std::sqrt(dx * dx + dy * dy) - a.reach - b.reach;
}

struct Pair {
    double gap;
    std::size_t a, b;
};

/// Pairs that abut; absent where there are too many, or too many to compare. Objects are put into bands of Y as wide as
/// two can reach, in each of which they are swept along X.
std::optional<std::vector<Pair>> abutting_pairs(std::span<const Adjacent> objects) {
    double reach = 0.0;
    for (const Adjacent& object : objects) reach = std::max(reach, object.quadric.reach);
    if (!(reach > 0.0)) return std::vector<Pair>();
    std::map<double, std::vector<std::size_t>> bands;
    for (std::size_t i = 0; i < objects.size(); ++i)
        bands[std::floor(objects[i].quadric.centre.y / (2.0 * reach))].push_back(i);
    const auto x = [&](std::size_t i) { return objects[i].quadric.centre.x; };
    for (auto& [band, members] : bands)
        std::sort(members.begin(), members.end(),
                  [&](auto i, auto j) { return std::tuple(x(i), i) < std::tuple(x(j), j); });

    std::vector<Pair> pairs;
    std::size_t compared = 0;
    const auto consider = [&](std::size_t i, std::size_t j) {
        const auto [a, b] = std::minmax(i, j);
        const CentredQuadric &qa = objects[a].quadric, &qb = objects[b].quadric;
        if (abut(qa, qb)) pairs.push_back({gap(qa, qb), a, b});
        return ++compared <= kMostCompared && pairs.size() <= kMostPairs;
    };
    for (const auto& [band, members] : bands) {
        for (std::size_t m = 0; m < members.size(); ++m)
            for (std::size_t n = m + 1; n < members.size() && x(members[n]) - x(members[m]) <= 2.0 * reach; ++n)
                if (!consider(members[m], members[n])) return std::nullopt;
        const auto next = bands.find(band + 1.0);
        if (next == bands.end()) continue;
        std::size_t first = 0;
        for (const std::size_t i : members) {
            while (first < next->second.size() && x(next->second[first]) < x(i) - 2.0 * reach) ++first;
            for (std::size_t n = first; n < next->second.size() && x(next->second[n]) <= x(i) + 2.0 * reach; ++n)
                if (!consider(i, next->second[n])) return std::nullopt;
        }
    }
    return pairs;
}

}  // namespace

CentredQuadric centred(const Ellipsoid& ellipsoid, const glm::dvec3& axes, double size) {
    const glm::dvec3 a2 = axes * axes;
    const Sym3 own{1.0 / a2.x, 1.0 / a2.y, 1.0 / a2.z, 0, 0, 0};
    return {congruent(own, body_from_scene(ellipsoid.attitude)),
            ellipsoid.centre.metres,
            -size * size,
            kInfinity,
            kInfinity,
            size * std::max({axes.x, axes.y, axes.z})};
}

CentredQuadric centred(const Hill& hill, double base) {
    const double m2 = hill.slope * hill.slope, c = hill.radius_of_curvature * m2;
    const glm::dvec3& apex = hill.apex.metres;
    const double height = std::max(0.0, apex.z - base);
    // At its foot, Z = base: m^2 R^2 = (c + height)^2 - c^2.
    return {{m2, m2, -1.0, 0, 0, 0},
            {apex.x, apex.y, apex.z + c},
            c * c,
            apex.z + c,
            apex.z,
            std::sqrt(height * (height + 2.0 * c)) / hill.slope};
}

bool abut(const CentredQuadric& a, const CentredQuadric& b) {
    if (a.n != b.n || gap(a, b) >= 0.0) return false;
    const glm::dvec3 d = b.centre - a.centre;
    const double apart = value(a.n, d);
    if (a.lowest_sheet_below < kInfinity) {
        // Neither may reach into the other's upper sheet, where Q is negative again.
        return d.x * d.x + d.y * d.y > 0.0 && a.top < b.lowest_sheet_below && b.top < a.lowest_sheet_below;
    }
    const double size_a = std::sqrt(-a.k), size_b = std::sqrt(-b.k);
    const double sum = size_a + size_b, difference = size_a - size_b;
    return apart < sum * sum && apart > difference * difference;
}

BoundingPlane shared_plane(const CentredQuadric& a, const CentredQuadric& b) {
    // Q_b - Q_a = -2 N d.p + d' N (c_a + c_b) + k_b - k_a,  d = c_b - c_a.
    const glm::dvec3 d = b.centre - a.centre, nd = a.n * d;
    const double scale = 1.0 / std::sqrt(nd.x * nd.x + nd.y * nd.y + nd.z * nd.z);
    const double offset = 0.5 * (glm::dot(nd, a.centre + b.centre) + (b.k - a.k));
    // 0.0 - 0.0 is +0: a level or upright plane is written without a sign.
    return {{0.0 - nd.x * scale, 0.0 - nd.y * scale, 0.0 - nd.z * scale, offset * scale}};
}

bool cut_where_they_abut(std::span<Adjacent> objects, int most_neighbours) {
    std::optional<std::vector<Pair>> pairs = abutting_pairs(objects);
    if (!pairs) return false;
    std::sort(pairs->begin(), pairs->end(),
              [](const Pair& p, const Pair& q) { return std::tuple(p.gap, p.a, p.b) < std::tuple(q.gap, q.a, q.b); });
    std::vector<int> neighbours(objects.size(), 0);
    const auto has_room = [&](std::size_t i) {
        return neighbours[i] < most_neighbours && objects[i].object->planes.size() < std::size_t{kMaxPlanes};
    };
    for (const Pair& pair : *pairs) {
        if (!has_room(pair.a) || !has_room(pair.b)) continue;
        const BoundingPlane keeps_a = shared_plane(objects[pair.a].quadric, objects[pair.b].quadric);
        const auto& p = keeps_a.coefficients;
        objects[pair.a].object->planes.push_back(keeps_a);
        objects[pair.b].object->planes.push_back({{0.0 - p[0], 0.0 - p[1], 0.0 - p[2], 0.0 - p[3]}});
        ++neighbours[pair.a];
        ++neighbours[pair.b];
    }
    return true;
}

}  // namespace quadrig::clusters
