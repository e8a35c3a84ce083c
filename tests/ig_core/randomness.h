/// Random inputs that can be run again: the seed is QUADRIG_TEST_SEED where that is set, else always the same one.
/// QUADRIG_TEST_SCALE multiplies the number of trials, for long runs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <string>

#include "ig_core/geometry/space.h"

namespace quadrig::test {

inline std::uint64_t seed() {
    const char* given = std::getenv("QUADRIG_TEST_SEED");
    return given != nullptr ? std::stoull(given) : 20261122u;
}

inline int trials(int count) {
    const char* given = std::getenv("QUADRIG_TEST_SCALE");
    return given != nullptr ? std::max(1, static_cast<int>(std::lround(count * std::stod(given)))) : count;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// Fewer of them under sanitizers, where each takes several times as long: Release builds draw them all.
inline int trials(int count, int under_sanitizers) { return trials(kSanitized ? under_sanitizers : count); }

/// One generator for each trial, so that a trial can be run without those before it.
class Randomness {
  public:
    explicit Randomness(int trial) : engine_(seed() * 1'000'003u + static_cast<std::uint64_t>(trial)) {}

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    bool chance(double probability) { return between(0.0, 1.0) < probability; }
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
    glm::dvec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v = vector(1.0);
            const double length = glm::length(v);
            if (length > 0.1 && length < 1.0) return v / length;
        }
    }
    Attitude attitude() {
        // A third of them are exact, as most of those in a scene file.
        if (chance(0.33)) return {{90.0 * below(4)}, {30.0 * (below(7) - 3)}, {90.0 * (below(4) - 1)}};
        return {{between(0, 360)}, {between(-90, 90)}, {between(-180, 180)}};
    }

  private:
    std::mt19937_64 engine_;
};

/// Where a body must look to see a point ahead.
inline Attitude attitude_towards(const glm::dvec3& ahead, double roll) {
    return {Degrees::from_radians(std::atan2(ahead.x, ahead.y)),
            Degrees::from_radians(std::atan2(ahead.z, std::hypot(ahead.x, ahead.y))),
            {roll}};
}

}  // namespace quadrig::test
