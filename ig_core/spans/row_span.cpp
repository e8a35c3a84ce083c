#include "ig_core/spans/row_span.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrig {

DepthOnLine::DepthOnLine(const Surface& surface, const PixelRow& row, double z)
    : plane_(surface.kind != Surface::Kind::quadric) {
    if (surface.kind != Surface::Kind::quadric && surface.kind != Surface::Kind::face) {
        u0_ = surface.plane.at + surface.plane.along_x * row.left + surface.plane.along_z * z;
        u1_ = surface.plane.along_x * row.column_step;
        return;
    }
    const EyeSolid& e = surface.outline->solid;
    const double zeta = z - e.z0;
    xi0_ = row.left - e.x0;
    step_ = row.column_step;
    const auto on_plane = [&](const EyePlane& plane) {
        // k (n.d) + b = 0 (Eq 7)
        u0_ = -(plane.normal.x * xi0_ + plane.normal.y + plane.normal.z * zeta) / plane.at_eye;
        u1_ = -plane.normal.x * step_ / plane.at_eye;
    };
    if (surface.kind == Surface::Kind::face) {
        for (int i = 0; i < e.plane_count; ++i)
            if (e.planes[static_cast<std::size_t>(i)].surface == surface.surface)
                on_plane(e.planes[static_cast<std::size_t>(i)]);
        return;
    }
    if (e.flat_side) {
        plane_ = true;
        on_plane(*e.flat_side);
        return;
    }
    b0_ = e.v.y + e.v.z * zeta, b1_ = e.v.x, inverse_s_ = 1.0 / e.s;
    a_[0] = e.m.yy + zeta * (2.0 * e.m.yz + zeta * e.m.zz), a_[1] = 2.0 * (e.m.xy + e.m.xz * zeta), a_[2] = e.m.xx;
    d_[0] = e.limb.yy + zeta * (2.0 * e.limb.yz + zeta * e.limb.zz), d_[1] = 2.0 * (e.limb.xy + e.limb.xz * zeta);
    d_[2] = e.limb.xx;
}

DepthOnLine::Sample DepthOnLine::at(double column) const {
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

double DepthOnLine::value(double column) const {
    if (plane_) return u0_ + u1_ * column;
    const double xi = xi0_ + step_ * column;
    const double b = b0_ + b1_ * xi;
    const double d = d_[0] + xi * (d_[1] + xi * d_[2]), root = d > 0.0 ? std::sqrt(d) : 0.0;
    if (b <= 0.0) return (root - b) * inverse_s_;
    return -(a_[0] + xi * (a_[1] + xi * a_[2])) / (b + root);
}

DepthOnLine::Bounds DepthOnLine::between(double from, double to) const {
    const double left = value(from), right = value(to);
    const double least = std::min(left, right), most = std::max(left, right);
    if (plane_) return {least, most};
    const Sample middle = at(0.5 * (from + to));
    const double rise = 0.5 * (to - from) * std::abs(middle.slope);
    return {least, std::isfinite(rise) ? std::max(most, middle.u + rise) : std::numeric_limits<double>::infinity()};
}

}  // namespace quadrig
