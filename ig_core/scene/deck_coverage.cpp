#include "ig_core/scene/deck_coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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
    constexpr int kPlaces = 1024;
    double slowest = texture.terms.front().frequency;
    for (const TextureTerm& term : texture.terms) slowest = std::min(slowest, term.frequency);
    // A hundred of the longest waves each way, at places that fill the square evenly: the generalised golden ratio's
    // sequence (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
    const double side = 100.0 * 2.0 * std::numbers::pi / slowest;
    std::vector<double> values;
    for (int i = 0; i < kPlaces; ++i) {
        double whole = 0.0;
        values.push_back(texturing_function(texture, side * std::modf(i * 0.7548776662466927, &whole),
                                            side * std::modf(i * 0.5698402909980532, &whole)));
    }
    const double half = 0.5 * translucence.softness;
    const auto covered = [&](double threshold) {
        double opacity = 0.0;
        for (const double t : values) opacity += std::clamp((t - threshold) / translucence.softness + 0.5, 0.0, 1.0);
        return opacity / kPlaces;
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
