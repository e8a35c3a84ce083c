#include "ig_core/outline/row_order.h"

#include <algorithm>
#include <cmath>

#include "ig_core/outline/boundary_lanes.h"

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Candidate {
    double xi;
    Boundary boundary;
};

/// Every place on a row where the visible surface may change, sorted. Of a bounded solid only what lies on it counts.
std::size_t candidates_on_row(const Outline& outline, double zeta, std::array<Candidate, RowOrder::kCapacity>& out) {
    std::size_t count = 0;
    const auto add = [&](double xi, Boundary boundary) {
        if (std::isfinite(xi) && count < out.size()) out[count++] = {xi, boundary};
    };
    const auto add_roots = [&](std::uint16_t curve, const EyePlane* plane) {
        if (!outline.direct && !outline.curves[curve].rows.may_hold(zeta)) return;
        if (misses_row(outline.curves[curve], zeta)) return;
        const RowRoots roots = roots_on_solid(outline, curve, plane, zeta);
        add(roots.rising, {Boundary::Kind::rising, curve});
        add(roots.falling, {Boundary::Kind::falling, curve});
    };
    add_roots(0, nullptr);
    std::uint16_t curve = 1;
    for (const EyePlane& plane : outline.solid.planes)
        if (plane.cuts) add_roots(curve++, &plane);
    for (std::uint16_t i = 0; i < outline.lines.size(); ++i) {
        const Boundary line{Boundary::Kind::line, i};
        if (zeta >= outline.lines[i].zeta_from && zeta <= outline.lines[i].zeta_to)
            add(intercept(outline, line, zeta), line);
    }
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
