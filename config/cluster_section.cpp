#include "config/cluster_section.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "config/object_section.h"
#include "ig_core/clusters/generate.h"

namespace quadrig::config {
namespace {

using clusters::Cluster;
using clusters::Region;
using clusters::Template;
using clusters::Variation;

constexpr std::size_t kMostClusters = 1000;
constexpr std::size_t kMostCorners = 10'000;
constexpr int kMostLevels = 8;

constexpr NumberRule kSeed{"a whole number in 0..9007199254740991",
                           [](double x) { return x >= 0.0 && x <= 0x1p53 - 1.0 && std::floor(x) == x; }};
constexpr NumberRule kCount{"a whole number in 1..1000000",
                            [](double x) { return x >= 1.0 && x <= 1e6 && std::floor(x) == x; }};
constexpr NumberRule kNeighbours{"a whole number in 0..16",
                                 [](double x) { return x >= 0.0 && x <= kMaxPlanes && std::floor(x) == x; }};
constexpr NumberRule kSpacing{"metres in 1e-3..1e9", [](double x) { return x >= 1e-3 && x <= 1e9; }};
constexpr NumberRule kWidth{"metres in 0..1e9", [](double x) { return x >= 0.0 && x <= 1e9; }};
constexpr NumberRule kShare{"a share in 0..0.9", [](double x) { return x >= 0.0 && x <= 0.9; }};
constexpr NumberRule kSpread{"degrees in 0..360", [](double x) { return x >= 0.0 && x <= 360.0; }};

std::vector<glm::dvec2> read_points(const TomlSection& section, std::string_view name, std::size_t least) {
    std::vector<glm::dvec2> points;
    for (const auto& row : section.rows(name, kCoordinate, 2, kMostCorners)) points.emplace_back(row[0], row[1]);
    if (points.size() < least) {
        section.refuse(name, "at least " + std::to_string(least) + " points [X, Y]",
                       "an array of " + std::to_string(points.size()));
    }
    return points;
}

Region read_region(const TomlSection& section) {
    const int kinds = int{section.has("rectangle")} + int{section.has("ellipse")} + int{section.has("polygon")} +
                      int{section.has("path")};
    if (kinds != 1) {
        section.refuse(std::string("expected one of rectangle, ellipse, polygon, path, found ") +
                       (kinds == 0 ? "none" : "more"));
    }
    if (section.has("width") && !section.has("path")) section.refuse("width", "a path beside it", "none");
    if (section.has("rectangle")) {
        const auto sides = section.numbers("rectangle", kCoordinate, 4, 4);
        if (sides[0] > sides[2] || sides[1] > sides[3])
            section.refuse("rectangle", "[west, south, east, north]", "west beyond east or south beyond north");
        return clusters::Rectangle{{sides[0], sides[1]}, {sides[2], sides[3]}};
    }
    if (const auto ellipse = section.optional_table("ellipse", {"centre", "semi_axes"}))
        return clusters::Ellipse{ellipse->pair("centre", kCoordinate), ellipse->pair("semi_axes", kLength)};
    if (section.has("polygon")) return clusters::Polygon{read_points(section, "polygon", 3)};
    return clusters::Path{read_points(section, "path", 2), section.number_or("width", kWidth, 0.0)};
}

Variation read_variation(const TomlSection& section) {
    Variation variation;
    variation.position = section.number_or("position", kFraction, 0.0);
    variation.size = section.number_or("size", kShare, 0.0);
    variation.shape = section.number_or("shape", kShare, 0.0);
    variation.colour = section.number_or("colour", kFraction, 0.0);
    variation.altitude = section.number_or("altitude", kWidth, 0.0);
    if (section.has("attitude")) variation.attitude = section.triple("attitude", kSpread);
    return variation;
}

/// Planes move with their object, and have to stay within what a scene file may hold.
void refuse_extreme_planes(const TomlSection& section, const std::vector<BoundingPlane>& planes) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const auto& b = planes[i].coefficients;
        const double largest = std::max({std::abs(b[0]), std::abs(b[1]), std::abs(b[2])});
        if (largest < 1e-9 || largest > 1e9 || std::abs(b[3]) > 1e18)
            section.refuse("planes", i, "in a template, B1..B3 of 1e-9..1e9 and B4 within 1e18", "others");
    }
}

/// Clusters read so far, by name, and how deep each is made of others.
struct Earlier {
    std::unordered_map<std::string, std::size_t> indices;
    std::vector<int> levels;
};

Template read_template(const TomlSection& section, Textures& textures, const Earlier& earlier, int& levels) {
    Template result;
    result.weight = section.number_or("weight", kPositive, result.weight);
    if (const auto name = section.optional_text("cluster")) {
        for (const std::string_view other :
             {"ellipsoid", "hill", "planes", "colour", "texture", "texture_weight", "translucence", "motion"})
            if (section.has(other)) section.refuse(other, "a shape or a cluster", "both");
        const auto found = earlier.indices.find(*name);
        if (found == earlier.indices.end())
            section.refuse("cluster", "the name of a cluster before this one", "\"" + *name + "\"");
        levels = std::max(levels, earlier.levels[found->second] + 1);
        if (levels > kMostLevels) section.refuse("cluster", "at most 8 levels of clusters", "more");
        result.what = found->second;
    } else {
        Object object = read_object(section, textures);
        refuse_extreme_planes(section, object.planes);
        result.what = std::move(object);
    }
    return result;
}

bool has_ellipsoid(const Template& each) {
    const auto* object = std::get_if<Object>(&each.what);
    return object != nullptr && std::holds_alternative<Ellipsoid>(object->shape);
}

/// What cannot go together.
void refuse_contradictions(const TomlSection& section, const Cluster& cluster) {
    const auto any = [&](auto holds) { return std::any_of(cluster.templates.begin(), cluster.templates.end(), holds); };
    if (cluster.terrain && any(has_ellipsoid)) section.refuse("terrain", "hills as templates", "an ellipsoid");
    if (cluster.abutting == 0) return;
    // Objects share a plane only where their shapes are equal.
    if (cluster.variation.shape != 0.0) section.refuse("abutting", "no variation of shape beside it", "one");
    if (any(has_ellipsoid) && cluster.variation.attitude != glm::dvec3(0.0))
        section.refuse("abutting", "no variation of attitude beside it", "one");
}

Cluster read_cluster(const TomlSection& section, Textures& textures, Earlier& earlier) {
    Cluster cluster;
    cluster.name = section.text("name");
    cluster.seed = static_cast<std::uint64_t>(section.number_or("seed", kSeed, 0.0));
    cluster.region = read_region(section.table("region", {"rectangle", "ellipse", "polygon", "path", "width"}));
    cluster.spacing = section.number("spacing", kSpacing);
    if (section.has("count")) cluster.count = static_cast<std::size_t>(section.number("count", kCount));
    if (const auto variation =
            section.optional_table("variation", {"position", "size", "shape", "colour", "altitude", "attitude"}))
        cluster.variation = read_variation(*variation);
    cluster.terrain = section.flag_or("terrain", false);
    cluster.abutting = static_cast<int>(section.number_or("abutting", kNeighbours, 0.0));
    if (section.has("altitude")) cluster.altitude = section.number("altitude", kCoordinate);
    if (section.has("elevation")) {
        cluster.elevation = section.pair("elevation", kCoordinate);
        if (cluster.elevation->x > cluster.elevation->y)
            section.refuse("elevation", "[lowest, highest]", "the lowest above the highest");
    }
    int levels = 1;
    for (const auto& each : section.tables("template", {"weight", "cluster", "ellipsoid", "hill", "planes", "colour",
                                                        "texture", "texture_weight", "translucence", "motion"}))
        cluster.templates.push_back(read_template(each, textures, earlier, levels));
    if (cluster.templates.empty()) section.refuse("expected at least one [[cluster.template]], found none");
    refuse_contradictions(section, cluster);
    earlier.levels.push_back(levels);
    return cluster;
}

}  // namespace

void add_clusters(const TomlSection& document, Textures& textures, Names& names, Scene& scene) {
    const auto sections = document.tables("cluster", {"name", "seed", "region", "spacing", "count", "variation",
                                                      "terrain", "abutting", "altitude", "elevation", "template"});
    if (sections.size() > kMostClusters) sections[kMostClusters].refuse("expected at most 1000 clusters, found more");
    Earlier earlier;
    Names cluster_names;
    std::vector<Cluster> read;
    for (const TomlSection& section : sections) {
        read.push_back(read_cluster(section, textures, earlier));
        take_name(section, read.back().name, cluster_names);
        earlier.indices.emplace(read.back().name, read.size() - 1);
    }
    std::vector<Object> grown;
    try {
        grown = clusters::generate(read, scene.objects);
    } catch (const clusters::TooMany& error) {
        sections[error.cluster].refuse(std::string("expected fewer, found ") + error.what());
    }
    for (const Object& object : grown) {
        const auto [first, is_new] = names.try_emplace(object.name, "a cluster");
        if (is_new) continue;
        document.refuse("expected names that clusters do not give, found \"" + object.name + "\", which " +
                        first->second + " has");
    }
    scene.objects.insert(scene.objects.end(), std::make_move_iterator(grown.begin()),
                         std::make_move_iterator(grown.end()));
}

}  // namespace quadrig::config
