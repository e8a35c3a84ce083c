#include "ig_core/reference/reference_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "ig_core/reference/candidates.h"
#include "ig_core/reference/solid.h"
#include "ig_core/reference/surface_colour.h"

namespace quadrig::reference {
namespace {

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();

/// A scene as one eye sees it.
struct Seen {
    const Scene& scene;
    const View& view;
    std::vector<Solid<Quad>> exact;
    std::vector<Solid<long double>> fast;
    std::vector<BoundingSphere> spheres;

    Seen(const Scene& s, const View& v) : scene(s), view(v) {
        for (const Object& object : scene.objects) {
            exact.push_back(solid_about_eye(object, view.eye));
            fast.push_back(rounded(exact.back()));
            spheres.push_back(bounding_sphere(exact.back()));
        }
    }
    template <class Scalar>
    [[nodiscard]] const Solid<Scalar>& solid(std::uint32_t object) const {
        if constexpr (std::is_same_v<Scalar, Quad>)
            return exact[object];
        else
            return fast[object];
    }
};

void shortlist(const Seen& seen, const Tile& tile, double column, double row, std::vector<std::uint32_t>& objects) {
    const auto d = ray_direction<long double>(seen.view, column, row);
    const glm::dvec3 direction(static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2]));
    objects.clear();
    for (const std::uint32_t object : tile.candidates)
        if (may_meet(seen.spheres[object], direction)) objects.push_back(object);
}

/// Depth of a level plane, if it is in front of the eye.
template <class Scalar>
std::optional<Scalar> level_depth(const View& view, double altitude, const Vector<Scalar>& direction) {
    const Scalar drop = Scalar(altitude) - Scalar(view.eye.metres.z);
    if (direction[2] == 0 || !(drop / direction[2] > 0)) return std::nullopt;
    return drop / direction[2];
}

/// Whether a is in front of b by more than rounding; if not, file order decides.
template <class Scalar>
bool in_front(Scalar a, Scalar b) {
    return b == kInfinity || b - a > Limits<Scalar>::thin * b;
}

struct Identity {
    std::int32_t object = kSkyId;
    std::int32_t surface = 0;
    friend bool operator==(Identity, Identity) = default;
};

template <class Scalar>
struct Nearest {
    Identity identity;
    Scalar depth = kInfinity;
    Scalar next_depth = kInfinity;
};

template <class Scalar>
Nearest<Scalar> nearest(const Seen& seen, const std::vector<std::uint32_t>& objects, Scalar column, Scalar row) {
    const auto direction = ray_direction<Scalar>(seen.view, column, row);
    Nearest<Scalar> best;
    const auto consider = [&best](Identity identity, Scalar depth) {
        if (in_front(depth, best.depth))
            best = {identity, depth, best.depth};
        else
            best.next_depth = std::min(best.next_depth, depth);
    };
    for (const std::uint32_t object : objects)
        if (const auto hit = entry(seen.solid<Scalar>(object), direction))
            consider({static_cast<std::int32_t>(object), hit->surface}, hit->depth);
    if (seen.scene.ground)
        if (const auto depth = level_depth(seen.view, 0.0, direction)) consider({kGroundId, 0}, *depth);
    return best;
}

/// The answer changes when the ray moves by 1e-6 pixel. Long double finds the suspects, quad decides.
bool changes_nearby(const Seen& seen, const std::vector<std::uint32_t>& objects, Identity here, int column, int row) {
    constexpr long double shift = 1e-6L;
    for (const int across : {-1, 0, 1}) {
        for (const int down : {-1, 0, 1}) {
            const long double x = column + 0.5L + across * shift, y = row + 0.5L + down * shift;
            if (nearest<long double>(seen, objects, x, y).identity == here) continue;
            if (nearest<Quad>(seen, objects, x, y).identity != here) return true;
        }
    }
    return false;
}

/// A surface that the ray enters, before it is known what colour it has.
struct Layer {
    Entry<long double> at;
    enum class Kind { object, ground, cloud_deck } kind = Kind::object;
    std::uint32_t index = 0;
};

/// All front surfaces along the ray, nearest first, in file order where depths agree, then the ground, then cloud
/// decks.
void collect_layers(const Seen& seen, const std::vector<std::uint32_t>& objects, const Vector<long double>& direction,
                    std::vector<Layer>& layers) {
    layers.clear();
    const auto insert = [&layers](const Layer& layer) {
        auto place = layers.end();
        while (place != layers.begin() && in_front(layer.at.depth, std::prev(place)->at.depth)) --place;
        layers.insert(place, layer);
    };
    for (const std::uint32_t object : objects)
        if (const auto hit = entry(seen.solid<long double>(object), direction))
            insert({*hit, Layer::Kind::object, object});
    if (seen.scene.ground)
        if (const auto depth = level_depth(seen.view, 0.0, direction)) insert({{*depth, 0}, Layer::Kind::ground, 0});
    for (std::uint32_t deck = 0; deck < seen.scene.cloud_decks.size(); ++deck)
        if (const auto depth = level_depth(seen.view, seen.scene.cloud_decks[deck].altitude, direction))
            insert({{*depth, 0}, Layer::Kind::cloud_deck, deck});
}

const Paint& paint_of(const Scene& scene, const Layer& layer) {
    switch (layer.kind) {
        case Layer::Kind::ground:
            return scene.ground->paint;
        case Layer::Kind::cloud_deck:
            return scene.cloud_decks[layer.index].paint;
        default:
            return scene.objects[layer.index].paint;
    }
}

SurfacePoint surface_point(const Seen& seen, const Layer& layer, const Vector<long double>& direction) {
    const auto to_double = [](const Vector<long double>& v) {
        return glm::dvec3(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
    };
    const glm::dvec3& eye = seen.view.eye.metres;
    const long double k = layer.at.depth;
    SurfacePoint at;
    at.point.metres = to_double({eye.x + k * direction[0], eye.y + k * direction[1], eye.z + k * direction[2]});
    at.range = static_cast<double>(k * std::sqrt(dot(direction, direction)));
    if (layer.kind == Layer::Kind::object) {
        const Solid<long double>& solid = seen.fast[layer.index];
        at.normal = to_double(outward_normal(solid, direction, layer.at));
        if (layer.at.surface == 0) at.limb = limb_function(solid, direction);
    }
    return at;
}

Colour colour_along(const Seen& seen, const Air& air, const std::vector<Layer>& layers,
                    const Vector<long double>& direction) {
    Colour sum{0.0};
    double transparency = 1.0;
    for (const Layer& layer : layers) {
        const Coat coat =
            coat_of(paint_of(seen.scene, layer), seen.scene.textures, surface_point(seen, layer, direction), air);
        sum += transparency * coat.opacity * coat.colour;
        transparency *= 1 - coat.opacity;
        if (transparency <= 0.0) return sum;
    }
    const long double sine_of_elevation = direction[2] / std::sqrt(dot(direction, direction));
    return sum + transparency * sky_colour(air.sky, static_cast<double>(sine_of_elevation));
}

}  // namespace

GroundTruth ground_truth(const Scene& scene, const View& view, std::vector<std::uint8_t>* ties) {
    const Seen seen(scene, view);
    const auto width = static_cast<std::size_t>(view.image.width);
    const std::size_t pixels = width * static_cast<std::size_t>(view.image.height);
    GroundTruth truth;
    truth.resize(pixels);
    if (ties) ties->assign(pixels, 0);
    for_each_tile(view, seen.spheres, [&](const Tile& tile) {
        std::vector<std::uint32_t> objects;
        for (int row = tile.first_row; row < tile.end_row; ++row) {
            for (int column = tile.first_column; column < tile.end_column; ++column) {
                shortlist(seen, tile, column + 0.5, row + 0.5, objects);
                const auto answer = nearest<Quad>(seen, objects, column + Quad(0.5), row + Quad(0.5));
                const std::size_t pixel = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
                truth.object_ids[pixel] = answer.identity.object;
                truth.surface_ids[pixel] = answer.identity.surface;
                truth.depth[pixel] = static_cast<double>(answer.depth);
                if (!ties) continue;
                const bool depths_agree =
                    answer.depth < kInfinity && answer.next_depth - answer.depth <= 1e-9 * answer.depth;
                (*ties)[pixel] = depths_agree || changes_nearby(seen, objects, answer.identity, column, row);
            }
        }
    });
    return truth;
}

LinearImage picture(const Scene& scene, const View& view, const Environment& environment, int samples) {
    const Seen seen(scene, view);
    const Air air = air_of(scene, environment);
    LinearImage image{view.image.width, view.image.height, {}};
    const auto width = static_cast<std::size_t>(image.width);
    image.rgb.resize(3 * width * static_cast<std::size_t>(image.height));
    for_each_tile(view, seen.spheres, [&](const Tile& tile) {
        std::vector<std::uint32_t> objects;
        std::vector<Layer> layers;
        for (int row = tile.first_row; row < tile.end_row; ++row) {
            for (int column = tile.first_column; column < tile.end_column; ++column) {
                Colour sum{0.0};
                for (int sample = 0; sample < samples * samples; ++sample) {
                    const double x = column + (sample % samples + 0.5) / samples;
                    const double y = row + (sample / samples + 0.5) / samples;
                    shortlist(seen, tile, x, y, objects);
                    const auto direction = ray_direction<long double>(view, x, y);
                    collect_layers(seen, objects, direction, layers);
                    sum += colour_along(seen, air, layers, direction);
                }
                const std::size_t pixel = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
                for (int c = 0; c < 3; ++c)
                    image.rgb[3 * pixel + static_cast<std::size_t>(c)] =
                        static_cast<float>(sum[c] / (samples * samples));
            }
        }
    });
    return image;
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
