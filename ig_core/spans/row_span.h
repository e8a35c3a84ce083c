/// The span: part of a pixel row on which one surface may be seen. The narrow waist of the image generator: everything
/// that draws makes spans, and everything after the sweep sees nothing else.
///
/// A pixel row is sampled on a few sub-scan lines. A span knows its exact ends on each of them, in columns (column c of
/// the image covers c to c+1); it covers a pixel by as much as its sub-scan lines do.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "ig_core/outline/outline.h"

namespace quadrig {

inline constexpr int kMaxSubScanLines = 8;

/// Inverse depth 1/k of a plane over the image, at + x along_x + z along_z: positive in front of the eye.
struct PlaneDepth {
    double at = 0, along_x = 0, along_z = 0;
};

/// A light point on the image: a disc, all of it at one depth.
struct SeenLight {
    std::uint32_t light = 0;       ///< index in the scene
    double x = 0, z = 0;           ///< centre, image plane
    double columns = 0, rows = 0;  ///< radius in pixels, across and down
    double u = 0;                  ///< 1/k
};

/// What a span shows.
struct Surface {
    enum class Kind : std::uint8_t { quadric, face, light, marking, ground, deck, sky };
    Kind kind = Kind::sky;
    bool opaque = true;
    int surface = 0;             ///< surface id in the object
    std::uint32_t index = 0;     ///< of the outline in the frame's list, of the ground polygon or the cloud deck
    std::uint32_t priority = 0;  ///< wins a tie in depth if smaller: file order, then markings, ground, decks, sky
    const Outline* outline = nullptr;  ///< for quadrics and faces
    const SeenLight* light = nullptr;  ///< for lights
    PlaneDepth plane;                  ///< for markings, ground, decks and (constant) lights
    double near_u = 1.0 / kNearDepth;  ///< bounds of 1/k over all of the span
    double far_u = 0.0;
};

struct RowSpan {
    RowSpan() {}  // NOLINT(modernize-use-equals-default): ends are for their maker to set, not for zeroing first
    Surface surface;
    std::array<double, kMaxSubScanLines> from, to;  ///< columns; from >= to where the sub-scan line misses it
    int outer_from = 0, outer_to = 0;               ///< columns touched
    int inner_from = 0, inner_to = 0;               ///< columns covered whole; empty if from >= to
    int splits = 0;                                 ///< how often the sweep has cut it where surfaces cross
    int depths = -1;                                ///< its place in RowDepths; -1 before it is asked for
};

/// One pixel row and its sub-scan lines.
struct PixelRow {
    int row = 0;
    int sub_lines = 1;
    bool point_samples = false;  ///< a column counts as covered if its centre is: for ids and depth
    DistanceRule distance = DistanceRule::exact;
    int columns = 0;
    double left = 0, column_step = 1;          ///< x = left + column * column_step
    double row_step = 1;                       ///< image-plane height of the row
    std::array<double, kMaxSubScanLines> z{};  ///< image-plane z of each sub-scan line
    [[nodiscard]] double x(double column) const { return left + column * column_step; }
    [[nodiscard]] double column(double at_x) const { return (at_x - left) / column_step; }
};

/// 1/k of a surface along one scan line as a function of the column. On every convex object it is concave, which is
/// what the ordering of spans rests on: a chord lies below it, a tangent above.
class DepthOnLine {
  public:
    DepthOnLine(const Surface& surface, const PixelRow& row, double z);
    struct Sample {
        double u;
        double slope;  ///< du/dcolumn; not finite on the limb
    };
    [[nodiscard]] Sample at(double column) const;
    [[nodiscard]] double value(double column) const;

    /// Bounds of u over a stretch of the line: the lower end of its chord, and the tangent in its middle.
    [[nodiscard]] double least(double from, double to) const;
    [[nodiscard]] double most(double from, double to) const;

  private:
    bool plane_;
    double u0_ = 0, u1_ = 0;                  // plane: u0 + u1 column
    double xi0_ = 0, step_ = 1;               // quadric: xi = xi0 + step column
    double b0_ = 0, b1_ = 0, inverse_s_ = 1;  // B = b0 + b1 xi, C = s
    double a_[3] = {}, d_[3] = {};            // A and the limb form as polynomials in xi
};

inline DepthOnLine::Sample DepthOnLine::at(double column) const {
    if (plane_) return {u0_ + u1_ * column, u1_};
    const double xi = xi0_ + step_ * column;
    const double b = b0_ + b1_ * xi;
    const double d = d_[0] + xi * (d_[1] + xi * d_[2]), half_d_slope = 0.5 * d_[1] + xi * d_[2];
    const double root = d > 0.0 ? std::sqrt(d) : 0.0;
    const double root_slope = half_d_slope / root;
    // u solves C u^2 + 2 B u + A = 0 (Eq 4 divided by k^2); of its two forms the one that does not cancel.
    if (b <= 0.0) return {(root - b) * inverse_s_, step_ * (root_slope - b1_) * inverse_s_};
    const double a = a_[0] + xi * (a_[1] + xi * a_[2]), a_slope = a_[1] + 2.0 * xi * a_[2];
    const double sum = b + root, u = -a / sum;
    return {u, step_ * (-a_slope - u * (b1_ + root_slope)) / sum};
}

inline double DepthOnLine::value(double column) const {
    if (plane_) return u0_ + u1_ * column;
    const double xi = xi0_ + step_ * column;
    const double b = b0_ + b1_ * xi;
    const double d = d_[0] + xi * (d_[1] + xi * d_[2]), root = d > 0.0 ? std::sqrt(d) : 0.0;
    if (b <= 0.0) return (root - b) * inverse_s_;
    return -(a_[0] + xi * (a_[1] + xi * a_[2])) / (b + root);
}

}  // namespace quadrig
