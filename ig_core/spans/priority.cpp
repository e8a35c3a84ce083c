#include "ig_core/spans/priority.h"

#include <algorithm>
#include <cmath>

namespace quadrig {
namespace {

/// Crossings are found to this many columns, and none is looked for so close to a span's end.
constexpr double kCrossingWidth = 1.0 / 16.0;
/// An overlap narrower than this (columns) is rounding where two spans abut: it has no order.
constexpr double kLeastOverlap = 1.0 / 512.0;
/// Surfaces that seem to cross more often than this on a row, or spans cut more often, agree to within rounding.
constexpr std::size_t kMaxCrossings = kMaxPieces - 1;
constexpr int kMaxSplits = 64;
/// After so many guesses at a crossing's place an interval is halved.
constexpr int kMostGuesses = 3;

/// Where one depth passes another along a scan line.
struct CrossingsOnLine {
    CrossingsOnLine() {}  // NOLINT(modernize-use-equals-default): most are never looked at
    bool starts_in_front;
    std::size_t count;
    std::array<double, kMaxCrossings> at;  // columns
};

/// A line's columns that two spans are compared in, and what is found there.
struct ComparedLine {
    double from, to;
    CrossingsOnLine* found;  // null: none of it is compared
};

/// Looks for them on two lines at once.
class CrossingSearch {
  public:
    CrossingSearch(const RowSpan& a, const RowSpan& b, const DepthOnTwoLines& depth_a, const DepthOnTwoLines& depth_b,
                   bool points)
        : sa_(a.surface),
          sb_(b.surface),
          a_(depth_a),
          b_(depth_b),
          points_(points),
          a_wins_ties_(a.surface.priority < b.surface.priority) {}

    void search(const std::array<ComparedLine, 2>& lines) {
        // Most pairs lie clear of one another: the one that spans more depth passes by the other's bounds. (Those are
        // of the first and the last sub-scan line; what lines between could add is less than a sub-scan line high.)
        const bool a_is_wide = sa_.near_u - sa_.far_u >= sb_.near_u - sb_.far_u;
        const DepthOnTwoLines &wide = a_is_wide ? a_ : b_, &narrow = a_is_wide ? b_ : a_;
        const Surface& other = a_is_wide ? sb_ : sa_;
        const TwoLines from{lines[0].from, lines[1].from}, to{lines[0].to, lines[1].to}, width = to - from;
        const DepthSample<TwoLines> wide_l = wide.at(from), wide_r = wide.at(to);
        const auto nearer = smaller(wide_l.u, wide_r.u) > other.near_u * (1.0 + kSameDepth);
        const TwoLines most = smaller(wide_l.most_along(width), wide_r.most_along(-width));
        const auto clear = nearer | (most * (1.0 + kSameDepth) < other.far_u);
        bool all_clear = true;
        for (line_ = 0; line_ < 2; ++line_) {
            if (lines[line_].found == nullptr) continue;
            lines[line_].found->starts_in_front = (nearer[line_] != 0) == a_is_wide;
            all_clear = all_clear && clear[line_] != 0;
        }
        if (all_clear) return;
        const DepthSample<TwoLines> narrow_l = narrow.at(from), narrow_r = narrow.at(to);
        const auto end = [&](double column, const DepthSample<TwoLines>& of_wide,
                             const DepthSample<TwoLines>& of_narrow) {
            const DepthSample<double> w{of_wide.u[line_], of_wide.slope[line_]};
            const DepthSample<double> n{of_narrow.u[line_], of_narrow.slope[line_]};
            return a_is_wide ? end_of(column, w, n) : end_of(column, n, w);
        };
        for (line_ = 0; line_ < 2; ++line_) {
            if (lines[line_].found == nullptr || clear[line_] != 0) continue;
            found_ = lines[line_].found;
            const End left = end(lines[line_].from, wide_l, narrow_l), right = end(lines[line_].to, wide_r, narrow_r);
            found_->starts_in_front = left.in_front;
            between(left, right);
        }
    }

    /// By distances that are linear between a span's ends on the line (Gardner 1984, 2.1). Ground and decks have no
    /// ends and keep their own.
    void search_linear(const RowSpan& a, const RowSpan& b, std::size_t row_line, const ComparedLine& compared) {
        line_ = row_line % 2, found_ = compared.found;
        const auto [from, to, _] = compared;
        const double gap_l = distance(b_, b, row_line, from) - distance(a_, a, row_line, from);
        const double gap_r = distance(b_, b, row_line, to) - distance(a_, a, row_line, to);
        const auto in_front = [&](double gap) { return gap > 0.0 || (gap == 0.0 && a_wins_ties_); };
        found_->starts_in_front = in_front(gap_l);
        if (found_->starts_in_front != in_front(gap_r))
            found_->at[found_->count++] = from + (to - from) * (gap_l / (gap_l - gap_r));
    }

  private:
    [[nodiscard]] double distance(const DepthOnTwoLines& depth, const RowSpan& span, std::size_t row_line,
                                  double column) const {
        const auto at = [&](double where) { return 1.0 / depth.at(where, line_).u; };
        if (span.surface.outline == nullptr) return at(column);
        const double from = span.from[row_line], to = span.to[row_line], left = at(from), right = at(to);
        return left + (right - left) * ((column - from) / (to - from));
    }

    struct End {
        double column;
        DepthSample<double> a, b;
        bool in_front, same;
    };

    [[nodiscard]] End end_at(double column) const { return end_of(column, a_.at(column, line_), b_.at(column, line_)); }
    [[nodiscard]] End end_of(double column, const DepthSample<double>& a, const DepthSample<double>& b) const {
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

    /// `guesses`: how often in a row the interval has been split where the surfaces were expected to cross.
    void between(const End& left, const End& right, int guesses = 0) {
        const bool same_order = left.in_front == right.in_front;
        if (same_order && (left.column >= right.column || proven(left, right))) return;
        const double width = right.column - left.column;
        if (width <= (points_ ? 1.0 : kCrossingWidth)) {
            if (same_order || found_->count == kMaxCrossings) return;
            double share = 0.5;
            if (!points_) {
                const double gap_l = std::abs(left.a.u - left.b.u), gap_r = std::abs(right.a.u - right.b.u);
                if (gap_l + gap_r > 0.0) share = gap_l / (gap_l + gap_r);
            }
            found_->at[found_->count++] = left.column + share * width;
            return;
        }
        const bool guess = !same_order && !points_ && guesses < kMostGuesses;
        const double half = points_ ? std::floor(0.5 * width) : 0.5 * width;
        const End middle = end_at(guess ? expected_crossing(left, right) : left.column + half);
        between(left, middle, guess ? guesses + 1 : 0);
        between(middle, right, guess ? guesses + 1 : 0);
    }

    /// By the tangents at the end where the surfaces are closer, and so that a crossing close to an end is shut in.
    [[nodiscard]] static double expected_crossing(const End& left, const End& right) {
        const double gap_l = left.a.u - left.b.u, gap_r = right.a.u - right.b.u;
        const End& from = std::abs(gap_l) < std::abs(gap_r) ? left : right;
        const double half = 0.5 * (right.column - left.column), nearest = std::min(0.75 * kCrossingWidth, half);
        double at = from.column - (from.a.u - from.b.u) / (from.a.slope - from.b.slope);
        if (!(at > left.column && at < right.column)) at = left.column + 2.0 * half * (gap_l / (gap_l - gap_r));
        if (!(at > left.column && at < right.column)) at = left.column + half;
        return std::clamp(at, left.column + nearest, right.column - nearest);
    }

    const Surface &sa_, &sb_;
    const DepthOnTwoLines &a_, &b_;
    bool points_, a_wins_ties_;
    std::size_t line_ = 0;  // of the two
    CrossingsOnLine* found_ = nullptr;
};

/// Columns in which two spans overlap on a sub-scan line; none if they lie apart there, but for rounding.
struct Overlap {
    double from, to;
    [[nodiscard]] bool apart(bool point_samples) const { return !(to - from > (point_samples ? 0.0 : kLeastOverlap)); }
};

Overlap overlap_on_line(const RowSpan& a, const RowSpan& b, std::size_t line) {
    return {std::max(a.from[line], b.from[line]), std::min(a.to[line], b.to[line])};
}

/// Planes without end pass in front of part of a light's disc wherever it stands close to them: they are compared where
/// its centre is, so that a light is seen whole or not at all. One that stands on the plane is in front of it.
bool light_in_front_of_plane(const SeenLight& light, const PlaneDepth& plane) {
    const double along_x = plane.along_x * light.x, along_z = plane.along_z * light.z;
    // Relative to the terms of the sum: what may be rounding, of the light's place in the image too.
    constexpr double kRounding = 1e-12;
    const double rounding = kRounding * (std::abs(plane.at) + std::abs(along_x) + std::abs(along_z));
    return light.u >= plane.at + along_x + along_z - rounding;
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

void RowDepths::start(const PixelRow& row) {
    row_ = &row;
    depths_.clear();
}

std::size_t RowDepths::place_of(RowSpan& span) {
    if (span.depths < 0) {
        span.depths = static_cast<int>(depths_.size());
        const auto lines = static_cast<std::size_t>(row_->sub_lines);
        for (std::size_t line = 0; line < lines; line += 2)
            depths_.emplace_back(span.surface, *row_, TwoLines{row_->z[line], row_->z[std::min(line + 1, lines - 1)]});
    }
    return static_cast<std::size_t>(span.depths);
}

bool overlap(const RowSpan& a, const RowSpan& b, const PixelRow& row) {
    for (std::size_t line = 0; line < static_cast<std::size_t>(row.sub_lines); ++line)
        if (!overlap_on_line(a, b, line).apart(row.point_samples)) return true;
    return false;
}

Priority priority_of(RowSpan& a, RowSpan& b, const PixelRow& row, RowDepths& depths, CrossingPieces& pieces) {
    const Surface &sa = a.surface, &sb = b.surface;
    const auto is_plane = [](const Surface& s) { return s.outline == nullptr && s.light == nullptr; };
    if (sa.light != nullptr && is_plane(sb))
        return light_in_front_of_plane(*sa.light, sb.plane) ? Priority::front : Priority::behind;
    if (sb.light != nullptr && is_plane(sa))
        return light_in_front_of_plane(*sb.light, sa.plane) ? Priority::behind : Priority::front;

    const auto lines = static_cast<std::size_t>(row.sub_lines);
    std::array<bool, kMaxSubScanLines> apart;
    bool all_apart = true;
    for (std::size_t line = 0; line < lines; ++line) {
        apart[line] = overlap_on_line(a, b, line).apart(row.point_samples);
        all_apart = all_apart && apart[line];
    }
    if (all_apart) return sa.near_u + sa.far_u > sb.near_u + sb.far_u ? Priority::front : Priority::behind;

    const std::size_t place_a = depths.place_of(a), place_b = depths.place_of(b);
    std::array<CrossingsOnLine, kMaxSubScanLines> crossings;
    bool front = false, behind = false;
    const CrossingsOnLine* model = nullptr;
    const auto compared_columns = [&](std::size_t line) {
        auto [from, to] = overlap_on_line(a, b, line);
        if (row.point_samples) {
            from = std::ceil(from - 0.5) + 0.5, to = std::ceil(to - 0.5) - 0.5;
            apart[line] = !(from <= to);
        } else {
            const double inset = std::min(2.0 * kCrossingWidth, 0.25 * (to - from));
            from += inset, to -= inset;
        }
        crossings[line].count = 0;
        return ComparedLine{from, to, apart[line] ? nullptr : &crossings[line]};
    };
    for (std::size_t first = 0; first < lines; first += 2) {
        std::array<ComparedLine, 2> compared{};
        const std::size_t count = std::min<std::size_t>(2, lines - first);
        for (std::size_t i = 0; i < count; ++i)
            if (!apart[first + i]) compared[i] = compared_columns(first + i);
        if (compared[0].found == nullptr && compared[1].found == nullptr) continue;
        if (compared[0].found == nullptr) compared[0] = {compared[1].from, compared[1].to, nullptr};
        if (compared[1].found == nullptr) compared[1] = {compared[0].from, compared[0].to, nullptr};
        CrossingSearch search(a, b, depths.at(place_a, first), depths.at(place_b, first), row.point_samples);
        if (row.distance == DistanceRule::exact) {
            search.search(compared);
        } else {
            for (std::size_t i = 0; i < count; ++i)
                if (compared[i].found != nullptr) search.search_linear(a, b, first + i, compared[i]);
        }
        for (const ComparedLine& line : compared) {
            if (line.found == nullptr) continue;
            CrossingsOnLine& on_line = *line.found;
            if (a.splits >= kMaxSplits) on_line.count = 0;
            if (model == nullptr || model->count == 0) model = &on_line;
            front = front || on_line.starts_in_front || on_line.count > 0;
            behind = behind || !on_line.starts_in_front || on_line.count > 0;
        }
    }
    if (!behind) return Priority::front;
    if (!front || a.splits >= kMaxSplits) return Priority::behind;

    // Lines without a crossing are cut in step with those that have one: a piece of a few lines only covers no pixel
    // whole, and meets more of its kind.
    for (RowSpan& piece : pieces) piece.splits = 0;
    for (std::size_t line = 0; line < lines; ++line) {
        CrossingsOnLine cuts = apart[line] ? *model : crossings[line];
        if (cuts.count == 0 && model->count == 1) {
            // What lies over or under `b` stays in one piece.
            const bool first_piece = cuts.starts_in_front == model->starts_in_front;
            cuts.at[cuts.count++] = first_piece ? std::max(model->at[0], std::min(a.to[line], b.to[line]))
                                                : std::min(model->at[0], std::max(a.from[line], b.from[line]));
            cuts.starts_in_front = model->starts_in_front;
        }
        std::size_t piece = cuts.starts_in_front ? 0 : 1;
        double start = a.from[line];
        for (std::size_t i = 0; i < cuts.count; ++i) {
            const double stop = std::clamp(cuts.at[i], start, std::max(start, a.to[line]));
            put(pieces[std::min(piece++, kMaxPieces - 1)], a, line, start, stop);
            start = stop;
        }
        put(pieces[std::min(piece, kMaxPieces - 1)], a, line, start, a.to[line]);
    }
    return Priority::crossing;
}

bool part_between(const RowSpan& a, const RowSpan& x, const RowSpan& y, const PixelRow& row, CrossingPieces& pieces) {
    if (a.splits >= kMaxSplits) return false;
    for (RowSpan& piece : pieces) piece.splits = 0;
    for (std::size_t line = 0; line < static_cast<std::size_t>(row.sub_lines); ++line) {
        const double from = a.from[line], to = a.to[line];
        if (!(from < to)) continue;
        const Overlap of_x = overlap_on_line(a, x, line), of_y = overlap_on_line(a, y, line);
        const bool apart_from_y = of_y.apart(row.point_samples);
        if (of_x.apart(row.point_samples) || apart_from_y) {
            put(pieces[apart_from_y ? 0 : 1], a, line, from, to);
            continue;
        }
        const bool x_first = of_x.from < of_y.from;
        const double middle = x_first ? 0.5 * (of_x.to + of_y.from) : 0.5 * (of_y.to + of_x.from);
        put(pieces[x_first ? 0 : 1], a, line, from, middle);
        put(pieces[x_first ? 1 : 0], a, line, middle, to);
    }
    return true;
}

}  // namespace quadrig
