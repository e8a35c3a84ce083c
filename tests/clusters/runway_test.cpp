#include "ig_core/clusters/runway.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::clusters;
using namespace quadrig::test;

namespace {

Runway random_runway(Randomness& random) {
    Runway runway;
    runway.threshold = {random.between(-5000, 5000), random.between(-5000, 5000)};
    runway.heading = {random.between(-180, 360)};
    runway.length = random.between(600, 4000);
    runway.width = random.between(18, 60);
    runway.lights = RunwayLights{20, random.between(30, 60), 900};
    return runway;
}

/// Metres along the runway from its threshold, and to the right of the centre line.
glm::dvec2 on_runway(const Runway& runway, const glm::dvec2& p) {
    const double h = runway.heading.radians();
    const glm::dvec2 q = p - runway.threshold;
    return {q.x * std::sin(h) + q.y * std::cos(h), q.x * std::cos(h) - q.y * std::sin(h)};
}

bool sees(const LightPoint& light, const glm::dvec2& from) {
    if (!light.beam) return true;
    const glm::dvec2 to = from - glm::dvec2(light.position.metres);
    const double h = light.beam->heading.radians(),
                 cosine = glm::dot(glm::normalize(to), glm::dvec2(std::sin(h), std::cos(h)));
    return cosine >= std::cos(0.5 * light.beam->width.radians());
}

}  // namespace

TEST_CASE("markings lie on the runway, the same from both ends") {
    for (int trial = 0; trial < 50; ++trial) {
        Randomness random(trial);
        const Runway runway = random_runway(random);
        const auto polygons = polygons_of(runway);
        std::vector<glm::dvec2> middles, turned;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            glm::dvec2 middle(0.0);
            for (const glm::dvec2& corner : polygons[i].corners) {
                const glm::dvec2 at = on_runway(runway, corner);
                CHECK(at.x > -1e-6);
                CHECK(at.x < runway.length + 1e-6);
                CHECK(std::abs(at.y) < 0.5 * runway.width + 1e-6);
                middle += 0.25 * at;
            }
            const bool dash = std::abs(middle.y) < 1e-6;  // the centre line begins at one end
            if (!dash) middles.push_back(middle), turned.push_back({runway.length - middle.x, -middle.y});
        }
        const auto less = [](const glm::dvec2& a, const glm::dvec2& b) {
            return std::lround(100 * a.x) != std::lround(100 * b.x) ? a.x < b.x : a.y < b.y;
        };
        std::sort(middles.begin(), middles.end(), less), std::sort(turned.begin(), turned.end(), less);
        for (std::size_t i = 0; i < middles.size(); ++i) CHECK(glm::distance(middles[i], turned[i]) < 1e-5);
    }
}

TEST_CASE("a runway of 45 m has the twelve threshold stripes of Annex 14 at either end, one of 30 m eight") {
    for (const auto& [width, stripes] :
         std::vector<std::pair<double, int>>{{18, 4}, {23, 6}, {30, 8}, {45, 12}, {60, 16}}) {
        Runway runway;
        runway.width = width;
        int near = 0;
        for (const GroundPolygon& polygon : polygons_of(runway)) {
            double low = 1e9, high = -1e9;
            for (const glm::dvec2& c : polygon.corners) low = std::min(low, c.y), high = std::max(high, c.y);
            near += std::abs(low - 6) < 1e-9 && std::abs(high - 36) < 1e-9;
        }
        CAPTURE(width);
        CHECK(near == stripes);
    }
}

TEST_CASE("threshold lights are green to who approaches, end lights red to who is on the runway, at both ends") {
    for (int trial = 0; trial < 20; ++trial) {
        Randomness random(trial);
        const Runway runway = random_runway(random);
        const double h = runway.heading.radians();
        const glm::dvec2 along(std::sin(h), std::cos(h));
        const glm::dvec2 approach = runway.threshold - 3000.0 * along;
        const glm::dvec2 on = runway.threshold + 0.5 * runway.length * along;
        int green = 0, red_seen = 0, red_hidden = 0, approach_lights = 0;
        for (const LightPoint& light : lights_of(runway)) {
            const glm::dvec2 at = on_runway(runway, glm::dvec2(light.position.metres));
            const bool is_red = light.colour.x > 10 * light.colour.y, is_green = light.colour.y > 5 * light.colour.x;
            const bool near_end = at.x < 0.5 * runway.length;
            if (is_green && sees(light, approach)) {
                ++green;
                CHECK(near_end);
                CHECK_FALSE(sees(light, on));
            }
            if (is_red && sees(light, on)) ++red_seen;
            if (is_red && near_end && sees(light, approach)) ++red_hidden;
            approach_lights += at.x < -20 && sees(light, approach);
        }
        CHECK(green >= runway.width / 3);
        CHECK(red_seen == 12);
        CHECK(red_hidden == 0);
        CHECK(approach_lights == 30 * 5 + 2 * 4);
    }
}
