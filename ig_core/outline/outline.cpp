#include "ig_core/outline/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "ig_core/outline/image_bounds.h"
#include "ig_core/outline/key_points.h"

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Boundaries closer than this (image-plane units; a pixel is 1e-5 at the least) are one: the sliver between them is
/// not asked.
constexpr double kSliver = 1e-12;
/// Boundaries of a band that come out of order by more than this are solved again on their row.
constexpr double kDisorder = 1e-11;

/// A discriminant this small beside its terms may be zero.
constexpr double kTouch = 1e-12;

struct Candidate {
    double xi;
    Boundary boundary;
};
constexpr std::size_t kMaxCandidates = 2 + 2 * (kMaxEyePlanes + 1) + kMaxEyePlanes * (kMaxEyePlanes - 1) / 2;

double line_on_row(const glm::dvec3& line, double zeta) { return -(line.y + line.z * zeta) / line.x; }

/// Whether the row is clear of the curve by more than rounding. A wedge's edge is a double line: it is touched
/// everywhere.
bool misses_row(const RowConic& conic, double zeta) {
    const double discriminant = conic.discriminant_at(zeta);
    if (discriminant >= 0.0) return false;
    const double beta = conic.beta_at(zeta);
    return discriminant < -kTouch * (beta * beta + std::abs(conic.alpha * conic.gamma_at(zeta)));
}

bool may_be_seen(const CurveRows& rows, double zeta) {
    constexpr double kRounding = 1e-9;
    return zeta >= rows.zeta_from - kRounding && zeta <= rows.zeta_to + kRounding;
}

/// Every place on a row where the visible surface may change, sorted. Of a bounded solid only what lies on it counts.
std::size_t candidates_on_row(const Outline& outline, double zeta, std::array<Candidate, kMaxCandidates>& out) {
    const EyeSolid& e = outline.solid;
    std::size_t count = 0;
    const auto add = [&](double xi, Boundary boundary) {
        if (std::isfinite(xi) && count < out.size()) out[count++] = {xi, boundary};
    };
    const auto add_roots = [&](std::uint16_t curve, auto&& on_solid) {
        if (!outline.direct && !may_be_seen(outline.curve_rows[curve], zeta)) return;
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
    for (int i = 0; i < e.plane_count; ++i) {
        const EyePlane& plane = e.planes[static_cast<std::size_t>(i)];
        if (!plane.cuts) continue;
        add_roots(curve++, [&](double xi) {
            const glm::dvec3 d(xi, 1.0, zeta);
            return kept(d, -plane.at_eye, glm::dot(plane.normal, d), &plane);
        });
    }
    for (std::uint16_t i = 0; i < outline.lines.size(); ++i)
        if (zeta >= outline.lines[i].zeta_from && zeta <= outline.lines[i].zeta_to)
            add(line_on_row(outline.lines[i].line, zeta), {Boundary::Kind::line, i});
    std::sort(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Candidate& a, const Candidate& b) { return a.xi < b.xi; });
    return count;
}

/// One row solved by itself. Calls `found(boundary, xi, surface)` for each place from left to right where the surface
/// to the right differs from the one to the left.
template <class Found>
void solve_row(const Outline& outline, double zeta, Found&& found) {
    std::array<Candidate, kMaxCandidates> candidates;
    const std::size_t count = candidates_on_row(outline, zeta, candidates);
    int surface = kNoSurface;
    double left = -kInfinity;
    Boundary left_boundary{Boundary::Kind::left_end, 0};
    for (std::size_t i = 0; i <= count; ++i) {
        const double right = i < count ? candidates[i].xi : kInfinity;
        const bool outside = (i == 0 || i == count) && !outline.direct;  // of a bounded solid: nothing is there
        if (outside && surface != kNoSurface) found(left_boundary, left, surface = kNoSurface);
        if (!outside && right - left > kSliver) {
            double middle = 0.5 * (left + right);
            if (!std::isfinite(left))
                middle = std::isfinite(right) ? right - 1.0 - std::abs(right) : 0.0;
            else if (!std::isfinite(right))
                middle = left + 1.0 + std::abs(left);
            const int here = surface_at(outline.solid, middle, zeta);
            if (here != surface) found(left_boundary, left, here);
            surface = here;
        }
        if (i < count) {
            left = right;
            left_boundary = candidates[i].boundary;
        }
    }
    if (surface != kNoSurface) found(Boundary{Boundary::Kind::right_end, 0}, kInfinity, kNoSurface);
}

void find_bands(const RowGrid& rows, Outline& out) {
    // The picture's edges, not its outermost rows: a picture of one row has a height, too.
    const double z_high = rows.top - out.solid.z0, z_low = z_high - rows.count * rows.step;
    auto& keys = out.key_points;
    std::sort(keys.begin(), keys.end(), [](const KeyPoint& a, const KeyPoint& b) { return a.zeta < b.zeta; });
    double from = z_low;
    const auto close_band = [&](double to) {
        to = std::min(to, z_high);
        if (!(to > from)) return;
        // A band without a row of the grid needs no answer.
        const double first_row = std::ceil((rows.top - (to + out.solid.z0)) / rows.step - 0.5 - 1e-9);
        const double last_row = std::floor((rows.top - (from + out.solid.z0)) / rows.step - 0.5 + 1e-9);
        if (last_row >= first_row) {
            const auto first = static_cast<std::uint32_t>(out.boundaries.size());
            solve_row(out, 0.5 * (from + to), [&](Boundary boundary, double, int surface) {
                out.boundaries.push_back(boundary);
                out.surfaces.push_back(static_cast<std::int8_t>(surface));
            });
            const auto count = static_cast<std::uint32_t>(out.boundaries.size()) - first;
            if (count > 0) out.bands.push_back({from, to, first, count});
        }
        from = to;
    };
    for (const KeyPoint& key : keys)
        if (key.zeta > from) close_band(key.zeta);
    close_band(kInfinity);
    if (out.bands.empty()) {
        out.zeta_from = 1.0, out.zeta_to = -1.0;
    } else {
        out.zeta_from = out.bands.front().zeta_from, out.zeta_to = out.bands.back().zeta_to;
    }
}

}  // namespace

double intercept(const Outline& outline, const Boundary& boundary, double zeta) {
    switch (boundary.kind) {
        case Boundary::Kind::rising:
            return rising_on_row(outline.curves[boundary.index], zeta);
        case Boundary::Kind::falling:
            return falling_on_row(outline.curves[boundary.index], zeta);
        case Boundary::Kind::line:
            return line_on_row(outline.lines[boundary.index].line, zeta);
        case Boundary::Kind::left_end:
            return -kInfinity;
        case Boundary::Kind::right_end:
            return kInfinity;
    }
    return kInfinity;
}

void make_outline(const Solid& solid, std::uint32_t object, const ScenePoint& eye, const glm::dmat3& eye_from_scene,
                  const RowGrid& rows, Outline& out, SetUp set_up) {
    out.object = object;
    out.lines.clear();
    out.key_points.clear();
    out.bands.clear();
    out.boundaries.clear();
    out.surfaces.clear();
    out.curves.clear();
    out.curve_rows.clear();

    const ImageBounds bounds = image_bounds(solid, eye, eye_from_scene);
    const bool near_plane = !bounds.in_front();
    out.near_u = bounds.near_u();
    out.far_u = bounds.farthest > 0.0 ? 1.0 / bounds.farthest : 0.0;
    const bool endless = solid.may_be_endless;
    look_at(solid, eye, eye_from_scene, near_plane, endless, set_up, out.solid);

    out.direct = endless;
    out.limb_only = solid.planes.empty() && !near_plane && !endless;
    out.curves.push_back(limb_on_rows(out.solid));
    out.curve_rows.emplace_back();
    if (out.limb_only) {
        const RowConic& limb = out.curves[0];
        // The quadric's silhouette spans the rows between its two extrema: b +- sqrt(b^2 - a c) of the row
        // discriminant.
        const double a = limb.discriminant[2], b = 0.5 * limb.discriminant[1], c = limb.discriminant[0];
        const double root = std::sqrt(std::max(0.0, b * b - a * c));
        out.zeta_from = (-b + root) / a, out.zeta_to = (-b - root) / a;  // a < 0
        if (!(a < 0.0 && out.zeta_from < out.zeta_to)) out.zeta_from = 1.0, out.zeta_to = -1.0;
        out.curve_rows[0] = {out.zeta_from, out.zeta_to};
        return;
    }
    find_boundaries(out);
    if (out.direct) {
        out.zeta_from = -kInfinity, out.zeta_to = kInfinity;
        return;
    }
    find_key_points(out);
    find_bands(rows, out);
}

int cuts_on_row_directly(const Outline& outline, double z, Cut* cuts) {
    int count = 0;
    bool open = false;
    solve_row(outline, z - outline.solid.z0, [&](const Boundary&, double xi, int surface) {
        const double x = outline.solid.x0 + xi;
        if (open) {
            cuts[count].to = x;
            ++count;
        }
        open = surface != kNoSurface && count < kMaxCuts;
        if (open) cuts[count] = {x, x, surface};
    });
    return count;
}

void limb_on_lines(const Outline& outline, const double* z, std::size_t count, double* from, double* to) {
    // In the object's own image coordinates beta is small beside the root and alpha far from 0: nothing cancels.
    const RowConic& limb = outline.curves[0];
    const double inverse = 1.0 / limb.alpha, x0 = outline.solid.x0, z0 = outline.solid.z0;
    for (std::size_t i = 0; i < count; ++i) {
        const double zeta = z[i] - z0;
        const double discriminant = limb.discriminant_at(zeta), middle = x0 - limb.beta_at(zeta) * inverse;
        const double reach = -std::sqrt(std::max(0.0, discriminant)) * inverse;  // alpha < 0
        from[i] = discriminant > 0.0 ? middle - reach : 1.0;
        to[i] = discriminant > 0.0 ? middle + reach : 0.0;
    }
}

int cuts_on_row(const Outline& outline, double z, Cut* cuts) {
    const std::optional<int> count = cuts_by_band(outline, z, cuts);
    return count ? *count : cuts_on_row_directly(outline, z, cuts);
}

std::optional<int> cuts_by_band(const Outline& outline, double z, Cut* cuts) {
    const double zeta = z - outline.solid.z0, x0 = outline.solid.x0;
    if (zeta < outline.zeta_from || zeta > outline.zeta_to) return 0;
    if (outline.direct) return std::nullopt;
    if (outline.limb_only) {
        limb_on_lines(outline, &z, 1, &cuts[0].from, &cuts[0].to);
        cuts[0].surface = 0;
        return cuts[0].from < cuts[0].to ? 1 : 0;
    }
    const auto band = std::lower_bound(outline.bands.begin(), outline.bands.end(), zeta,
                                       [](const ZBand& b, double at) { return b.zeta_to < at; });
    if (band == outline.bands.end() || zeta < band->zeta_from) return 0;
    int count = 0;
    double left = -kInfinity;
    int surface = kNoSurface;
    for (std::uint32_t i = band->first; i < band->first + band->count; ++i) {
        double xi = intercept(outline, outline.boundaries[i], zeta);
        if (!(xi >= left)) {
            if (!(xi >= left - kDisorder)) return std::nullopt;
            xi = left;
        }
        if (surface != kNoSurface && xi > left && count < kMaxCuts) cuts[count++] = {x0 + left, x0 + xi, surface};
        left = xi;
        surface = outline.surfaces[i];
    }
    return count;
}

}  // namespace quadrig
