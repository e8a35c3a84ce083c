#include "ig_core/geometry/symmetric.h"

#include <catch2/catch.hpp>
#include <glm/matrix.hpp>

#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

glm::dmat3 full(const Sym3& m) { return {m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz}; }

void check_same(const glm::dmat3& a, const glm::dmat3& b) {
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) REQUIRE(a[c][r] == Approx(b[c][r]).margin(1e-13));
}

}  // namespace

TEST_CASE("symmetric forms compute what full matrices do") {
    CAPTURE(seed());
    for (int trial = 0; trial < trials(200); ++trial) {
        Randomness random(trial);
        const auto entry = [&] { return random.between(-1, 1); };
        const Sym3 m{entry(), entry(), entry(), entry(), entry(), entry()};
        const Sym3 n{entry(), entry(), entry(), entry(), entry(), entry()};
        const glm::dvec3 a = random.vector(1), b = random.vector(1), v = random.vector(1);
        const glm::dmat3 t{random.vector(1), random.vector(1), random.vector(1)};
        CAPTURE(trial);
        check_same(full(m + n), full(m) + full(n));
        check_same(full(m - 2.0 * n), full(m) - 2.0 * full(n));
        REQUIRE(glm::length(m * v - full(m) * v) < 1e-15);
        REQUIRE(value(m, v) == Approx(glm::dot(v, full(m) * v)).margin(1e-14));
        REQUIRE(value(m, a, b) == Approx(glm::dot(a, full(m) * b)).margin(1e-14));
        check_same(full(outer(a)), glm::outerProduct(a, a));
        check_same(full(outer(a, b)), glm::outerProduct(a, b) + glm::outerProduct(b, a));
        check_same(full(congruent(m, t)), glm::transpose(t) * full(m) * t);
        const glm::dvec3 moment = glm::cross(a, v);
        REQUIRE(value(through_cross(m, a), v) == Approx(value(m, moment)).margin(1e-13));
        REQUIRE(value(through_cross(m, a), v, b) == Approx(value(m, moment, glm::cross(a, b))).margin(1e-13));
    }
}
