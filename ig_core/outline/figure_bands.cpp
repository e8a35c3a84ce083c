#include "ig_core/outline/figure_bands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "ig_core/outline/boundary_lanes.h"

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Rows on which a solid without bands is looked at to begin with, and how closely a change between two is closed in
/// on.
constexpr int kFirstRows = 256;
constexpr double kChange = 1e-12;
/// Of the window's width: level boundaries shorter than this are rounding, and lines this close are one.
constexpr double kLevel = 1e-4;
/// A form that changes by this much less along a row than across rows is level.
constexpr double kLevelCurve = 1e-12;
/// Of the window's height: how far from a level boundary it is asked what lies on either side.
constexpr double kInside = 1e-10;
/// Of the window's height: bands further apart have nothing between them, and thinner ones are rounding.
constexpr double kGap = 1e-5;

/// Which boundary a cut's end was, by the nearest of all candidates.
Boundary boundary_at(const Outline& outline, double xi, double zeta) {
    if (std::isinf(xi)) return {xi < 0.0 ? Boundary::Kind::left_end : Boundary::Kind::right_end, 0};
    Boundary best{Boundary::Kind::line, 0};
    double nearest = kInfinity;
    const auto consider = [&](Boundary::Kind kind, std::size_t index) {
        const Boundary boundary{kind, static_cast<std::uint16_t>(index)};
        const double distance = std::abs(intercept(outline, boundary, zeta) - xi);
        if (distance < nearest) nearest = distance, best = boundary;
    };
    for (std::size_t i = 0; i < outline.curves.size(); ++i) {
        consider(Boundary::Kind::rising, i);
        consider(Boundary::Kind::falling, i);
    }
    for (std::size_t i = 0; i < outline.lines.size(); ++i) consider(Boundary::Kind::line, i);
    return best;
}

/// One row of the window: what lies beside it counts as endless.
SeenBand look_at_row(const Outline& outline, double zeta, const ImageWindow& window) {
    std::array<Cut, kMaxCuts> cuts;
    const int count = cuts_on_row_directly(outline, outline.solid.z0 + zeta, cuts.data());
    SeenBand seen;
    double reached = -kInfinity;
    const auto add = [&](double xi, int surface) {
        seen.boundaries.push_back(boundary_at(outline, xi, zeta));
        seen.surfaces.push_back(surface);
    };
    for (const Cut& cut : std::span(cuts).first(static_cast<std::size_t>(count))) {
        if (!(cut.from < window.x_to && cut.to > window.x_from)) continue;
        if (!seen.surfaces.empty() && cut.from - outline.solid.x0 > reached) add(reached, kNoSurface);
        add(cut.from > window.x_from ? cut.from - outline.solid.x0 : -kInfinity, cut.surface);
        reached = cut.to < window.x_to ? cut.to - outline.solid.x0 : kInfinity;
    }
    if (!seen.surfaces.empty()) add(reached, kNoSurface);
    return seen;
}

bool same_order(const SeenBand& a, const SeenBand& b) {
    return a.surfaces == b.surfaces &&
           std::equal(a.boundaries.begin(), a.boundaries.end(), b.boundaries.begin(), b.boundaries.end(),
                      [](const Boundary& p, const Boundary& q) { return p.kind == q.kind && p.index == q.index; });
}

/// Adds the rows between `from` and `to` where the order changes.
void find_changes(const Outline& outline, double from, const SeenBand& below, double to, const SeenBand& above,
                  double closest, const ImageWindow& window, std::vector<double>& changes) {
    if (same_order(below, above)) return;
    const double middle = 0.5 * (from + to);
    if (to - from < closest) {
        changes.push_back(middle);
        return;
    }
    const SeenBand between = look_at_row(outline, middle, window);
    find_changes(outline, from, below, middle, between, closest, window, changes);
    find_changes(outline, middle, between, to, above, closest, window, changes);
}

std::vector<SeenBand> bands_by_row(const Outline& outline, const ImageWindow& window) {
    const double zeta_low = window.z_from - outline.solid.z0, zeta_high = window.z_to - outline.solid.z0;
    std::vector<double> changes{zeta_low};
    const auto row = [&](int i) { return zeta_low + (zeta_high - zeta_low) * i / kFirstRows; };
    SeenBand last = look_at_row(outline, zeta_low, window);
    for (int i = 1; i <= kFirstRows; ++i) {
        SeenBand next = look_at_row(outline, row(i), window);
        find_changes(outline, row(i - 1), last, row(i), next, kChange * (zeta_high - zeta_low), window, changes);
        last = std::move(next);
    }
    changes.push_back(zeta_high);
    // About a contact the two curves are one to within rounding, and each may be named in turn.
    const double thin = kGap * (zeta_high - zeta_low);
    changes.erase(std::unique(changes.begin(), changes.end() - 1, [&](double a, double b) { return b - a < thin; }),
                  changes.end() - 1);
    std::vector<SeenBand> bands;
    for (std::size_t i = 1; i < changes.size(); ++i) {
        SeenBand band = look_at_row(outline, 0.5 * (changes[i - 1] + changes[i]), window);
        band.zeta_from = changes[i - 1], band.zeta_to = changes[i];
        if (!band.boundaries.empty() && band.zeta_from < band.zeta_to) bands.push_back(std::move(band));
    }
    return bands;
}

/// Whether a boundary runs level, and so crosses rows nowhere in the window.
bool is_level(const Outline& outline, const Boundary& boundary, const ImageWindow& window) {
    return (boundary.kind == Boundary::Kind::rising || boundary.kind == Boundary::Kind::falling) &&
           is_level(outline.curves[boundary.index], window);
}

/// Whether a point is within `tolerance` in z of a curve that runs level there.
bool is_level_at(const RowConic& conic, double xi, double zeta, double tolerance) {
    const double value = conic.alpha * xi * xi + 2.0 * conic.beta_at(zeta) * xi + conic.gamma_at(zeta);
    const double slope = 2.0 * conic.beta[1] * xi + conic.gamma[1] + 2.0 * zeta * conic.gamma[2];
    return std::abs(value) <= tolerance * std::abs(slope);
}

/// Adds what changes from one band to the next all along a level stretch: an edge seen level, a face seen edge-on.
void add_level_segments(const Outline& outline, const SeenBand* below, const SeenBand* above, double zeta,
                        const ImageWindow& window, std::vector<VisibleSegment>& segments) {
    const double x0 = outline.solid.x0, tolerance = kLevel * window.width(), inside = kInside * window.height();
    std::vector<double> ends{window.x_from - x0, window.x_to - x0};
    for (const SeenBand* band : {below, above}) {
        if (band == nullptr) continue;
        for (const Boundary& boundary : band->boundaries) {
            const double xi = drawn_intercept(outline, boundary, zeta);
            if (xi > ends[0] && xi < ends[1] && !is_level(outline, boundary, window)) ends.push_back(xi);
        }
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const double from = ends[i - 1], to = ends[i], middle = 0.5 * (from + to);
        const int left = surface_at(outline.solid, middle, zeta + inside);
        const int right = surface_at(outline.solid, middle, zeta - inside);
        if (left == right || !(to - from > tolerance)) continue;
        const bool on_line = std::any_of(outline.lines.begin(), outline.lines.end(), [&](const EdgeLine& edge) {
            const auto near = [&](double xi) {
                return std::abs(edge.line.x * xi + edge.line.y + edge.line.z * zeta) <=
                       tolerance * std::hypot(edge.line.x, edge.line.z);
            };
            return near(from) && near(to);
        });
        const double z = outline.solid.z0 + zeta;
        const StrokeKind kind = on_line ? StrokeKind::intersection_line
                                : is_level_at(outline.curves[0], middle, zeta, tolerance)
                                    ? StrokeKind::limb
                                    : StrokeKind::intersection_curve;
        segments.push_back({kind, left, right, clip({{x0 + from, z}, {x0 + to, z}}, window)});
    }
}

void add_segment(const Outline& outline, const SeenBand& band, std::size_t i, const ImageWindow& window,
                 std::vector<VisibleSegment>& segments) {
    const Boundary& boundary = band.boundaries[i];
    if (is_level(outline, boundary, window)) return;
    const double x0 = outline.solid.x0, z0 = outline.solid.z0;
    const auto x_at = [&](double z) { return x0 + drawn_intercept(outline, boundary, z - z0); };
    const double from = z0 + band.zeta_from, to = z0 + band.zeta_to;
    VisibleSegment segment;
    segment.left = i > 0 ? band.surfaces[i - 1] : kNoSurface;
    segment.right = band.surfaces[i];
    if (boundary.kind == Boundary::Kind::line) {
        segment.kind = StrokeKind::intersection_line;
        segment.pieces = clip({{x_at(from), from}, {x_at(to), to}}, window);
    } else if (boundary.kind == Boundary::Kind::rising || boundary.kind == Boundary::Kind::falling) {
        segment.kind = boundary.index == 0 ? StrokeKind::limb : StrokeKind::intersection_curve;
        for (const Polyline& path : follow(from, to, x_at, window, kFigureTolerance * window.width()))
            for (Polyline& piece : clip(path, window)) segment.pieces.push_back(std::move(piece));
    }
    if (!segment.pieces.empty()) segments.push_back(std::move(segment));
}

}  // namespace

bool is_level(const RowConic& conic, const ImageWindow& window) {
    const double w = window.width(), h = window.height();
    const double along = w * (std::abs(conic.alpha) * w + std::abs(conic.beta[0]) + std::abs(conic.beta[1]) * h);
    return along <=
           kLevelCurve * (std::abs(conic.gamma[0]) + h * (std::abs(conic.gamma[1]) + h * std::abs(conic.gamma[2])));
}

double drawn_intercept(const Outline& outline, const Boundary& boundary, double zeta) {
    const bool rising = boundary.kind == Boundary::Kind::rising;
    if (!rising && boundary.kind != Boundary::Kind::falling) return intercept(outline, boundary, zeta);
    const RowConic& conic = outline.curves[boundary.index];
    const double beta = conic.beta_at(zeta), root = std::sqrt(std::max(0.0, conic.discriminant_at(zeta)));
    // (-beta +- root) / alpha carries the rounding of its terms over alpha; the quotient gamma / (|beta| + root), that
    // of gamma's terms over the sum below it.
    const double beta_terms = std::abs(conic.beta[0]) + std::abs(zeta * conic.beta[1]) + root;
    const double gamma_terms =
        std::abs(conic.gamma[0]) + std::abs(zeta * conic.gamma[1]) + std::abs(zeta * zeta * conic.gamma[2]);
    if (beta_terms * (std::abs(beta) + root) > gamma_terms * std::abs(conic.alpha))
        return intercept(outline, boundary, zeta);
    if (std::numeric_limits<double>::epsilon() * beta_terms > std::abs(conic.alpha))
        return std::numeric_limits<double>::quiet_NaN();
    return (rising ? root - beta : -(root + beta)) / conic.alpha;
}

std::vector<SeenBand> bands_in_window(const Outline& outline, const ImageWindow& window) {
    const double low = window.z_from - outline.solid.z0, high = window.z_to - outline.solid.z0;
    if (outline.direct) return bands_by_row(outline, window);
    std::vector<SeenBand> bands;
    if (outline.limb_only)
        bands.push_back({outline.zeta_from,
                         outline.zeta_to,
                         {{Boundary::Kind::rising, 0}, {Boundary::Kind::falling, 0}},
                         {0, kNoSurface}});
    for (const ZBand& band : outline.bands) {
        SeenBand seen{band.zeta_from, band.zeta_to, {}, {}};
        for (std::uint32_t i = band.first; i < band.first + band.count; ++i) {
            seen.boundaries.push_back(outline.changes[i].boundary);
            seen.surfaces.push_back(outline.changes[i].surface);
        }
        bands.push_back(std::move(seen));
    }
    for (SeenBand& band : bands) {
        band.zeta_from = std::max(band.zeta_from, low);
        band.zeta_to = std::min(band.zeta_to, high);
    }
    std::erase_if(bands, [](const SeenBand& band) { return !(band.zeta_from < band.zeta_to); });
    return bands;
}

std::vector<VisibleSegment> visible_segments(const Outline& outline, const std::vector<SeenBand>& bands,
                                             const ImageWindow& window) {
    std::vector<VisibleSegment> segments;
    const double gap = kGap * window.height();
    const SeenBand* below = nullptr;
    for (const SeenBand& band : bands) {
        if (below != nullptr && band.zeta_from - below->zeta_to > gap) {
            add_level_segments(outline, below, nullptr, below->zeta_to, window, segments);
            below = nullptr;
        }
        if (below != nullptr || band.zeta_from > window.z_from - outline.solid.z0 + gap)
            add_level_segments(outline, below, &band, band.zeta_from, window, segments);
        for (std::size_t i = 0; i < band.boundaries.size(); ++i) add_segment(outline, band, i, window, segments);
        below = &band;
    }
    if (below != nullptr && below->zeta_to < window.z_to - outline.solid.z0 - gap)
        add_level_segments(outline, below, nullptr, below->zeta_to, window, segments);
    return segments;
}

}  // namespace quadrig
