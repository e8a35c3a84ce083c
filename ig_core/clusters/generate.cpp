#include "ig_core/clusters/generate.h"

#include <algorithm>
#include <map>
#include <optional>

#include "ig_core/clusters/abutting.h"
#include "ig_core/clusters/dice.h"
#include "ig_core/clusters/grown_object.h"
#include "ig_core/clusters/places.h"
#include "ig_core/clusters/terrain.h"

namespace quadrig::clusters {
namespace {

/// Objects of one cluster, wherever others placed it.
using Crop = std::vector<GrownObject>;

class Growth {
  public:
    Growth(std::span<const Cluster> clusters, std::span<const Object> written)
        : clusters_(clusters), named_(clusters.size(), 0) {
        for (const Object& object : written) terrain_.add(object);
    }

    void grow(std::size_t root) {
        std::map<std::size_t, Crop> crops;
        grow_at(root, {clusters_[root].seed, {0.0, 0.0}, std::nullopt, clusters_[root].terrain}, crops);
        for (auto& [index, crop] : crops) {
            const Cluster& cluster = clusters_[index];
            if (cluster.abutting > 0 && !cut(crop, cluster.abutting))
                throw TooMany(
                    index, "more than 4000000 pairs of objects that overlap, or 400000000 that are near one another");
            for (GrownObject& grown : crop) {
                grown.object.name = cluster.name + "-" + std::to_string(++named_[index]);
                if (clusters_[root].terrain) terrain_.add(grown.object);
                objects_.push_back(std::move(grown.object));
            }
        }
    }

    std::vector<Object> take() { return std::move(objects_); }

  private:
    /// What the cluster that places another hands down to it.
    struct Inherited {
        std::uint64_t seed;
        glm::dvec2 origin;
        std::optional<double> altitude;
        bool terrain;
    };

    static bool cut(Crop& crop, int most_neighbours) {
        std::vector<Adjacent> adjacent;
        for (GrownObject& grown : crop) adjacent.push_back({&grown.object, grown.quadric});
        return cut_where_they_abut(adjacent, most_neighbours);
    }

    void grow_at(std::size_t index, const Inherited& from, std::map<std::size_t, Crop>& crops) {
        const Cluster& cluster = clusters_[index];
        tried_ += places_to_search(cluster);
        if (!(tried_ <= kMostPlacesTried)) throw TooMany(index, "more than 16000000 places to try");
        const auto suits = [&](const glm::dvec2& p) {
            if (!cluster.elevation) return true;
            const double height = terrain_.height(p);
            return height >= cluster.elevation->x && height <= cluster.elevation->y;
        };
        for (const Place& place : places(cluster, from.seed, from.origin, suits)) {
            Dice dice(place.seed);
            const Template& chosen = choose(cluster.templates, dice);
            const Perturbation change = perturbation(cluster.variation, dice);
            std::optional<double> altitude = cluster.altitude ? cluster.altitude : from.altitude;
            if (!altitude && from.terrain) altitude = 0.0;
            if (const auto* placed = std::get_if<std::size_t>(&chosen.what)) {
                if (altitude) altitude = *altitude + change.altitude;
                grow_at(*placed,
                        {seed_of_part(place.seed, 1) ^ clusters_[*placed].seed, place.position, altitude, from.terrain},
                        crops);
                continue;
            }
            if (++grown_ > kMostObjects) throw TooMany(index, "more than 1000000 objects");
            const double base = altitude ? *altitude : terrain_.height(place.position);
            const glm::dvec3 foot(place.position.x, place.position.y, base + change.altitude);
            crops[index].push_back(grown_object(std::get<Object>(chosen.what), foot, change));
        }
    }

    static const Template& choose(const std::vector<Template>& templates, Dice& dice) {
        double sum = 0.0;
        for (const Template& each : templates) sum += each.weight;
        double rest = sum * dice.fraction();
        for (const Template& each : templates) {
            if (rest < each.weight) return each;
            rest -= each.weight;
        }
        return templates.back();
    }

    std::span<const Cluster> clusters_;
    std::vector<std::size_t> named_;  ///< objects that bear a cluster's name so far
    Terrain terrain_;
    std::vector<Object> objects_;
    double tried_ = 0.0;
    std::size_t grown_ = 0;
};

}  // namespace

bool is_placed(std::span<const Cluster> clusters, std::size_t index) {
    return std::any_of(clusters.begin(), clusters.end(), [&](const Cluster& cluster) {
        return std::any_of(cluster.templates.begin(), cluster.templates.end(), [&](const Template& each) {
            const auto* placed = std::get_if<std::size_t>(&each.what);
            return placed != nullptr && *placed == index;
        });
    });
}

std::vector<Object> generate(std::span<const Cluster> clusters, std::span<const Object> written) {
    Growth growth(clusters, written);
    for (const bool terrain : {true, false})
        for (std::size_t i = 0; i < clusters.size(); ++i)
            if (clusters[i].terrain == terrain && !is_placed(clusters, i)) growth.grow(i);
    return growth.take();
}

}  // namespace quadrig::clusters
