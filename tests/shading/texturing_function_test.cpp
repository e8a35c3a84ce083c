#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "ig_core/shading/frame_paint.h"
#include "ig_core/shading/shade.h"
#include "tests/ig_core/randomness.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// Eq 15 as it is written, in extended precision; of terms after the first `terms` only the mean.
double eq_15(const Texture& texture, const glm::dvec3& p, double t, std::size_t terms = kMaxTextureTerms) {
    using Real = long double;
    constexpr Real pi = std::numbers::pi_v<Real>;
    const Real x = p.x, y = p.y, z = p.z - texture.rise * t, u = texture.vertical, vx = texture.drift.x,
               vy = texture.drift.y;
    Real sum_x = 0, sum_y = 0, sum = 0;
    for (std::size_t i = 0; i < texture.terms.size(); ++i) {
        const TextureTerm& term = texture.terms[i];
        const Real c = term.coefficient, w = term.frequency, phase = term.phase + texture.churn * t;
        const Real px = pi / 2 * std::sin(w * y / 2 + phase) + pi * u * std::sin(w * z / 2 + phase) + w * vx * t;
        const Real py = pi / 2 * std::sin(w * x / 2 + phase) + pi * u * std::cos(w * z / 2 + phase) + w * vy * t;
        sum_x += c * ((i < terms ? std::sin(w * x + px) : 0) + 1) / 2;
        sum_y += c * ((i < terms ? std::sin(w * y + py) : 0) + 1) / 2;
        sum += c;
    }
    return static_cast<double>(sum_x * sum_y / (sum * sum));
}

Texture random_texture(Randomness& random) {
    Texture texture;
    const int terms = 1 + random.below(kMaxTextureTerms);
    for (int i = 0; i < terms; ++i)
        texture.terms.push_back({random.between(0.1, 1), random.log_between(0.01, 30), random.between(-10, 10)});
    if (random.chance(0.6)) texture.vertical = random.between(0, 1);
    if (random.chance(0.5)) texture.drift = {random.between(-20, 20), random.between(-20, 20)};
    if (random.chance(0.3)) texture.rise = random.between(-5, 5);
    if (random.chance(0.3)) texture.churn = random.between(-2, 2);
    return texture;
}

/// What single precision leaves of Eq 15 where the fastest term has turned up to so many times between eye and point.
/// Past about 500 turns a pixel of a picture a thousand pixels wide holds a whole turn, and the term is filtered away.
constexpr double kTurns = 500, kBound = 2e-4;
/// Sines whose own error does not count beside that.
constexpr Quality kFineSines{.sine = SineMethod::polynomial};

double worst_error(const Texture& texture, const ScenePoint& eye, double seconds, Randomness& random,
                   const Quality& quality = kFineSines) {
    Scene scene;
    scene.textures = {texture};
    FramePaints paints = make_frame_paints(scene);
    move_textures(scene, eye, seconds, quality, paints);
    double fastest = 0;
    for (const TextureTerm& term : texture.terms) fastest = std::max(fastest, term.frequency);
    const double reach = kTurns * 2 * std::numbers::pi / fastest / std::sqrt(3.0);
    std::vector<float> x, y, z, t(203);
    for (std::size_t i = 0; i < t.size(); ++i) {
        const glm::dvec3 p = random.vector(reach);
        x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y)),
            z.push_back(static_cast<float>(p.z));
    }
    texture_values(paints.textures[0], x, y, z, t);
    const std::size_t terms = std::max<std::size_t>(
        1, texture.terms.size() - std::min(texture.terms.size(), static_cast<std::size_t>(quality.terms_left_out)));
    double worst = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
        const glm::dvec3 p = eye.metres + glm::dvec3(x[i], y[i], z[i]);
        const double error = std::abs(t[i] - eq_15(texture, p, seconds, terms));
        worst = error <= worst ? worst : error;  // NaN is worst
    }
    return worst;
}

}  // namespace

TEST_CASE(
    "with fine sines the texturing function is Eq 15 to within 2e-4, wherever the eye is and whenever, on every "
    "instruction set") {
    CAPTURE(seed());
    for (const std::int64_t target : simd_targets()) {
        const SimdTarget held(target);
        double worst = 0;
        for (int trial = 0; trial < trials(150); ++trial) {
            Randomness random(trial);
            const Texture texture = random_texture(random);
            const ScenePoint eye{random.log_between(1, 1e5) * random.direction()};
            const double error = worst_error(texture, eye, random.chance(0.5) ? 0 : random.log_between(1, 1e5), random);
            CAPTURE(trial, hwy::TargetName(target));
            REQUIRE(error < kBound);
            worst = std::max(worst, error);
        }
        CHECK(worst > 1e-7);  // single precision it is: a bound of nothing would say that nothing was computed
    }
}

TEST_CASE("coarser and finer sines keep Eq 15 to within six times their own error, on every instruction set") {
    // Each factor of T has half a sine whose argument holds two more sines, by up to pi/2 and pi.
    constexpr double kGrowth = 0.5 * (1 + std::numbers::pi / 2 + std::numbers::pi) * 2;
    const std::vector<std::pair<SineMethod, double>> methods{
        {SineMethod::parabola, 2e-3}, {SineMethod::table, 3.1e-3}, {SineMethod::library, 3e-7}};
    for (const std::int64_t target : simd_targets()) {
        const SimdTarget held(target);
        for (const auto& [method, error] : methods) {
            double worst = 0;
            for (int trial = 0; trial < trials(30); ++trial) {
                Randomness random(trial);
                const Texture texture = random_texture(random);
                Quality quality;
                quality.sine = method;
                worst = std::max(worst, worst_error(texture, {random.vector(100)}, 0, random, quality));
            }
            CAPTURE(static_cast<int>(method), hwy::TargetName(target));
            CHECK(worst < kGrowth * error + kBound);
            if (method != SineMethod::library) CHECK(worst > error);
        }
    }
}

TEST_CASE("a sine that is left out leaves its mean, and the last one is never left out") {
    for (int trial = 0; trial < trials(50); ++trial) {
        Randomness random(trial);
        Texture texture = random_texture(random);
        std::sort(texture.terms.begin(), texture.terms.end(),
                  [](const TextureTerm& a, const TextureTerm& b) { return a.frequency < b.frequency; });
        Quality quality = kFineSines;
        quality.terms_left_out = random.below(kMaxTextureTerms + 1);
        CAPTURE(trial, quality.terms_left_out);
        CHECK(worst_error(texture, {random.vector(100)}, 0, random, quality) < kBound);
    }
}

TEST_CASE("terms of a texture count the same in whatever order the file has them") {
    Randomness random(1);
    Texture texture;
    for (const double w : {3.0, 0.1, 0.7, 11.0, 0.02})
        texture.terms.push_back({random.between(0.1, 1), w, random.between(0, 6)});
    CHECK(worst_error(texture, {{10, 20, 3}}, 5, random) < kBound);
    std::reverse(texture.terms.begin(), texture.terms.end());
    CHECK(worst_error(texture, {{10, 20, 3}}, 5, random) < kBound);
}

TEST_CASE("a term without weight takes nothing away from those after it") {
    Randomness random(2);
    for (std::size_t without = 0; without < 3; ++without) {
        CAPTURE(without);
        Texture texture;
        for (const double w : {0.1, 0.7, 3.0})
            texture.terms.push_back({random.between(0.1, 1), w, random.between(0, 6)});
        for (const double weight : {0.0, 1e-60}) {
            texture.terms[without].coefficient = weight;
            CHECK(worst_error(texture, {{10, 20, 3}}, 5, random) < kBound);
        }
    }
}

TEST_CASE("the texturing function's values stay within 0..1 and average 1/4") {
    Scene scene;
    scene.textures = {{"", {{1, 0.31, 0.5}, {0.7, 0.77, 2.1}, {0.5, 1.9, 4}}, 0.75, {0, 0}}};
    const FramePaints paints = make_frame_paints(scene);
    std::vector<float> x, y, z;
    Randomness random(3);
    for (int i = 0; i < 40'000; ++i) {
        const glm::dvec3 p = random.vector(150);
        x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y)),
            z.push_back(static_cast<float>(p.z));
    }
    std::vector<float> t(x.size());
    texture_values(paints.textures[0], x, y, z, t);
    double sum = 0;
    for (const float value : t) {
        sum += value;
        REQUIRE(value >= -1e-5F);
        REQUIRE(value <= 1 + 1e-5F);
    }
    CHECK(sum / static_cast<double>(t.size()) == Approx(0.25).margin(0.005));
}
