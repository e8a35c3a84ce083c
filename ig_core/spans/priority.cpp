#include "ig_core/spans/priority.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace quadrig {
namespace {

/// Crossings are found to this many columns, and none is looked for so close to a span's end.
constexpr double kCrossingWidth = 1.0 / 16.0;
/// An overlap narrower than this (columns) is rounding where two spans abut: it has no order.
constexpr double kLeastOverlap = 1.0 / 512.0;
/// Depths that differ by less than this share are the same: faces in one plane are in file order.
constexpr double kSameDepth = 1e-13;
/// Surfaces that seem to cross more often than this on a row, or spans cut more often, agree to within rounding.
constexpr std::size_t kMaxCrossings = kMaxPieces - 1;
constexpr int kMaxSplits = 8;

/// Finds where one depth passes another along a scan line.
class Crossings {
  public:
    Crossings(const RowSpan& a, const RowSpan& b, const PixelRow& row, double z)
        : a_(a.surface, row, z),
          b_(b.surface, row, z),
          points_(row.point_samples),
          a_wins_ties_(a.surface.priority < b.surface.priority) {}

    void search(double from, double to) {
        const End left = end(from), right = end(to);
        starts_in_front = left.in_front;
        between(left, right);
    }

    /// By distances that are linear between a span's ends on the line (Gardner 1984, 2.1). Ground and decks have no
    /// ends and keep their own.
    void search_linear(const RowSpan& a, const RowSpan& b, std::size_t line, double from, double to) {
        const double gap_l = distance(b_, b, line, from) - distance(a_, a, line, from);
        const double gap_r = distance(b_, b, line, to) - distance(a_, a, line, to);
        const auto in_front = [&](double gap) { return gap > 0.0 || (gap == 0.0 && a_wins_ties_); };
        starts_in_front = in_front(gap_l);
        if (starts_in_front != in_front(gap_r)) at[count++] = from + (to - from) * (gap_l / (gap_l - gap_r));
    }

    bool starts_in_front = false;
    std::array<double, kMaxCrossings> at{};
    std::size_t count = 0;

  private:
    [[nodiscard]] static double distance(const DepthOnLine& depth, const RowSpan& span, std::size_t line,
                                         double column) {
        if (span.surface.outline == nullptr) return 1.0 / depth.value(column);
        const double left = 1.0 / depth.value(span.from[line]), right = 1.0 / depth.value(span.to[line]);
        return left + (right - left) * ((column - span.from[line]) / (span.to[line] - span.from[line]));
    }

    struct End {
        double column;
        DepthOnLine::Sample a, b;
        bool in_front, same;
    };

    [[nodiscard]] End end(double column) const {
        const DepthOnLine::Sample a = a_.at(column), b = b_.at(column);
        const double rounding = kSameDepth * std::abs(b.u);
        const bool same = std::abs(a.u - b.u) <= rounding;
        return {column, a, b, same ? a_wins_ties_ : a.u > b.u, same};
    }

    /// Tangents of the farther surface at both ends, chord of the nearer one: their closest approach decides.
    [[nodiscard]] static bool proven(const End& l, const End& r) {
        if (l.same && r.same && l.a.slope == r.a.slope && l.b.slope == r.b.slope) return true;  // planes, on one line
        const auto& near_l = l.in_front ? l.a : l.b;
        const auto& near_r = l.in_front ? r.a : r.b;
        const auto& far_l = l.in_front ? l.b : l.a;
        const auto& far_r = l.in_front ? r.b : r.a;
        const double width = r.column - l.column, chord_slope = (near_r.u - near_l.u) / width;
        const double gap_l = near_l.u - far_l.u, gap_r = near_r.u - far_r.u;
        const bool tangent_l = std::isfinite(far_l.slope), tangent_r = std::isfinite(far_r.slope);
        // Gap above either tangent, at a distance t from the left end; the larger of the two is a lower bound.
        const double slope_l = chord_slope - far_l.slope, slope_r = chord_slope - far_r.slope;
        const double at_left_r = gap_r - slope_r * width;  // above the right tangent, at the left end
        if (tangent_l && gap_l + slope_l * width > 0.0) return true;
        if (tangent_r && at_left_r > 0.0) return true;
        if (!tangent_l || !tangent_r || slope_l == slope_r) return false;
        const double t = (at_left_r - gap_l) / (slope_l - slope_r);
        return t >= 0.0 && t <= width && gap_l + slope_l * t > 0.0;
    }

    void between(const End& left, const End& right) {
        if (left.in_front == right.in_front && (left.column >= right.column || proven(left, right))) return;
        const double width = right.column - left.column;
        if (width <= (points_ ? 1.0 : kCrossingWidth)) {
            if (left.in_front == right.in_front || count == kMaxCrossings) return;
            double share = 0.5;
            if (!points_) {
                const double gap_l = std::abs(left.a.u - left.b.u), gap_r = std::abs(right.a.u - right.b.u);
                if (gap_l + gap_r > 0.0) share = gap_l / (gap_l + gap_r);
            }
            at[count++] = left.column + share * width;
            return;
        }
        const double half = points_ ? std::floor(0.5 * width) : 0.5 * width;
        const End middle = end(left.column + half);
        between(left, middle);
        between(middle, right);
    }

    DepthOnLine a_, b_;
    bool points_, a_wins_ties_;
};

/// Most pairs lie clear of one another: on the first and the last sub-scan line the surface that spans more depth
/// passes the other by, whose bounds of 1/k are known. (What the lines between could add is less than a sub-scan line
/// high.)
std::optional<Priority> proven_on_outer_lines(const RowSpan& a, const RowSpan& b, const PixelRow& row) {
    const auto spread = [](const Surface& s) { return s.near_u - s.far_u; };
    const bool a_is_wide = spread(a.surface) >= spread(b.surface);
    const Surface &wide = a_is_wide ? a.surface : b.surface, &narrow = a_is_wide ? b.surface : a.surface;
    const auto lines = static_cast<std::size_t>(row.sub_lines);
    std::optional<bool> wide_in_front;
    for (std::size_t line = 0; line < lines; line += std::max<std::size_t>(1, lines - 1)) {
        const double from = std::max(a.from[line], b.from[line]), to = std::min(a.to[line], b.to[line]);
        if (!(to - from > kLeastOverlap)) continue;
        const DepthOnLine depth(wide, row, row.z[line]);
        const bool behind = depth.most(from, to) * (1.0 + kSameDepth) < narrow.far_u;
        if (!behind && !(depth.least(from, to) > narrow.near_u * (1.0 + kSameDepth))) return std::nullopt;
        if (wide_in_front && *wide_in_front == behind) return std::nullopt;
        wide_in_front = !behind;
    }
    if (!wide_in_front) return std::nullopt;
    return *wide_in_front == a_is_wide ? Priority::front : Priority::behind;
}

/// Planes without end pass in front of part of a light's disc wherever it stands close to them: they are compared where
/// its centre is, so that a light is seen whole or not at all.
bool light_in_front_of_plane(const SeenLight& light, const PlaneDepth& plane) {
    return light.u >= plane.at + plane.along_x * light.x + plane.along_z * light.z;
}

void put(RowSpan& piece, const RowSpan& whole, std::size_t line, double from, double to) {
    if (piece.splits == 0) {
        piece = whole;
        piece.from.fill(0.0);
        piece.to.fill(0.0);
        piece.splits = whole.splits + 1;
    }
    piece.from[line] = from;
    piece.to[line] = to;
}

}  // namespace

Priority priority_of(const RowSpan& a, const RowSpan& b, const PixelRow& row, CrossingPieces& pieces) {
    const Surface &sa = a.surface, &sb = b.surface;
    const auto is_plane = [](const Surface& s) { return s.outline == nullptr && s.light == nullptr; };
    if (sa.light != nullptr && is_plane(sb))
        return light_in_front_of_plane(*sa.light, sb.plane) ? Priority::front : Priority::behind;
    if (sb.light != nullptr && is_plane(sa))
        return light_in_front_of_plane(*sb.light, sa.plane) ? Priority::behind : Priority::front;
    if (sa.far_u > (1.0 + kSameDepth) * sb.near_u) return Priority::front;
    if (sb.far_u > (1.0 + kSameDepth) * sa.near_u) return Priority::behind;
    // Surfaces of one object lie side by side.
    if (sa.outline != nullptr && sa.outline == sb.outline) return Priority::front;

    if (row.distance == DistanceRule::exact)
        if (const auto proven = proven_on_outer_lines(a, b, row)) return *proven;

    for (RowSpan& piece : pieces) piece.splits = 0;
    bool front = false, behind = false;
    std::optional<bool> first_in_front;
    const auto lines = static_cast<std::size_t>(row.sub_lines);
    std::array<bool, kMaxSubScanLines> apart{};
    for (std::size_t line = 0; line < lines; ++line) {
        double from = std::max(a.from[line], b.from[line]), to = std::min(a.to[line], b.to[line]);
        apart[line] = !(to - from > (row.point_samples ? 0.0 : kLeastOverlap));
        if (apart[line]) continue;
        if (row.point_samples) {
            from = std::ceil(from - 0.5) + 0.5, to = std::ceil(to - 0.5) - 0.5;
            apart[line] = !(from <= to);
            if (apart[line]) continue;
        } else {
            const double inset = std::min(2.0 * kCrossingWidth, 0.25 * (to - from));
            from += inset, to -= inset;
        }
        Crossings crossings(a, b, row, row.z[line]);
        if (row.distance == DistanceRule::exact)
            crossings.search(from, to);
        else
            crossings.search_linear(a, b, line, from, to);
        if (a.splits >= kMaxSplits) crossings.count = 0;
        bool in_front = crossings.starts_in_front;
        if (!first_in_front) first_in_front = in_front;
        std::size_t piece = in_front ? 0 : 1;
        double start = a.from[line];
        for (std::size_t i = 0; i <= crossings.count; ++i) {
            (in_front ? front : behind) = true;
            const double stop = i < crossings.count ? crossings.at[i] : a.to[line];
            put(pieces[std::min(piece, kMaxPieces - 1)], a, line, start, stop);
            start = stop;
            in_front = !in_front;
            ++piece;
        }
    }
    if (!behind) return Priority::front;
    if (!front || a.splits >= kMaxSplits) return Priority::behind;
    for (std::size_t line = 0; line < lines; ++line)
        if (apart[line] && a.from[line] < a.to[line])
            put(pieces[*first_in_front ? 0 : 1], a, line, a.from[line], a.to[line]);
    return Priority::crossing;
}

}  // namespace quadrig
