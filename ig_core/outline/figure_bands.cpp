#include "ig_core/outline/figure_bands.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Rows on which a solid without bands is looked at to begin with, and how closely a change between two is closed in
/// on.
constexpr int kFirstRows = 256;
constexpr double kChange = 1e-12;
/// Of the window's width: level boundaries shorter than this are rounding, and lines this close are one.
constexpr double kLevel = 1e-4;
/// Of the window's height: bands further apart have nothing between them, and thinner ones are rounding.
constexpr double kGap = 1e-5;

/// Which boundary a cut's end was, by the nearest of all candidates.
Boundary boundary_at(const Outline& outline, double xi, double zeta) {
    if (std::isinf(xi)) return {xi < 0.0 ? Boundary::Kind::left_end : Boundary::Kind::right_end, 0};
    Boundary best;
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

SeenBand look_at_row(const Outline& outline, double zeta) {
    std::array<Cut, kMaxCuts> cuts;
    const int count = cuts_on_row_directly(outline, outline.solid.z0 + zeta, cuts.data());
    SeenBand seen;
    const auto add = [&](double x, int surface) {
        seen.boundaries.push_back(boundary_at(outline, x - outline.solid.x0, zeta));
        seen.surfaces.push_back(surface);
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        if (i > 0 && cuts[i].from > cuts[i - 1].to) add(cuts[i - 1].to, kNoSurface);
        add(cuts[i].from, cuts[i].surface);
    }
    if (count > 0) add(cuts[static_cast<std::size_t>(count) - 1].to, kNoSurface);
    return seen;
}

bool same_order(const SeenBand& a, const SeenBand& b) {
    return a.surfaces == b.surfaces &&
           std::equal(a.boundaries.begin(), a.boundaries.end(), b.boundaries.begin(), b.boundaries.end(),
                      [](const Boundary& p, const Boundary& q) { return p.kind == q.kind && p.index == q.index; });
}

/// Adds the rows between `from` and `to` where the order changes.
void find_changes(const Outline& outline, double from, const SeenBand& below, double to, const SeenBand& above,
                  double closest, std::vector<double>& changes) {
    if (same_order(below, above)) return;
    const double middle = 0.5 * (from + to);
    if (to - from < closest) {
        changes.push_back(middle);
        return;
    }
    const SeenBand between = look_at_row(outline, middle);
    find_changes(outline, from, below, middle, between, closest, changes);
    find_changes(outline, middle, between, to, above, closest, changes);
}

std::vector<SeenBand> bands_by_row(const Outline& outline, double zeta_low, double zeta_high) {
    std::vector<double> changes{zeta_low};
    const auto row = [&](int i) { return zeta_low + (zeta_high - zeta_low) * i / kFirstRows; };
    SeenBand last = look_at_row(outline, zeta_low);
    for (int i = 1; i <= kFirstRows; ++i) {
        SeenBand next = look_at_row(outline, row(i));
        find_changes(outline, row(i - 1), last, row(i), next, kChange * (zeta_high - zeta_low), changes);
        last = std::move(next);
    }
    changes.push_back(zeta_high);
    // About a contact the two curves are one to within rounding, and each may be named in turn.
    const double thin = kGap * (zeta_high - zeta_low);
    changes.erase(std::unique(changes.begin(), changes.end() - 1, [&](double a, double b) { return b - a < thin; }),
                  changes.end() - 1);
    std::vector<SeenBand> bands;
    for (std::size_t i = 1; i < changes.size(); ++i) {
        SeenBand band = look_at_row(outline, 0.5 * (changes[i - 1] + changes[i]));
        band.zeta_from = changes[i - 1], band.zeta_to = changes[i];
        if (!band.boundaries.empty() && band.zeta_from < band.zeta_to) bands.push_back(std::move(band));
    }
    return bands;
}

struct Crossing {
    double xi;
    int surface;  ///< to the right of it
};
std::vector<Crossing> crossings(const Outline& outline, const SeenBand* band, double zeta) {
    std::vector<Crossing> all{{-kInfinity, kNoSurface}};
    if (band != nullptr)
        for (std::size_t i = 0; i < band->boundaries.size(); ++i)
            all.push_back(
                {std::max(all.back().xi, drawn_intercept(outline, band->boundaries[i], zeta)), band->surfaces[i]});
    return all;
}
int surface_in(const std::vector<Crossing>& crossings, double xi) {
    int surface = kNoSurface;
    for (const Crossing& crossing : crossings)
        if (crossing.xi <= xi) surface = crossing.surface;
    return surface;
}

/// Adds what changes from one band to the next all along a level stretch: an edge seen level, or a face seen edge-on.
void add_level_segments(const Outline& outline, const SeenBand* below, const SeenBand* above, double zeta,
                        const ImageWindow& window, std::vector<VisibleSegment>& segments) {
    const double x0 = outline.solid.x0, tolerance = kLevel * window.width();
    const auto low = crossings(outline, below, zeta), high = crossings(outline, above, zeta);
    std::vector<double> ends{window.x_from - x0, window.x_to - x0};
    for (const auto* side : {&low, &high})
        for (const Crossing& crossing : *side)
            if (crossing.xi > ends[0] && crossing.xi < ends[1]) ends.push_back(crossing.xi);
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const double from = ends[i - 1], to = ends[i], middle = 0.5 * (from + to);
        const int left = surface_in(high, middle), right = surface_in(low, middle);
        if (left == right || !(to - from > tolerance)) continue;
        const bool on_line = std::any_of(outline.lines.begin(), outline.lines.end(), [&](const EdgeLine& edge) {
            const auto near = [&](double xi) {
                return std::abs(edge.line.x * xi + edge.line.y + edge.line.z * zeta) <=
                       tolerance * std::hypot(edge.line.x, edge.line.z);
            };
            return near(from) && near(to);
        });
        const double z = outline.solid.z0 + zeta;
        segments.push_back({on_line ? StrokeKind::intersection_line : StrokeKind::intersection_curve, left, right,
                            clip({{x0 + from, z}, {x0 + to, z}}, window)});
    }
}

void add_segment(const Outline& outline, const SeenBand& band, std::size_t i, const ImageWindow& window,
                 std::vector<VisibleSegment>& segments) {
    const Boundary& boundary = band.boundaries[i];
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

double drawn_intercept(const Outline& outline, const Boundary& boundary, double zeta) {
    const bool rising = boundary.kind == Boundary::Kind::rising;
    if (!rising && boundary.kind != Boundary::Kind::falling) return intercept(outline, boundary, zeta);
    const RowConic& conic = outline.curves[boundary.index];
    const double beta = conic.beta_at(zeta), root = std::sqrt(std::max(0.0, conic.discriminant_at(zeta)));
    // The quotient gamma / (|beta| + root) carries the rounding of gamma's terms over that sum, (-beta +- root) / alpha
    // that of the sum over alpha.
    const double sum = std::abs(beta) + root, terms = std::abs(conic.gamma[0]) + std::abs(zeta * conic.gamma[1]) +
                                                      std::abs(zeta * zeta * conic.gamma[2]);
    if (sum * sum > terms * std::abs(conic.alpha)) return intercept(outline, boundary, zeta);
    return (rising ? root - beta : -(root + beta)) / conic.alpha;
}

std::vector<SeenBand> bands_in_window(const Outline& outline, const ImageWindow& window) {
    const double low = window.z_from - outline.solid.z0, high = window.z_to - outline.solid.z0;
    if (outline.direct) return bands_by_row(outline, low, high);
    std::vector<SeenBand> bands;
    if (outline.limb_only)
        bands.push_back({outline.zeta_from,
                         outline.zeta_to,
                         {{Boundary::Kind::rising, 0}, {Boundary::Kind::falling, 0}},
                         {0, kNoSurface}});
    for (const ZBand& band : outline.bands) {
        SeenBand seen{band.zeta_from, band.zeta_to, {}, {}};
        for (std::uint32_t i = band.first; i < band.first + band.count; ++i) {
            seen.boundaries.push_back(outline.boundaries[i]);
            seen.surfaces.push_back(outline.surfaces[i]);
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
