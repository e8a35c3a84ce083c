#include "ig_core/clusters/places.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ig_core/clusters/dice.h"

namespace quadrig::clusters {
namespace {

constexpr double kRowHeight = 0.8660254037844386;  // sqrt(3)/2

struct Candidate {
    Place place;
    std::uint64_t rank = 0;  ///< the lowest are kept where there are more than wanted
};

/// Length as sqrt of a sum: std::hypot is not the same everywhere.
double length(const glm::dvec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

bool inside_polygon(const std::vector<glm::dvec2>& corners, const glm::dvec2& p) {
    bool in = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const glm::dvec2 &a = corners[i], &b = corners[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
    return in;
}

struct InsideOf {
    const glm::dvec2& p;
    bool operator()(const Rectangle& r) const {
        return p.x >= r.low.x && p.x <= r.high.x && p.y >= r.low.y && p.y <= r.high.y;
    }
    bool operator()(const Ellipse& e) const {
        const glm::dvec2 q = (p - e.centre) / e.semi_axes;
        return q.x * q.x + q.y * q.y <= 1.0;
    }
    bool operator()(const Polygon& polygon) const { return inside_polygon(polygon.corners, p); }
    bool operator()(const Path&) const { return true; }
};

struct Box {
    Rectangle operator()(const Rectangle& r) const { return r; }
    Rectangle operator()(const Ellipse& e) const { return {e.centre - e.semi_axes, e.centre + e.semi_axes}; }
    Rectangle operator()(const Polygon& polygon) const { return about(polygon.corners); }
    Rectangle operator()(const Path& path) const { return about(path.points); }
    static Rectangle about(const std::vector<glm::dvec2>& points) {
        Rectangle box{points.front(), points.front()};
        for (const glm::dvec2& p : points) box = {glm::min(box.low, p), glm::max(box.high, p)};
        return box;
    }
};

double length_of(const Path& path) {
    double sum = 0.0;
    for (std::size_t i = 1; i < path.points.size(); ++i) sum += length(path.points[i] - path.points[i - 1]);
    return sum;
}

/// A point of the path at a distance from its start, and the unit vector to the right of it there.
std::pair<glm::dvec2, glm::dvec2> station(const Path& path, double along) {
    glm::dvec2 right(0.0, 0.0), at = path.points.front();
    for (std::size_t i = 1; i < path.points.size(); ++i) {
        const glm::dvec2 step = path.points[i] - path.points[i - 1];
        const double size = length(step);
        if (size == 0.0) continue;
        right = {step.y / size, -step.x / size};
        at = path.points[i - 1] + step * (std::min(along, size) / size);
        if (along <= size) break;
        along -= size;
    }
    return {at, right};
}

template <class Take>
void along_path(const Path& path, const Cluster& cluster, std::uint64_t seed, Take&& take) {
    const double stray = cluster.variation.position * cluster.spacing, whole = length_of(path);
    const auto stations = static_cast<std::int64_t>(whole / cluster.spacing);
    const auto rows = static_cast<std::int64_t>(path.width / cluster.spacing);
    for (std::int64_t i = 0; i <= stations; ++i) {
        for (std::int64_t j = 0; j <= rows; ++j) {
            Dice dice(seed_of_part(seed_of_part(seed, j), i));
            const double along = dice.about(static_cast<double>(i) * cluster.spacing, stray);
            const double row = static_cast<double>(j) - 0.5 * static_cast<double>(rows);
            const double across = dice.about(row * cluster.spacing, stray);
            const auto [at, right] = station(path, std::clamp(along, 0.0, whole));
            take(at + right * across, dice);
        }
    }
}

template <class Take>
void over_lattice(const Rectangle& box, const Cluster& cluster, std::uint64_t seed, Take&& take) {
    const double d = cluster.spacing, row_height = d * kRowHeight, stray = cluster.variation.position * d;
    const auto first_row = static_cast<std::int64_t>(std::floor((box.low.y - stray) / row_height));
    const auto last_row = static_cast<std::int64_t>(std::ceil((box.high.y + stray) / row_height));
    for (std::int64_t j = first_row; j <= last_row; ++j) {
        const double indent = j % 2 == 0 ? 0.0 : 0.5;
        const auto first = static_cast<std::int64_t>(std::floor((box.low.x - stray) / d - indent));
        const auto last = static_cast<std::int64_t>(std::ceil((box.high.x + stray) / d - indent));
        for (std::int64_t i = first; i <= last; ++i) {
            Dice dice(seed_of_part(seed_of_part(seed, j), i));
            const double x = dice.about((static_cast<double>(i) + indent) * d, stray);
            const double y = dice.about(static_cast<double>(j) * row_height, stray);
            take(glm::dvec2(x, y), dice);
        }
    }
}

/// Those of the lowest ranks, in the order they had.
void keep_lowest(std::vector<Candidate>& candidates, std::size_t count) {
    if (candidates.size() <= count) return;
    std::vector<std::pair<std::uint64_t, std::size_t>> ranks;
    for (std::size_t i = 0; i < candidates.size(); ++i) ranks.emplace_back(candidates[i].rank, i);
    std::sort(ranks.begin(), ranks.end());
    ranks.resize(count);
    std::sort(ranks.begin(), ranks.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    std::vector<Candidate> kept;
    for (const auto& [rank, i] : ranks) kept.push_back(candidates[i]);
    candidates = std::move(kept);
}

}  // namespace

bool inside(const Region& region, const glm::dvec2& point) { return std::visit(InsideOf{point}, region); }

double places_to_search(const Cluster& cluster) {
    if (const Path* path = std::get_if<Path>(&cluster.region))
        return (length_of(*path) / cluster.spacing + 1.0) * (path->width / cluster.spacing + 1.0);
    const Rectangle box = std::visit(Box{}, cluster.region);
    const glm::dvec2 cells = (box.high - box.low) / cluster.spacing;
    return (cells.x + 5.0) * (cells.y / kRowHeight + 5.0);
}

std::vector<Place> places(const Cluster& cluster, std::uint64_t seed, const glm::dvec2& origin,
                          const std::function<bool(const glm::dvec2&)>& suits) {
    std::vector<Candidate> candidates;
    const auto take = [&](const glm::dvec2& p, Dice& dice) {
        const std::uint64_t rank = dice.next(), own_seed = dice.next();
        if (!inside(cluster.region, p) || !suits(origin + p)) return;
        candidates.push_back({{origin + p, own_seed}, rank});
    };
    if (const Path* path = std::get_if<Path>(&cluster.region))
        along_path(*path, cluster, seed, take);
    else
        over_lattice(std::visit(Box{}, cluster.region), cluster, seed, take);
    if (cluster.count) keep_lowest(candidates, *cluster.count);
    std::vector<Place> result;
    result.reserve(candidates.size());
    for (const Candidate& candidate : candidates) result.push_back(candidate.place);
    return result;
}

}  // namespace quadrig::clusters
