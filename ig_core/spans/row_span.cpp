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
        on_plane(e.face(surface.surface));
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

double DepthOnLine::least(double from, double to) const { return std::min(value(from), value(to)); }

double DepthOnLine::most(double from, double to) const {
    const Sample middle = at(0.5 * (from + to));
    const double rise = 0.5 * (to - from) * std::abs(middle.slope);
    return std::isfinite(rise) ? middle.u + rise : std::numeric_limits<double>::infinity();
}

}  // namespace quadrig
