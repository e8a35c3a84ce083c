#include "ig_core/outline/row_order.h"

#include <algorithm>
#include <cmath>

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Candidate {
    double xi;
    Boundary boundary;
};

/// Every place on a row where the visible surface may change, sorted. Of a bounded solid only what lies on it counts.
std::size_t candidates_on_row(const Outline& outline, double zeta, std::array<Candidate, RowOrder::kCapacity>& out) {
    const EyeSolid& e = outline.solid;
    std::size_t count = 0;
    const auto add = [&](double xi, Boundary boundary) {
        if (std::isfinite(xi) && count < out.size()) out[count++] = {xi, boundary};
    };
    const auto add_roots = [&](std::uint16_t curve, auto&& on_solid) {
        if (!outline.direct && !outline.curves[curve].rows.may_hold(zeta)) return;
        if (misses_row(outline.curves[curve], zeta)) return;
        const RowRoots roots = roots_on_row(outline.curves[curve], zeta);
        if (on_solid(roots.rising)) add(roots.rising, {Boundary::Kind::rising, curve});
        if (on_solid(roots.falling)) add(roots.falling, {Boundary::Kind::falling, curve});
    };
    // The point at k = over/under on the ray; where `under` is little more than rounding, nothing is known of it.
    const auto kept = [&](const glm::dvec3& d, double over, double under, const EyePlane* own) {
        constexpr double kUnknown = 1e-8;
        if (outline.direct || !(std::abs(under) > kUnknown * glm::dot(d, d))) return true;
        const double k = over / under;
        return k > 0.0 && kept_by_planes(e, k * d, own);
    };
    add_roots(0, [&](double xi) {
        const glm::dvec3 d(xi, 1.0, zeta);
        return kept(d, -glm::dot(e.v, d), value(e.m, d), nullptr);
    });
    std::uint16_t curve = 1;
    for (const EyePlane& plane : e.planes) {
        if (!plane.cuts) continue;
        add_roots(curve++, [&](double xi) {
            const glm::dvec3 d(xi, 1.0, zeta);
            return kept(d, -plane.at_eye, glm::dot(plane.normal, d), &plane);
        });
    }
    for (std::uint16_t i = 0; i < outline.lines.size(); ++i)
        if (zeta >= outline.lines[i].zeta_from && zeta <= outline.lines[i].zeta_to)
            add(outline.lines[i].on_row(zeta), {Boundary::Kind::line, i});
    std::sort(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Candidate& a, const Candidate& b) { return a.xi < b.xi; });
    return count;
}

}  // namespace

void solve_row(const Outline& outline, double zeta, RowOrder& order) {
    order.clear();
    std::array<Candidate, RowOrder::kCapacity> candidates;
    const std::size_t count = candidates_on_row(outline, zeta, candidates);
    int surface = kNoSurface;
    double left = -kInfinity;
    Boundary left_boundary{Boundary::Kind::left_end, 0};
    for (std::size_t i = 0; i <= count; ++i) {
        const double right = i < count ? candidates[i].xi : kInfinity;
        const bool outside = (i == 0 || i == count) && !outline.direct;  // of a bounded solid: nothing is there
        if (outside && surface != kNoSurface) order.add(left_boundary, surface = kNoSurface);
        if (!outside && right - left > kSliver) {
            // Where nothing changes any place will do but the object's own middle, which a limb may touch.
            constexpr double kAnywhere = 0.618;
            double xi = typical_between(left, right);
            if (!std::isfinite(left))
                xi = std::isfinite(right) ? right - 1.0 - std::abs(right) : kAnywhere;
            else if (!std::isfinite(right))
                xi = left + 1.0 + std::abs(left);
            const int here = surface_at(outline.solid, xi, zeta);
            if (here != surface) order.add(left_boundary, here);
            surface = here;
        }
        if (i < count) {
            left = right;
            left_boundary = candidates[i].boundary;
        }
    }
    if (surface != kNoSurface) order.add({Boundary::Kind::right_end, 0}, kNoSurface);
}

}  // namespace quadrig
