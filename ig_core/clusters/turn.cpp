#include "ig_core/clusters/turn.h"

#include <array>
#include <cmath>

namespace quadrig::clusters {
namespace {

/// Taylor's series by Horner's rule: first + x2 (... ), each coefficient the reciprocal of a factorial.
template <std::size_t N>
double series(double x2, const std::array<double, N>& reciprocals) {
    double sum = 0.0;
    for (std::size_t i = N; i-- > 0;) sum = reciprocals[i] + x2 * sum;
    return sum;
}

// 1/n! with alternating signs; |x| <= pi/4 leaves less than 1e-19.
constexpr std::array<double, 9> kSine{1.0,
                                      -1.0 / 6.0,
                                      1.0 / 120.0,
                                      -1.0 / 5040.0,
                                      1.0 / 362880.0,
                                      -1.0 / 39916800.0,
                                      1.0 / 6227020800.0,
                                      -1.0 / 1307674368000.0,
                                      1.0 / 355687428096000.0};
constexpr std::array<double, 9> kCosine{1.0,
                                        -1.0 / 2.0,
                                        1.0 / 24.0,
                                        -1.0 / 720.0,
                                        1.0 / 40320.0,
                                        -1.0 / 3628800.0,
                                        1.0 / 479001600.0,
                                        -1.0 / 87178291200.0,
                                        1.0 / 20922789888000.0};

}  // namespace

SineCosine sine_cosine(Degrees angle) {
    const double turned = std::fmod(angle.value, 360.0);      // exact
    const double quarters = std::floor(turned / 90.0 + 0.5);  // -4..4
    const double rest = turned - 90.0 * quarters;             // exact: the two are within a factor of 2
    const double x = Degrees{rest}.radians();
    const double s = x * series(x * x, kSine), c = series(x * x, kCosine);
    switch ((static_cast<int>(quarters) + 4) % 4) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

glm::dmat3 body_from_scene(const Attitude& attitude) {
    return eye_from_scene_rotation(sine_cosine(attitude.heading), sine_cosine(attitude.pitch),
                                   sine_cosine(attitude.roll));
}

}  // namespace quadrig::clusters
