#include "ig_core/scene/deck_coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace quadrig {

namespace {

/// Eq 15 on a level plane at Z = 0, at time 0.
double texturing_function(const Texture& texture, double x, double y) {
    constexpr double kPi = std::numbers::pi;
    double east = 0.0, north = 0.0, sum = 0.0;
    for (const TextureTerm& t : texture.terms) {
        const double px =
            0.5 * kPi * std::sin(0.5 * t.frequency * y + t.phase) + kPi * texture.vertical * std::sin(t.phase);
        const double py =
            0.5 * kPi * std::sin(0.5 * t.frequency * x + t.phase) + kPi * texture.vertical * std::cos(t.phase);
        east += t.coefficient * 0.5 * (std::sin(t.frequency * x + px) + 1.0);
        north += t.coefficient * 0.5 * (std::sin(t.frequency * y + py) + 1.0);
        sum += t.coefficient;
    }
    return east * north / (sum * sum);
}

}  // namespace

DeckCoverage::DeckCoverage(const Texture& texture, const Translucence& translucence) {
    constexpr std::size_t kPlaces = 16384;
    double slowest = texture.terms.front().frequency;
    for (const TextureTerm& term : texture.terms) slowest = std::min(slowest, term.frequency);
    // Places at random, always the same: a regular pattern could keep step with one of the sines.
    const double side = 100.0 * 2.0 * std::numbers::pi / slowest;
    std::mt19937_64 random;
    const auto place = [&] { return side * std::ldexp(static_cast<double>(random() >> 11), -53); };
    std::vector<double> values(kPlaces), sums(kPlaces + 1, 0.0);
    for (double& value : values) {
        const double x = place(), y = place();
        value = texturing_function(texture, x, y);
    }
    std::sort(values.begin(), values.end());
    std::partial_sum(values.begin(), values.end(), sums.begin() + 1);
    const double half = 0.5 * translucence.softness;
    const auto covered = [&](double threshold) {
        const auto below = [&](double t) {
            return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), t) - values.begin());
        };
        const std::size_t ramp = below(threshold - half), whole = below(threshold + half);
        const double on_ramp =
            (sums[whole] - sums[ramp]) + (half - threshold) * static_cast<double>(whole - ramp);  // times the softness
        return (on_ramp / translucence.softness + static_cast<double>(kPlaces - whole)) / kPlaces;
    };
    for (std::size_t step = 0; step <= kSteps; ++step) {
        const double coverage = static_cast<double>(step) / kSteps;
        double low = -half, high = 1.0 + half;
        for (int i = 0; i < 24; ++i) {
            const double middle = 0.5 * (low + high);
            (covered(middle) > coverage ? low : high) = middle;
        }
        thresholds_[step] = coverage == 1.0 ? -half : high;
    }
}

double DeckCoverage::threshold(double coverage) const {
    const double at = std::clamp(coverage, 0.0, 1.0) * kSteps;
    const auto step = std::min(static_cast<std::size_t>(at), kSteps - 1);
    const double part = at - static_cast<double>(step);
    return (1.0 - part) * thresholds_[step] + part * thresholds_[step + 1];
}

}  // namespace quadrig
