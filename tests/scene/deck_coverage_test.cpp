#include "ig_core/scene/deck_coverage.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/ig_core/randomness.h"

using namespace quadrig;

namespace {

/// Gardner 1984, Eq 15, on level ground.
double equation_15(const Texture& texture, double x, double y) {
    double sum_x = 0.0, sum_y = 0.0, sum = 0.0;
    for (const auto& [c, w, p] : texture.terms) {
        const double shift_x =
            std::numbers::pi / 2 * std::sin(w * y / 2 + p) + std::numbers::pi * texture.vertical * std::sin(p);
        const double shift_y =
            std::numbers::pi / 2 * std::sin(w * x / 2 + p) + std::numbers::pi * texture.vertical * std::cos(p);
        sum_x += c * (std::sin(w * x + shift_x) + 1) / 2;
        sum_y += c * (std::sin(w * y + shift_y) + 1) / 2;
        sum += c;
    }
    return sum_x * sum_y / (sum * sum);
}

}  // namespace

TEST_CASE("The threshold for a share of the sky covers that share of a deck, whatever its texture") {
    CAPTURE(test::seed());
    test::Randomness random(1);
    const auto between = [&](double a, double b) { return random.between(a, b); };
    for (int i = 0; i < 10; ++i) {
        Texture texture;
        texture.vertical = i % 2 == 0 ? 0.0 : between(0.0, 1.0);
        for (int t = 0; t <= i % kMaxTextureTerms; ++t)
            texture.terms.push_back({between(0.2, 1.0), between(0.001, 0.02), between(0.0, 6.28)});
        const Translucence holes{between(0.0, 0.3), 0.5, between(0.02, 0.4)};
        const DeckCoverage deck(texture, holes);
        double before = 2.0;
        for (const double coverage : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0}) {
            const double threshold = deck.threshold(coverage);
            CHECK(threshold < before);
            before = threshold;
            double opacity = 0.0;
            constexpr int kPlaces = 20000;
            for (int p = 0; p < kPlaces; ++p) {
                const double t = equation_15(texture, between(-1e6, 1e6), between(-1e6, 1e6));
                opacity += std::clamp((t - threshold) / holes.softness + 0.5, 0.0, 1.0);
            }
            INFO("coverage " << coverage << ", " << texture.terms.size() << " terms, softness " << holes.softness);
            CHECK(opacity / kPlaces == Approx(coverage).margin(coverage == 0.0 || coverage == 1.0 ? 0.003 : 0.03));
        }
    }
}
