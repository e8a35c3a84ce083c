/// 1/k of a surface along a scan line, or along two at once.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "ig_core/spans/row_span.h"

namespace quadrig {

/// A number on each of two scan lines (a vector type of GCC and Clang): arithmetic is that of doubles, line by line.
using TwoLines = double __attribute__((vector_size(2 * sizeof(double))));

inline double square_root(double x) { return std::sqrt(x); }
inline TwoLines square_root(TwoLines x) { return TwoLines{std::sqrt(x[0]), std::sqrt(x[1])}; }
inline double one_of(double x, std::size_t) { return x; }
inline double one_of(TwoLines x, std::size_t line) { return x[line]; }
inline bool on_all_lines(bool condition) { return condition; }
template <class Condition>
bool on_all_lines(Condition condition) {
    return (condition[0] & condition[1]) != 0;
}
template <class Number>
Number smaller(Number a, Number b) {
    return b < a ? b : a;
}
template <class Number>
Number larger(Number a, Number b) {
    return a < b ? b : a;
}

/// 1/k at a column.
template <class Number>
struct DepthSample {
    Number u;
    Number slope;  ///< du/dcolumn; not finite on the limb

    /// The larger end of the tangent over so many columns, above which u does not rise; infinite where that says
    /// nothing.
    [[nodiscard]] Number most_along(Number columns) const {
        constexpr double kInfinite = std::numeric_limits<double>::infinity();
        const Number end = u + slope * columns;
        const auto finite = (end > -kInfinite) & (end < kInfinite);
        return finite ? larger(u, end) : Number{} + kInfinite;
    }
};

/// 1/k of a surface as a function of the column. On every convex object it is concave, which is what the ordering of
/// spans rests on: a chord lies below it, a tangent above.
template <class Number>
class DepthOn {
  public:
    /// `z`: of the line, or of each, on the image plane.
    DepthOn(const Surface& surface, const PixelRow& row, Number z);

    [[nodiscard]] DepthSample<Number> at(Number column) const {
        return sample(column, [](const Number& on_line) { return on_line; });
    }
    /// On one of the lines.
    [[nodiscard]] DepthSample<double> at(double column, std::size_t line) const {
        return sample(column, [line](const Number& on_lines) { return one_of(on_lines, line); });
    }
    [[nodiscard]] Number value(Number column) const;

    /// Bounds of u over a stretch of the line: the lower end of its chord, and the tangent in its middle.
    [[nodiscard]] Number least(Number from, Number to) const { return smaller(value(from), value(to)); }
    [[nodiscard]] Number most(Number from, Number to) const;

  private:
    template <class N, class OnLine>
    [[nodiscard]] DepthSample<N> sample(N column, OnLine&& on_line) const;

    bool plane_;
    double xi0_, step_, b1_, inverse_s_, a2_, d2_;  // the same on all lines of a row
    Number u0_;                                     // plane: u0 + u1 column
    double u1_;
    Number b0_, a0_, a1_, d0_, d1_;  // quadric: xi = xi0 + step column; B = b0 + b1 xi, C = s; A and the limb form
};

using DepthOnLine = DepthOn<double>;
using DepthOnTwoLines = DepthOn<TwoLines>;

template <class Number>
template <class N, class OnLine>
inline DepthSample<N> DepthOn<Number>::sample(N column, OnLine&& on_line) const {
    if (plane_) return {on_line(u0_) + u1_ * column, N{} + u1_};
    const N xi = xi0_ + step_ * column;
    const N b = on_line(b0_) + b1_ * xi;
    const N d = on_line(d0_) + xi * (on_line(d1_) + xi * d2_), half_d_slope = 0.5 * on_line(d1_) + xi * d2_;
    const N root = square_root(d > 0.0 ? d : N{});
    const N root_slope = half_d_slope / root;
    // u solves C u^2 + 2 B u + A = 0 (Eq 4 divided by k^2); of its two forms the one that does not cancel.
    const DepthSample<N> by_c{(root - b) * inverse_s_, step_ * (root_slope - b1_) * inverse_s_};
    const auto by_first = b <= 0.0;
    if (on_all_lines(by_first)) return by_c;
    const N a = on_line(a0_) + xi * (on_line(a1_) + xi * a2_), a_slope = on_line(a1_) + 2.0 * xi * a2_;
    const N sum = b + root, u = -a / sum;
    const N slope = step_ * (-a_slope - u * (b1_ + root_slope)) / sum;
    return {by_first ? by_c.u : u, by_first ? by_c.slope : slope};
}

template <class Number>
inline Number DepthOn<Number>::value(Number column) const {
    if (plane_) return u0_ + u1_ * column;
    const Number xi = xi0_ + step_ * column;
    const Number b = b0_ + b1_ * xi;
    const Number d = d0_ + xi * (d1_ + xi * d2_), root = square_root(d > 0.0 ? d : Number{});
    const auto by_first = b <= 0.0;
    const Number by_c = (root - b) * inverse_s_;
    if (on_all_lines(by_first)) return by_c;
    const Number by_a = -(a0_ + xi * (a1_ + xi * a2_)) / (b + root);
    return by_first ? by_c : by_a;
}

}  // namespace quadrig
