#include "ig_core/spans/depth_on_line.h"

namespace quadrig {

template <class Number>
DepthOn<Number>::DepthOn(const Surface& surface, const PixelRow& row, Number z)
    : plane_(surface.kind != Surface::Kind::quadric) {
    if (surface.kind != Surface::Kind::quadric && surface.kind != Surface::Kind::face) {
        u0_ = surface.plane.at + surface.plane.along_x * row.left + surface.plane.along_z * z;
        u1_ = surface.plane.along_x * row.column_step;
        return;
    }
    const EyeSolid& e = surface.outline->solid;
    const Number zeta = z - e.z0;
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
    a0_ = e.m.yy + zeta * (2.0 * e.m.yz + zeta * e.m.zz), a1_ = 2.0 * (e.m.xy + e.m.xz * zeta), a2_ = e.m.xx;
    d0_ = e.limb.yy + zeta * (2.0 * e.limb.yz + zeta * e.limb.zz), d1_ = 2.0 * (e.limb.xy + e.limb.xz * zeta);
    d2_ = e.limb.xx;
}

template <class Number>
Number DepthOn<Number>::most(Number from, Number to) const {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    const DepthSample<Number> middle = at(0.5 * (from + to));
    const Number rise = 0.5 * (to - from) * (middle.slope < 0.0 ? -middle.slope : middle.slope);
    return rise < kInfinite ? middle.u + rise : Number{} + kInfinite;
}

template class DepthOn<double>;
template class DepthOn<TwoLines>;

}  // namespace quadrig
