#include "ig_core/shading/frame_paint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace quadrig {
namespace {

/// Terms by rising frequency: filtering drops them from the end. One without weight would end them as a dropped one
/// does.
std::vector<TextureTerm> sorted_terms(const Texture& texture) {
    std::vector<TextureTerm> terms = texture.terms;
    double sum = 0.0;
    for (const TextureTerm& term : terms) sum += term.coefficient;
    std::erase_if(terms, [sum](const TextureTerm& t) { return static_cast<float>(t.coefficient / sum) == 0.0F; });
    std::stable_sort(terms.begin(), terms.end(),
                     [](const TextureTerm& a, const TextureTerm& b) { return a.frequency < b.frequency; });
    return terms;
}

/// Softness is squared in single precision. T is no finer than the least; with the greatest opacity is 1/2 all over.
constexpr double kLeastSoftness = 1e-9, kGreatestSoftness = 1e9;

FramePaint make_paint(const Paint& paint, const std::vector<FrameTexture>& textures) {
    FramePaint out;
    out.colour = to_float(paint.colour);
    if (paint.texture) {
        out.texture = &textures[*paint.texture];
        out.texture_weight = static_cast<float>(paint.texture_weight);
    }
    if (paint.translucence && paint.texture) {
        out.translucent = true;
        out.threshold = static_cast<float>(paint.translucence->threshold);
        out.limb_threshold = static_cast<float>(paint.translucence->limb_threshold);
        out.softness = static_cast<float>(std::clamp(paint.translucence->softness, kLeastSoftness, kGreatestSoftness));
    }
    const std::uint32_t texture = paint.texture ? 1 + *paint.texture : 0;
    out.bin = static_cast<std::uint8_t>(2 * (texture % kTextureBins) + (out.translucent ? 1 : 0));
    return out;
}

/// A cosine's phase in turns, reduced to 0..1.
float turns(double radians) {
    const double t = radians / (2.0 * std::numbers::pi);
    return static_cast<float>(t - std::floor(t));
}
/// That of the cosine which is a sine of some phase.
float turns_of_sine(double radians) { return turns(radians - 0.5 * std::numbers::pi); }

}  // namespace

FramePaints make_frame_paints(const Scene& scene) {
    FramePaints paints;
    paints.textures.resize(scene.textures.size());
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        FrameTexture& out = paints.textures[i];
        const std::vector<TextureTerm>& terms = paints.terms.emplace_back(sorted_terms(scene.textures[i]));
        double sum = 0.0;
        for (const TextureTerm& term : terms) sum += term.coefficient;
        out.count = static_cast<int>(terms.size());
        out.vertical = static_cast<float>(scene.textures[i].vertical);
        for (std::size_t k = 0; k < terms.size(); ++k) {
            const double amplitude = terms[k].coefficient / (2.0 * sum), w = terms[k].frequency;
            out.terms[k].amplitude = static_cast<float>(amplitude);
            out.terms[k].fade = static_cast<float>(amplitude * w * w / kFilteredAway);
            out.terms[k].turns_per_metre = static_cast<float>(w / (2.0 * std::numbers::pi));
        }
    }
    for (const Object& object : scene.objects) paints.objects.push_back(make_paint(object.paint, paints.textures));
    for (const Model& model : scene.models) {
        std::vector<FramePaint>& out = paints.models.emplace_back();
        for (const Object& object : model.objects) out.push_back(make_paint(object.paint, paints.textures));
    }
    for (const GroundPolygon& polygon : scene.ground_polygons)
        paints.markings.push_back(make_paint(polygon.paint, paints.textures));
    for (const CloudDeck& deck : scene.cloud_decks) paints.decks.push_back(make_paint(deck.paint, paints.textures));
    if (scene.ground) {
        paints.ground = make_paint(scene.ground->paint, paints.textures);
        paints.ground.translucent = false;
    }
    return paints;
}

void move_textures(const Scene& scene, const ScenePoint& eye, double seconds, const Quality& quality,
                   FramePaints& paints) {
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& texture = scene.textures[i];
        const int terms = static_cast<int>(paints.terms[i].size());
        paints.textures[i].count = std::max(std::min(terms, 1), terms - std::max(0, quality.terms_left_out));
        paints.textures[i].sine = quality.sine;
        paints.textures[i].variance = 0;
        for (std::size_t k = 0; k < paints.terms[i].size(); ++k) {
            const double w = paints.terms[i][k].frequency;
            const double p = paints.terms[i][k].phase + texture.churn * seconds;
            FrameTexture::Term& out = paints.textures[i].terms[k];
            // That of a sine of amplitude 1 is 1/2.
            if (static_cast<int>(k) < paints.textures[i].count)
                paints.textures[i].variance += 0.5F * out.amplitude * out.amplitude;
            out.along_x = turns_of_sine(w * (eye.metres.x + texture.drift.x * seconds));
            out.along_y = turns_of_sine(w * (eye.metres.y + texture.drift.y * seconds));
            out.half_x = turns_of_sine(0.5 * w * eye.metres.x + p);
            out.half_y = turns_of_sine(0.5 * w * eye.metres.y + p);
            const double up = 0.5 * w * (eye.metres.z - texture.rise * seconds) + p;
            out.up_x = turns_of_sine(up), out.up_y = turns(up);
        }
    }
}

glm::dvec3 direction_to_sun(const Sun& sun) {
    const double a = sun.azimuth.radians(), e = sun.elevation.radians();
    return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

FrameLight make_frame_light(const Scene& scene, const Environment& environment) {
    FrameLight light;
    const Sun& sun = environment.sun ? *environment.sun : scene.sun;
    light.to_sun = to_float(direction_to_sun(sun));
    light.ambient = static_cast<float>(sun.ambient);
    light.horizon = to_float(scene.sky.horizon);
    light.zenith = to_float(scene.sky.zenith);
    const double clear = std::numeric_limits<double>::infinity();
    const double visibility = environment.visibility.value_or(scene.haze ? scene.haze->visibility : clear);
    light.haze = visibility < clear;
    if (light.haze) {
        light.extinction = static_cast<float>(kContrastAtVisibility / (visibility * std::numbers::ln2));
        light.haze_colour = to_float(scene.haze ? scene.haze->colour : scene.sky.horizon);
    }
    return light;
}

}  // namespace quadrig
