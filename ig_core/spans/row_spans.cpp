#include "ig_core/spans/row_spans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ig_core/spans/depth_on_line.h"

namespace quadrig {
namespace {

/// Of surfaces at one depth the one with the smaller number is seen; objects have their place in the file.
constexpr std::uint32_t kMarkingPriority = 0xFFFEFFFFu;  // less their places: the last in the file is seen
constexpr std::uint32_t kGroundPriority = 0xFFFF0000u, kDeckPriority = 0xFFFF0001u, kSkyPriority = 0xFFFFFFFFu;

/// The part of a plane that lies in front of the eye and within edges, d' edge >= 0: a half-line of the row, clipped.
void add_plane(const Surface& surface, std::span<const glm::dvec3> edges, const PixelRow& row,
               std::vector<RowSpan>& spans) {
    RowSpan& span = empty_span(row, spans);
    span.surface = surface;
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i) {
        double from = 0.0, to = row.columns;
        const auto keep = [&](double at, double along_x) {
            const double end = row.column(-at / along_x);
            if (along_x > 0.0)
                from = std::max(from, end);
            else if (along_x < 0.0)
                to = std::min(to, end);
            else if (!(at > 0.0))
                to = from;
        };
        keep(surface.plane.at + surface.plane.along_z * row.z[i], surface.plane.along_x);  // 1/k > 0
        for (const glm::dvec3& edge : edges) keep(edge.y + edge.z * row.z[i], edge.x);
        span.from[i] = from, span.to[i] = std::max(from, to);
    }
    if (fit_columns(row, span))
        bound_depth(row, span);
    else
        spans.pop_back();
}

/// Integral of 2 sqrt(1 - t^2) from -1 to t: the part of a unit disc below t.
double disc_below(double t) {
    const double s = std::clamp(t, -1.0, 1.0);
    return s * std::sqrt(1.0 - s * s) + std::asin(s) + 0.5 * std::numbers::pi;
}

}  // namespace

bool fit_columns(const PixelRow& row, const double* line_from, const double* line_to, RowSpan& span) {
    const double width = row.columns;
    double least_from = width, most_from = 0.0, least_to = width, most_to = 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i) {
        // Ends may be infinite or NaN-free but far outside: clipping makes them columns of the image.
        const double from = span.from[i] = std::min(std::max(line_from[i], 0.0), width);
        const double to = span.to[i] = std::min(std::max(line_to[i], 0.0), width);
        // A line that misses it leaves no column covered whole. Nothing could foresee which one does: no branch.
        const bool seen = from < to;
        least_from = std::min(least_from, seen ? from : width), most_from = std::max(most_from, seen ? from : width);
        least_to = std::min(least_to, seen ? to : 0.0), most_to = std::max(most_to, seen ? to : 0.0);
    }
    if (!(least_from < most_to)) return false;
    if (row.point_samples) {
        span.outer_from = span.inner_from = static_cast<int>(std::ceil(least_from - 0.5));
        span.outer_to = span.inner_to = static_cast<int>(std::ceil(most_to - 0.5));
        return span.outer_from < span.outer_to;
    }
    // No column is negative: a conversion rounds down.
    const auto round_up = [](double column) {
        const int whole = static_cast<int>(column);
        return whole < column ? whole + 1 : whole;
    };
    span.outer_from = static_cast<int>(least_from);
    span.outer_to = round_up(most_to);
    const int inner_from = round_up(most_from), inner_to = static_cast<int>(least_to);
    span.inner_from = inner_from < inner_to ? inner_from : span.outer_to;
    span.inner_to = inner_from < inner_to ? inner_to : span.outer_to;
    return span.outer_from < span.outer_to;
}

void bound_depth(const PixelRow& row, RowSpan& span) {
    if (is_shallow(span.surface.near_u, span.surface.far_u)) return;
    std::size_t first = 0, last = static_cast<std::size_t>(row.sub_lines) - 1;
    while (!(span.from[first] < span.to[first])) ++first;
    while (!(span.from[last] < span.to[last])) --last;
    const TwoLines from{span.from[first], span.from[last]}, to{span.to[first], span.to[last]};
    const DepthOnTwoLines depth(span.surface, row, TwoLines{row.z[first], row.z[last]});
    const TwoLines least = depth.least(from, to), most = depth.most(from, to);
    span.surface.near_u = std::min(span.surface.near_u, std::max(most[0], most[1]));
    span.surface.far_u = std::max(span.surface.far_u, std::min(least[0], least[1]));
}

void add_plane_spans(const PlaneSurfaces& planes, std::span<const std::uint8_t> deck_opaque, const PixelRow& row,
                     std::vector<RowSpan>& spans) {
    Surface surface;
    surface.near_u = std::numeric_limits<double>::infinity();
    if (planes.has_ground) {
        surface.kind = Surface::Kind::ground;
        surface.priority = kGroundPriority;
        surface.plane = planes.ground;
        add_plane(surface, {}, row, spans);
    }
    for (std::size_t i = 0; i < planes.decks.size(); ++i) {
        surface.kind = Surface::Kind::deck;
        surface.opaque = deck_opaque[i] != 0;
        surface.index = static_cast<std::uint32_t>(i);
        surface.priority = kDeckPriority + static_cast<std::uint32_t>(i);
        surface.plane = planes.decks[i];
        add_plane(surface, {}, row, spans);
    }
    RowSpan& sky = empty_span(row, spans);
    sky.surface.priority = kSkyPriority;
    sky.surface.near_u = 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i) sky.to[i] = row.columns;
    fit_columns(row, sky);
}

void add_polygon_span(const SeenPolygon& polygon, const PlaneDepth& ground, const PixelRow& row,
                      std::vector<RowSpan>& spans) {
    Surface surface;
    surface.kind = Surface::Kind::marking;
    surface.index = polygon.polygon;
    surface.priority = kMarkingPriority - polygon.polygon;
    surface.plane = ground;
    surface.near_u = std::numeric_limits<double>::infinity();
    add_plane(surface, std::span(polygon.edges).first(polygon.edge_count), row, spans);
}

void add_light_span(const SeenLight& light, const PixelRow& row, std::vector<RowSpan>& spans) {
    RowSpan& span = empty_span(row, spans);
    span.surface.kind = Surface::Kind::light;
    span.surface.index = light.light;
    span.surface.light = &light;
    span.surface.plane = {light.u, 0.0, 0.0};
    span.surface.near_u = span.surface.far_u = light.u;
    const double middle = row.column(light.x);
    const double line = 1.0 / row.sub_lines;  // rows
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i) {
        const double down = (light.z - row.z[i]) / row.row_step;  // rows from the disc's centre to the line
        double half;
        if (row.point_samples) {
            half = std::sqrt(std::max(0.0, 1.0 - down * down / (light.rows * light.rows)));
        } else {
            const double top = (down - 0.5 * line) / light.rows, bottom = (down + 0.5 * line) / light.rows;
            half = 0.5 * (disc_below(bottom) - disc_below(top)) / (bottom - top);
        }
        span.from[i] = middle - half * light.columns, span.to[i] = middle + half * light.columns;
    }
    if (!fit_columns(row, span)) spans.pop_back();
}

}  // namespace quadrig
