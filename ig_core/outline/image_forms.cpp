#include "ig_core/outline/image_forms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ig_core/geometry/quadric_line.h"
#include "ig_core/outline/image_bounds.h"
#include "ig_core/outline/textbook_forms.h"

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Ellipsoids within this cosine of the look direction get their own image origin; further out the shear itself would
/// be long.
constexpr double kLeastShearCosine = 0.15;

void set_forms(EyeSolid& e) {
    // L = -[a]x' adj(M) [a]x - c M + w w' + 2 (w.a) M - (Ma) w' - w (Ma)'
    e.limb = (2.0 * glm::dot(e.w, e.anchor) - e.c) * e.m - through_cross(e.adjugate, e.anchor) + outer(e.w) -
             outer(e.m * e.anchor, e.w);
    // c adj(M) - [w]x' M [w]x - (a (adj(M) w)' + (adj(M) w) a') + det(M) a a'
    e.tangent = e.c * e.adjugate - through_cross(e.m, e.w) - outer(e.anchor, e.adjugate * e.w) +
                e.determinant * outer(e.anchor);
}

SceneQuadric in_scene(const Solid& solid, const glm::dvec3& eye_from_anchor) {
    const Sym3& m = solid.m;
    return {{static_cast<float>(m.xx), static_cast<float>(m.yy), static_cast<float>(m.zz), static_cast<float>(m.xy),
             static_cast<float>(m.xz), static_cast<float>(m.yz)},
            to_float(solid.w),
            to_float(eye_from_anchor),
            solid.centre_value > 0.0 ? static_cast<float>(1.0 / solid.centre_value) : 0.0F};
}

}  // namespace

bool misses_row(const RowConic& conic, double zeta) {
    constexpr double kTouch = 1e-12;  // a discriminant this small beside its terms may be zero
    const double discriminant = conic.discriminant_at(zeta);
    if (discriminant >= 0.0) return false;
    const double beta = conic.beta_at(zeta);
    return discriminant < -kTouch * (beta * beta + std::abs(conic.alpha * conic.gamma_at(zeta)));
}

void look_at(const Solid& solid, const ScenePoint& eye, const glm::dmat3& eye_from_scene, bool near_plane,
             bool infinity, SetUp set_up, EyeSolid& out) {
    out.set_up = set_up;
    // A cylinder or paraboloid without end is anchored where it is nearest to the eye, not where its file's numbers are
    // small.
    const double along = infinity ? glm::dot(solid.axis, eye.metres - solid.anchor.metres) : 0.0;
    out.scene_anchor = {solid.anchor.metres + along * solid.axis};
    const glm::dvec3 anchor = eye_from_scene * (out.scene_anchor.metres - eye.metres);
    const bool shear = set_up == SetUp::anchored && anchor.y > kLeastShearCosine * glm::length(anchor);
    out.x0 = shear ? anchor.x / anchor.y : 0.0;
    out.z0 = shear ? anchor.z / anchor.y : 0.0;
    out.anchor = shear ? glm::dvec3(0, anchor.y, 0) : anchor;
    // Columns of scene_from_sheared: where the sheared axes lie in the scene; p_scene = T p', so forms pull back as T'
    // M T.
    const glm::dmat3 scene_from_eye = glm::transpose(eye_from_scene);
    const glm::dmat3 scene_from_sheared{scene_from_eye[0],
                                        scene_from_eye[1] + out.x0 * scene_from_eye[0] + out.z0 * scene_from_eye[2],
                                        scene_from_eye[2]};
    out.m = congruent(solid.m, scene_from_sheared);
    // adj(T'MT) = T^-1 adj(M) T^-T
    out.adjugate =
        congruent(solid.adjugate, glm::dmat3{scene_from_eye[0] - out.x0 * scene_from_eye[1], scene_from_eye[1],
                                             scene_from_eye[2] - out.z0 * scene_from_eye[1]});
    out.determinant = solid.determinant;
    const auto covector = [&](const glm::dvec3& n) {
        return glm::dvec3(glm::dot(n, scene_from_sheared[0]), glm::dot(n, scene_from_sheared[1]),
                          glm::dot(n, scene_from_sheared[2]));
    };
    out.w = covector(solid.w);
    out.c = solid.c + 2.0 * along * glm::dot(solid.w, solid.axis);
    out.v = out.w - out.m * out.anchor;
    out.s = solid.quadric_at(eye);
    out.in_scene = in_scene(solid, eye.metres - out.scene_anchor.metres);
    set_forms(out);
    out.flat_side.reset();
    for (const SolidPlane& side : solid.flat_sides)
        if (const double at_eye = solid.plane_at(side, eye); at_eye < 0.0)
            out.flat_side = EyePlane{covector(side.normal), side.offset, at_eye, 0, false};

    out.planes.clear();
    out.first_face = 0;
    for (const SolidPlane& plane : solid.planes) {
        if (plane.surface == 0) out.first_face = static_cast<int>(out.planes.size()) + 1;
        out.planes.push_back({covector(plane.normal), plane.offset + along * glm::dot(plane.normal, solid.axis),
                              solid.plane_at(plane, eye), plane.surface == 0 ? kNoSurface : plane.surface,
                              plane.surface != 0, to_float(-plane.normal)});
    }
    if (near_plane) out.planes.push_back({{0, 1, 0}, out.anchor.y - kNearPlane, -kNearPlane, kNearSurface, true});
    if (infinity) out.planes.push_back({{0, 0, 0}, 1.0, 1.0, kNoSurface, true});
    if (set_up == SetUp::textbook) set_textbook_forms<double>(out);
    if (set_up == SetUp::textbook_single) set_textbook_forms<float>(out);
}

RowConic limb_on_rows(const EyeSolid& e) {
    if (e.set_up == SetUp::textbook) return textbook_limb_on_rows<double>(e);
    if (e.set_up == SetUp::textbook_single) return textbook_limb_on_rows<float>(e);
    const Sym3& l = e.limb;
    const Sym3& t = e.tangent;
    return {l.xx,
            {l.xy, l.xz},
            {l.yy, 2.0 * l.yz, l.zz},
            {-e.s * t.zz, 2.0 * e.s * t.yz, -e.s * t.yy}};  // -s l' tangent l with the row's plane l = (0, -zeta, 1)
}

RowConic intersection_curve_on_rows(const EyeSolid& e, const EyePlane& plane) {
    if (e.set_up == SetUp::textbook) return textbook_intersection_curve_on_rows<double>(e, plane);
    if (e.set_up == SetUp::textbook_single) return textbook_intersection_curve_on_rows<float>(e, plane);
    const glm::dvec3 &n = plane.normal, &a = e.anchor;
    const double bl = plane.local_offset;
    // The ray meets plane j at q = y / (n.d) about the anchor, y = n x (d x a) - P(a) d: three images of the axes.
    const glm::dvec3 along = n * a;
    const glm::dvec3 yx(along.y + along.z - bl, -a.y * n.x, -a.z * n.x);
    const glm::dvec3 yy(-a.x * n.y, along.x + along.z - bl, -a.z * n.y);
    const glm::dvec3 yz(-a.x * n.z, -a.y * n.z, along.x + along.y - bl);
    const glm::dvec3 mx = e.m * yx, my = e.m * yy, mz = e.m * yz;
    const double wx = glm::dot(e.w, yx), wy = glm::dot(e.w, yy), wz = glm::dot(e.w, yz);
    const auto entry = [&](const glm::dvec3& p, double hp, double wp, const glm::dvec3& mq, double hq, double wq) {
        return glm::dot(p, mq) + hp * wq + hq * wp + e.c * hp * hq;
    };
    RowConic conic;
    conic.alpha = entry(yx, n.x, wx, mx, n.x, wx);
    conic.beta = {entry(yx, n.x, wx, my, n.y, wy), entry(yx, n.x, wx, mz, n.z, wz)};
    conic.gamma = {entry(yy, n.y, wy, my, n.y, wy), 2.0 * entry(yy, n.y, wy, mz, n.z, wz),
                   entry(yz, n.z, wz, mz, n.z, wz)};
    // Planes l(zeta) = (0, -zeta, 1) through the eye and the row cut plane j in lines: direction n x l, moment P(a) l -
    // (l.a) n.
    const glm::dvec3 l0(0, 0, 1), l1(0, -1, 0);
    const double b2 = plane.at_eye * plane.at_eye;
    const auto [d0, d1, d2] =
        line_discriminants(e, {glm::cross(n, l0), bl * l0 - a.z * n}, {glm::cross(n, l1), bl * l1 + a.y * n});
    conic.discriminant = {b2 * d0, 2.0 * b2 * d1, b2 * d2};
    return conic;
}

glm::dvec3 visibility_line(const EyeSolid& e, const EyePlane& plane) {
    if (e.set_up == SetUp::textbook) return textbook_visibility_line<double>(e, plane);
    if (e.set_up == SetUp::textbook_single) return textbook_visibility_line<float>(e, plane);
    // s n - b v, expanded about the anchor.
    const glm::dvec3 &n = plane.normal, &a = e.anchor;
    const glm::dvec3 ma = e.w - e.v;
    return glm::cross(a, glm::cross(n, ma)) + (e.c - 2.0 * glm::dot(e.w, a)) * n - plane.local_offset * e.v +
           glm::dot(n, a) * e.w;
}

glm::dvec3 intersection_line(const EyeSolid& e, const EyePlane& i, const EyePlane& j) {
    if (e.set_up == SetUp::textbook) return textbook_intersection_line<double>(i, j);
    if (e.set_up == SetUp::textbook_single) return textbook_intersection_line<float>(i, j);
    // b_j n_i - b_i n_j, expanded about the anchor.
    return j.local_offset * i.normal - i.local_offset * j.normal - glm::cross(e.anchor, glm::cross(i.normal, j.normal));
}

int surface_at(const EyeSolid& e, double xi, double zeta) {
    const glm::dvec3 d(xi, 1.0, zeta);
    double from = 0.0, to = kInfinity;
    int surface = kNoSurface;
    for (const EyePlane& plane : e.planes) {
        const double slope = glm::dot(plane.normal, d);
        if (slope > 0.0) {
            const double k = -plane.at_eye / slope;
            if (k > from) from = k, surface = plane.surface;
        } else if (slope < 0.0) {
            to = std::min(to, -plane.at_eye / slope);
        } else if (plane.at_eye <= 0.0) {
            return kNoSurface;
        }
    }
    std::array<Interval, 2> pieces;
    const int count =
        inside_quadric(value(e.m, d), glm::dot(e.v, d), e.s, value(e.limb, d), kFlat * glm::dot(d, d), pieces);
    for (int i = 0; i < count; ++i) {
        const Interval& piece = pieces[static_cast<std::size_t>(i)];
        if (std::max(from, piece.from) >= std::min(to, piece.to)) continue;
        const int seen = piece.from > from ? 0 : surface;
        return seen < 0 ? kNoSurface : seen;
    }
    return kNoSurface;
}

}  // namespace quadrig
