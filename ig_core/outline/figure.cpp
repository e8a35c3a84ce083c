#include "ig_core/outline/figure.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ig_core/outline/figure_bands.h"

namespace quadrig {
namespace {

/// Rows of the grid that an outline is asked for: many more than any drawing has, so that no band falls between two.
constexpr int kRows = 1 << 24;
/// Of the window's width: key points closer than this are one.
constexpr double kSamePoint = 1e-9;
/// Relative to the terms of a sum: what may be rounding.
constexpr double kRounding = 1e-12;
/// A point whose form is this small beside its terms lies on the curve.
constexpr double kOnCurve = 1e-7;

/// Adds the zeros of c[0] + c[1] zeta + c[2] zeta^2; where they are complex, their real part, at which the polynomial
/// comes closest to zero.
void add_zeros(const std::array<double, 3>& c, std::vector<double>& zetas) {
    const double half = 0.5 * c[1];
    const double q = -(half + std::copysign(std::sqrt(std::max(0.0, half * half - c[2] * c[0])), half));
    zetas.insert(zetas.end(), {q / c[2], c[0] / q});
}

/// The row along which a curve goes off to either side, where it has one.
std::optional<double> asymptote_row(const RowConic& conic) {
    if (!(std::abs(conic.alpha) < kRounding * std::abs(conic.beta[1]))) return std::nullopt;
    return -conic.beta[0] / conic.beta[1];
}

/// Rows, in order, between which a curve is smooth: the window's ends, the extrema, where two lines cross, and the row
/// that an asymptote takes.
std::vector<double> rows_of(const RowConic& conic, double zeta_from, double zeta_to) {
    std::vector<double> rows;
    add_zeros(conic.discriminant, rows);
    if (const auto row = asymptote_row(conic)) rows.push_back(*row);
    std::erase_if(rows, [&](double zeta) { return !(zeta > zeta_from && zeta < zeta_to); });
    rows.insert(rows.end(), {zeta_from, zeta_to});
    std::sort(rows.begin(), rows.end());
    return rows;
}

/// A curve that is nothing but level lines.
std::vector<double> level_rows(const RowConic& conic, double zeta_from, double zeta_to) {
    std::vector<double> rows;
    add_zeros(conic.gamma, rows);
    std::erase_if(rows, [&](double zeta) {
        const double terms =
            std::abs(conic.gamma[0]) + std::abs(conic.gamma[1] * zeta) + std::abs(conic.gamma[2] * zeta * zeta);
        return !(zeta > zeta_from && zeta < zeta_to) || std::abs(conic.gamma_at(zeta)) > kRounding * terms;
    });
    return rows;
}

/// All of a curve in the window. `behind(d)` tells where its points lie behind the eye.
template <class Behind>
std::vector<Polyline> whole_curve(const Outline& outline, std::size_t curve, const ImageWindow& window,
                                  Behind&& behind) {
    const double x0 = outline.solid.x0, z0 = outline.solid.z0;
    const RowConic& conic = outline.curves[curve];
    const double low = window.z_from - z0, high = window.z_to - z0;
    std::vector<Polyline> pieces;
    if (is_level(conic, window)) {
        for (const double zeta : level_rows(conic, low, high))
            if (!behind(glm::dvec3(0.0, 1.0, zeta)))
                pieces.push_back({{window.x_from, z0 + zeta}, {window.x_to, z0 + zeta}});
        return pieces;
    }
    const std::vector<double> ends = rows_of(conic, low, high);
    const auto asymptote = asymptote_row(conic);
    // On the row itself rounding would say to which side, and a chord to there would cross the window.
    const auto is_asymptote = [&](double zeta) {
        return asymptote && std::abs(zeta - *asymptote) <= kRounding * (std::abs(z0) + std::abs(*asymptote));
    };
    for (std::size_t i = 1; i < ends.size(); ++i) {
        if (!(conic.discriminant_at(0.5 * (ends[i - 1] + ends[i])) > 0.0)) continue;
        for (const auto kind : {Boundary::Kind::rising, Boundary::Kind::falling}) {
            const Boundary side{kind, static_cast<std::uint16_t>(curve)};
            const auto x_at = [&](double z) {
                const double zeta = z - z0, xi = drawn_intercept(outline, side, zeta);
                return is_asymptote(zeta) || behind(glm::dvec3(xi, 1.0, zeta))
                           ? std::numeric_limits<double>::quiet_NaN()
                           : x0 + xi;
            };
            const double tolerance = kFigureTolerance * window.width();
            for (const Polyline& path : follow(z0 + ends[i - 1], z0 + ends[i], x_at, window, tolerance))
                for (Polyline& piece : clip(path, window)) pieces.push_back(std::move(piece));
        }
    }
    return pieces;
}

/// A line of the outline's own image coordinates across the window.
std::vector<Polyline> whole_line(const EyeSolid& e, const glm::dvec3& line, const ImageWindow& window) {
    if (!(std::hypot(line.x, line.z) > 0.0)) return {};
    return line_across({line.x, line.y - line.x * e.x0 - line.z * e.z0, line.z}, window);
}

bool is_seen(const std::vector<SeenBand>& bands, std::size_t curve) {
    return std::any_of(bands.begin(), bands.end(), [&](const SeenBand& band) {
        return std::any_of(band.boundaries.begin(), band.boundaries.end(), [&](const Boundary& boundary) {
            return boundary.index == curve &&
                   (boundary.kind == Boundary::Kind::rising || boundary.kind == Boundary::Kind::falling);
        });
    });
}

std::vector<Stroke> find_strokes(const Outline& outline, const std::vector<SeenBand>& bands,
                                 const ImageWindow& window) {
    const EyeSolid& e = outline.solid;
    std::vector<Stroke> strokes;
    strokes.push_back({StrokeKind::limb, 0, 0, whole_curve(outline, 0, window, [&](const glm::dvec3& d) {
                           return glm::dot(e.v, d) * value(e.m, d) > 0.0;  // k = -B/A
                       })});
    std::size_t curve = 0;
    std::vector<const EyePlane*> planes;
    for (const EyePlane& plane : e.planes) {
        if (!plane.cuts) continue;
        ++curve;
        // Of the bounds that are not the file's (near, infinity) only what shows.
        if (plane.surface <= 0 && !is_seen(bands, curve)) continue;
        planes.push_back(&plane);
        strokes.push_back({StrokeKind::intersection_curve, plane.surface, 0,
                           whole_curve(outline, curve, window, [&](const glm::dvec3& d) {
                               return plane.at_eye * glm::dot(plane.normal, d) > 0.0;  // k = -b / n.d
                           })});
    }
    for (const EyePlane* plane : planes)
        strokes.push_back(
            {StrokeKind::visibility_line, plane->surface, 0, whole_line(e, visibility_line(e, *plane), window)});
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (glm::length(glm::cross(planes[i]->normal, planes[j]->normal)) > 0.0)
                strokes.push_back({StrokeKind::intersection_line, planes[j]->surface, planes[i]->surface,
                                   whole_line(e, intersection_line(e, *planes[i], *planes[j]), window)});
    std::erase_if(strokes, [](const Stroke& stroke) { return stroke.pieces.empty(); });
    return strokes;
}

bool lies_on(const RowConic& conic, const KeyPoint& key) {
    const double quadratic = conic.alpha * key.xi * key.xi, linear = 2.0 * conic.beta_at(key.zeta) * key.xi,
                 constant = conic.gamma_at(key.zeta);
    return std::abs(quadratic + linear + constant) <=
           kOnCurve * (std::abs(quadratic) + std::abs(linear) + std::abs(constant));
}

FigureKeyPoint::Kind kind_of(const Outline& outline, const KeyPoint& key) {
    switch (key.kind) {
        case KeyPoint::Kind::limb_extremum:
            return FigureKeyPoint::Kind::limb_extremum;
        case KeyPoint::Kind::curve_extremum:
            return FigureKeyPoint::Kind::curve_extremum;
        case KeyPoint::Kind::contact:
            return FigureKeyPoint::Kind::contact;
        case KeyPoint::Kind::edge_end:
            break;
    }
    const bool on_quadric = std::any_of(outline.curves.begin() + 1, outline.curves.end(),
                                        [&](const RowConic& curve) { return lies_on(curve, key); });
    return on_quadric ? FigureKeyPoint::Kind::intersection : FigureKeyPoint::Kind::triplet;
}

bool is_on(const std::vector<VisibleSegment>& segments, const glm::dvec2& p, double tolerance) {
    return std::any_of(segments.begin(), segments.end(), [&](const VisibleSegment& segment) {
        return std::any_of(segment.pieces.begin(), segment.pieces.end(),
                           [&](const Polyline& piece) { return distance(p, piece) < tolerance; });
    });
}

std::vector<FigureKeyPoint> find_visible_key_points(const Outline& outline, const std::vector<VisibleSegment>& segments,
                                                    const ImageWindow& window) {
    std::vector<FigureKeyPoint> points;
    const auto add = [&](FigureKeyPoint::Kind kind, double xi, double zeta) {
        const glm::dvec2 at(outline.solid.x0 + xi, outline.solid.z0 + zeta);
        if (at.x < window.x_from || at.x > window.x_to || at.y < window.z_from || at.y > window.z_to) return;
        // An outline may keep one that is out of sight.
        if (!is_on(segments, at, kFigureTolerance * window.width())) return;
        const bool known = std::any_of(points.begin(), points.end(), [&](const FigureKeyPoint& other) {
            return other.kind == kind && glm::distance(other.at, at) < kSamePoint * window.width();
        });
        if (!known) points.push_back({kind, at});
    };
    for (const KeyPoint& key : outline.key_points) add(kind_of(outline, key), key.xi, key.zeta);
    if (outline.limb_only && outline.zeta_from < outline.zeta_to)
        for (const double zeta : {outline.zeta_from, outline.zeta_to})
            add(FigureKeyPoint::Kind::limb_extremum, -outline.curves[0].beta_at(zeta) / outline.curves[0].alpha, zeta);
    return points;
}

bool is_key_height(const Figure& figure, double z) {
    return std::any_of(figure.key_points.begin(), figure.key_points.end(), [&](const FigureKeyPoint& key) {
        return std::abs(key.at.y - z) <= kSamePoint * figure.window.height();
    });
}

}  // namespace

Figure make_figure(const Solid& solid, const ScenePoint& eye, const glm::dmat3& eye_from_scene,
                   const ImageWindow& window) {
    Outline outline;
    make_outline(solid, 0, eye, eye_from_scene, {window.z_to, window.height() / kRows, kRows}, outline);
    const std::vector<SeenBand> seen = bands_in_window(outline, window);
    Figure figure;
    figure.window = window;
    figure.solved_by_row = outline.direct;
    figure.strokes = find_strokes(outline, seen, window);
    figure.segments = visible_segments(outline, seen, window);
    figure.key_points = find_visible_key_points(outline, figure.segments, window);
    for (const SeenBand& band : seen) {
        const double from = outline.solid.z0 + band.zeta_from, to = outline.solid.z0 + band.zeta_to;
        if (figure.bands.empty() || outline.direct || is_key_height(figure, from))
            figure.bands.push_back({from, to});
        else
            figure.bands.back().z_to = to;
    }
    return figure;
}

}  // namespace quadrig
