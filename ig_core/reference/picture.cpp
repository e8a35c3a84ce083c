#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "ig_core/reference/entry_bounds.h"
#include "ig_core/reference/reference_renderer.h"
#include "ig_core/reference/seen_scene.h"
#include "ig_core/reference/surface_colour.h"
#include "ig_core/scene/motion.h"
#include "ig_core/scene/placement.h"

namespace quadrig::reference {
namespace {

/// A surface that the ray enters, before it is known what colour it has.
struct Layer {
    Entry<long double> at;
    enum class Kind { object, ground, cloud_deck, light, marking } kind = Kind::object;
    std::uint32_t index = 0;
};

/// Altitude of a plane without end.
std::optional<double> altitude_of(const Scene& scene, const Layer& layer) {
    if (layer.kind == Layer::Kind::ground || layer.kind == Layer::Kind::marking) return 0.0;
    if (layer.kind == Layer::Kind::cloud_deck) return scene.cloud_decks[layer.index].altitude;
    return std::nullopt;
}

/// Whether a is seen in front of b. A light's disc is, whole, if its centre is in front of a plane without end.
bool in_front_of(const SeenScene& seen, const Layer& a, const Layer& b) {
    if (a.kind == Layer::Kind::light && altitude_of(seen.scene, b)) {
        const double plane = *altitude_of(seen.scene, b), eye = seen.view.eye.metres.z;
        const double light = seen.scene.lights[a.index].position.metres.z;
        return (eye - plane) * (light - plane) >= 0.0;
    }
    if (b.kind == Layer::Kind::light && altitude_of(seen.scene, a)) return !in_front_of(seen, b, a);
    return in_front(a.at.depth, b.at.depth);
}

/// All front surfaces along the ray, nearest first, in file order where depths agree, then the ground, then cloud
/// decks.
void collect_layers(const SeenScene& seen, const std::vector<std::uint32_t>& objects,
                    const Vector<long double>& direction, double column, double row, std::vector<Layer>& layers) {
    layers.clear();
    const auto insert = [&](const Layer& layer) {
        auto place = layers.end();
        while (place != layers.begin() && in_front_of(seen, layer, *std::prev(place))) --place;
        layers.insert(place, layer);
    };
    for (const std::uint32_t object : objects)
        if (const auto hit = entry(seen.solid<long double>(object), direction))
            insert({*hit, Layer::Kind::object, object});
    if (const auto depth = level_depth(seen.view, 0.0, direction)) {
        const glm::dvec3& eye = seen.view.eye.metres;
        const glm::dvec2 at(static_cast<double>(eye.x + *depth * direction[0]),
                            static_cast<double>(eye.y + *depth * direction[1]));
        if (const auto polygon = polygon_at(seen.scene.ground_polygons, at))
            insert({{*depth, 0}, Layer::Kind::marking, *polygon});
        else if (seen.scene.ground)
            insert({{*depth, 0}, Layer::Kind::ground, 0});
    }
    for (std::uint32_t deck = 0; deck < seen.scene.cloud_decks.size(); ++deck)
        if (const auto depth = level_depth(seen.view, seen.scene.cloud_decks[deck].altitude, direction))
            insert({{*depth, 0}, Layer::Kind::cloud_deck, deck});
    for (const SeenScene::Disc& disc : seen.discs)
        if (std::hypot((column - disc.column) / disc.across, (row - disc.row) / disc.down) < 1.0)
            insert({{disc.depth, 0}, Layer::Kind::light, disc.light});
}

const Paint& paint_of(const Scene& scene, const Layer& layer) {
    switch (layer.kind) {
        case Layer::Kind::ground:
            return scene.ground->paint;
        case Layer::Kind::marking:
            return scene.ground_polygons[layer.index].paint;
        case Layer::Kind::cloud_deck:
            return scene.cloud_decks[layer.index].paint;
        default:
            return scene.objects[layer.index].paint;
    }
}

SurfacePoint surface_point(const SeenScene& seen, const Layer& layer, const Vector<long double>& direction) {
    const auto to_double = [](const Vector<long double>& v) {
        return glm::dvec3(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
    };
    const glm::dvec3& eye = seen.view.eye.metres;
    const long double k = layer.at.depth;
    SurfacePoint at;
    at.point.metres = to_double({eye.x + k * direction[0], eye.y + k * direction[1], eye.z + k * direction[2]});
    at.range = static_cast<double>(k * std::sqrt(dot(direction, direction)));
    if (layer.kind == Layer::Kind::object) {
        const Solid<long double>& solid = seen.values[layer.index];
        at.normal = to_double(outward_normal(solid, direction, layer.at));
        if (layer.at.surface == 0) at.limb = limb_function(solid, direction);
    }
    return at;
}

double range_of_light(const SeenScene& seen, std::uint32_t light) {
    return glm::distance(seen.scene.lights[light].position.metres, seen.view.eye.metres);
}

/// The colour along one ray, and a number that tells the surfaces that make it up.
struct Sample {
    Colour colour{0.0};
    std::uint64_t surfaces = 0;
};

Sample colour_along(const SeenScene& seen, const Air& air, const std::vector<Layer>& layers,
                    const Vector<long double>& direction) {
    Sample sum;
    double transparency = 1.0;
    for (const Layer& layer : layers) {
        const Coat coat =
            layer.kind == Layer::Kind::light
                ? coat_of(seen.scene.lights[layer.index], range_of_light(seen, layer.index), air)
                : coat_of(paint_of(seen.scene, layer), seen.scene.textures, surface_point(seen, layer, direction), air);
        sum.colour += transparency * coat.opacity * coat.colour;
        transparency *= 1 - coat.opacity;
        const auto surface = static_cast<std::uint64_t>(layer.at.surface) * 8 + static_cast<std::uint64_t>(layer.kind);
        sum.surfaces = (sum.surfaces ^ (layer.index * 1024 + surface)) * 0x100000001b3;  // FNV-1a
        if (transparency <= 0.0) return sum;
    }
    const long double sine_of_elevation = direction[2] / std::sqrt(dot(direction, direction));
    sum.colour += transparency * sky_colour(air.sky, static_cast<double>(sine_of_elevation));
    return sum;
}

/// Rays through the pixels of one tile.
class Sampler {
  public:
    Sampler(const SeenScene& seen, const Air& air, const Tile& tile) : seen_(seen), air_(air), tile_(tile) {}

    /// Looks up what the rays of a pixel may meet.
    void enter_pixel(int column, int row) {
        const ImagePlane& image = seen_.view.image;
        const double reach = 0.51 * std::hypot(image.column_step, image.row_step);
        const Vector<double> direction = seen_.direction(column + 0.5, row + 0.5);
        objects_.clear();
        for (const std::uint32_t object : tile_.candidates)
            if (entry_bounds(seen_.triage[object], direction, reach).verdict != EntryBounds::Verdict::misses)
                objects_.push_back(object);
    }

    [[nodiscard]] Sample at(double column, double row) {
        const auto direction = ray_direction<long double>(seen_.view, column, row);
        collect_layers(seen_, objects_, direction, column, row, layers_);
        return colour_along(seen_, air_, layers_, direction);
    }

  private:
    const SeenScene& seen_;
    const Air& air_;
    const Tile& tile_;
    std::vector<std::uint32_t> objects_;
    std::vector<Layer> layers_;
};

/// The scene with all that moves where it is at the time, and what the host has placed behind its objects.
Scene scene_at(const Scene& at_rest, const Environment& environment) {
    Scene scene = quadrig::scene_at(at_rest, environment.seconds);
    for (const PlacedModel& body : environment.bodies)
        if (body.model < at_rest.models.size())
            for (const Object& object : at_rest.models[body.model].objects)
                if (auto there = placed(object, body.pose)) scene.objects.push_back(*std::move(there));
    return scene;
}

/// Draws every pixel of an image by a function of its sampler, column and row.
template <class Mean>
LinearImage draw_pixels(const Scene& at_rest, const View& view, const Environment& environment, Mean&& mean) {
    const Scene scene = scene_at(at_rest, environment);
    const SeenScene seen(scene, view);
    const Air air = air_of(scene, environment);
    LinearImage image{view.image.width, view.image.height, {}};
    const auto width = static_cast<std::size_t>(image.width);
    image.rgb.resize(3 * width * static_cast<std::size_t>(image.height));
    for_each_tile(view, seen.spheres, [&](const Tile& tile) {
        Sampler sampler(seen, air, tile);
        for (int row = tile.first_row; row < tile.end_row; ++row) {
            for (int column = tile.first_column; column < tile.end_column; ++column) {
                sampler.enter_pixel(column, row);
                const Colour colour = mean(sampler, column, row);
                const std::size_t pixel = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
                for (int c = 0; c < 3; ++c)
                    image.rgb[3 * pixel + static_cast<std::size_t>(c)] = static_cast<float>(colour[c]);
            }
        }
    });
    return image;
}

/// The mean over a square of the image, by squares that are quartered wherever their corners and middle disagree.
class AdaptiveMean {
  public:
    AdaptiveMean(Sampler& sampler, int shallowest, int deepest)
        : sampler_(sampler), shallowest_(shallowest), deepest_(deepest) {}

    /// Means with squares quartered `deepest` times, and once less.
    struct Means {
        Colour fine{0.0}, coarse{0.0};
    };
    [[nodiscard]] Means over_pixel(double left, double top) {
        const Corners corners{at(left, top), at(left + 1, top), at(left, top + 1), at(left + 1, top + 1)};
        return over({left, top, 1.0}, corners, 0);
    }
    [[nodiscard]] std::int64_t rays() const { return rays_; }

  private:
    struct Square {
        double left, top, size;
    };
    using Corners = std::array<Sample, 4>;  // from left to right, then down

    [[nodiscard]] Sample at(double column, double row) {
        ++rays_;
        return sampler_.at(column, row);
    }

    static bool agree(const Sample& a, const Sample& b) {
        constexpr double even = 0.02;
        return a.surfaces == b.surfaces && glm::all(glm::lessThan(glm::abs(a.colour - b.colour), Colour(even)));
    }

    [[nodiscard]] Means over(const Square& square, const Corners& corners, int depth) {
        const auto [left, top, size] = square;
        const double half = 0.5 * size;
        const Sample middle = at(left + half, top + half);
        // Exact for polynomials of the third degree: the errors of midpoint and trapezium are as 1 to -2.
        const Colour mean = middle.colour * (2.0 / 3.0) +
                            (corners[0].colour + corners[1].colour + corners[2].colour + corners[3].colour) / 12.0;
        const bool even =
            std::all_of(corners.begin(), corners.end(), [&](const Sample& corner) { return agree(corner, middle); });
        if (depth >= deepest_ || (even && depth >= shallowest_)) return {mean, mean};

        const Sample above = at(left + half, top), below = at(left + half, top + size);
        const Sample before = at(left, top + half), after = at(left + size, top + half);
        const std::array<Means, 4> quarters{
            over({left, top, half}, {corners[0], above, before, middle}, depth + 1),
            over({left + half, top, half}, {above, corners[1], middle, after}, depth + 1),
            over({left, top + half, half}, {before, middle, corners[2], below}, depth + 1),
            over({left + half, top + half, half}, {middle, after, below, corners[3]}, depth + 1)};
        Means means;
        for (const Means& quarter : quarters) means.fine += 0.25 * quarter.fine, means.coarse += 0.25 * quarter.coarse;
        if (depth + 1 == deepest_) means.coarse = mean;
        return means;
    }

    Sampler& sampler_;
    int shallowest_, deepest_;
    std::int64_t rays_ = 0;
};

}  // namespace

LinearImage picture(const Scene& scene, const View& view, const Environment& environment, int samples) {
    return draw_pixels(scene, view, environment, [samples](Sampler& sampler, int column, int row) {
        Colour sum{0.0};
        for (int sample = 0; sample < samples * samples; ++sample)
            sum += sampler.at(column + (sample % samples + 0.5) / samples, row + (sample / samples + 0.5) / samples)
                       .colour;
        return sum / static_cast<double>(samples * samples);
    });
}

ConvergedPicture converged_picture(const Scene& scene, const View& view, const Environment& environment,
                                   double tolerance, int deepest) {
    std::atomic<int> open_pixels{0};
    std::atomic<std::int64_t> rays{0};
    ConvergedPicture result;
    result.image = draw_pixels(scene, view, environment, [&](Sampler& sampler, int column, int row) {
        constexpr int shallowest = 3;
        AdaptiveMean::Means means;
        for (int depth = std::min(shallowest + 1, deepest); depth <= deepest; ++depth) {
            AdaptiveMean adaptive(sampler, std::min(shallowest, deepest), depth);
            means = adaptive.over_pixel(column, row);
            rays += adaptive.rays();
            const Colour change = glm::abs(means.fine - means.coarse);
            if (std::max({change.x, change.y, change.z}) < tolerance) return means.fine;
        }
        ++open_pixels;
        return means.fine;
    });
    result.open_pixels = open_pixels;
    result.rays = rays;
    return result;
}

void to_srgb8(const LinearImage& linear, const FrameImage& image) {
    const auto encoded = [](float value) {
        const double v = std::clamp(static_cast<double>(value), 0.0, 1.0);
        const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        return static_cast<std::uint8_t>(std::lround(255.0 * s));
    };
    const float* from = linear.rgb.data();
    for (int row = 0; row < linear.height; ++row) {
        std::uint8_t* to = image.row(row);
        for (int column = 0; column < linear.width; ++column, from += 3, to += 4) {
            for (int c = 0; c < 3; ++c) to[c] = encoded(from[c]);
            to[3] = 255;
        }
    }
}

}  // namespace quadrig::reference
