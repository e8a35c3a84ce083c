#include "ig_core/scene/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ig_core/scene/solid_edges.h"

namespace quadrig {
namespace {

using Quad = __float128;
using Quad3 = std::array<Quad, 3>;

/// Q(p) = p' M p + 2 v.p + s in scene space, 113-bit.
struct QuadQuadric {
    Quad m[3][3];
    Quad v[3];
    Quad s;
};

Quad magnitude(Quad a) { return a < 0 ? -a : a; }

/// Ellipsoid about its centre: M = R diag(1/a^2) R', c = -1; adj(M) = R diag(1/(bc)^2 ...) R'.
void set_ellipsoid(const Ellipsoid& e, Solid& solid) {
    const glm::dvec3 a2 = e.semi_axes * e.semi_axes;
    const double smallest = std::min({a2.x, a2.y, a2.z});
    const glm::dvec3 scaled = smallest / a2;  // at most 1
    const glm::dmat3 body_from_scene = eye_from_scene_rotation(e.attitude);
    const auto in_scene = [&](const glm::dvec3& diagonal) {
        return congruent({diagonal.x, diagonal.y, diagonal.z, 0, 0, 0}, body_from_scene);
    };
    solid.anchor = e.centre;
    solid.m = in_scene(scaled);
    solid.adjugate = in_scene({scaled.y * scaled.z, scaled.x * scaled.z, scaled.x * scaled.y});
    solid.determinant = scaled.x * scaled.y * scaled.z;
    solid.c = -smallest;
    solid.centre_value = smallest;
    solid.ellipsoid = true;
    solid.radius = std::max({e.semi_axes.x, e.semi_axes.y, e.semi_axes.z});
}

/// Beyond this slope a hill is written about its apex: its centre lies slope^2 radii of curvature above that, so far
/// that little of a double would be left for the hill.
constexpr double kSteepest = 30.0;

/// Hill about its apex: x^2 + y^2 - z^2/slope^2 + 2 r z <= 0.
void set_steep_hill(const Hill& hill, Solid& solid) {
    const double r = hill.radius_of_curvature, steep = hill.slope * hill.slope;
    solid.anchor = hill.apex;
    solid.m = {1, 1, -1 / steep, 0, 0, 0};
    solid.adjugate = {-1 / steep, -1 / steep, 1, 0, 0, 0};
    solid.determinant = -1 / steep;
    solid.w = {0, 0, r};
    solid.centre_value = r * r * steep;
    solid.planes.push_back({{0, 0, -1}, r * steep, 0});
}

/// Hill about its centre, c above the apex: (x^2 + y^2)/a^2 - z^2/c^2 + 1 <= 0, scaled by a^2.
void set_hill(const Hill& hill, Solid& solid) {
    if (hill.slope > kSteepest) return set_steep_hill(hill, solid);
    const double c = hill.radius_of_curvature * hill.slope * hill.slope, a = hill.radius_of_curvature * hill.slope;
    const double steep = hill.slope * hill.slope;  // c^2/a^2
    const double scale = std::min(1.0, steep);     // keeps the largest entry of M at 1
    solid.anchor = {{hill.apex.metres.x, hill.apex.metres.y, hill.apex.metres.z + c}};
    const double horizontal = scale, vertical = -scale / steep;
    solid.m = {horizontal, horizontal, vertical, 0, 0, 0};
    solid.adjugate = {horizontal * vertical, horizontal * vertical, horizontal * horizontal, 0, 0, 0};
    solid.determinant = horizontal * horizontal * vertical;
    // The anchor's rounding goes into w and c, so that the apex stays where the file puts it.
    const double rounding = static_cast<double>((static_cast<Quad>(hill.apex.metres.z) + static_cast<Quad>(c)) -
                                                static_cast<Quad>(solid.anchor.metres.z));
    solid.w = {0, 0, -vertical * rounding};
    solid.c = scale * a * a + vertical * rounding * rounding;
    solid.centre_value = scale * a * a;
    solid.planes.push_back({{0, 0, -1}, rounding, 0});
}

QuadQuadric expand(const GeneralQuadric& g) {
    const auto& q = g.coefficients;
    const auto half = [](double x) { return static_cast<Quad>(x) / 2; };
    return {{{q[0], half(q[3]), half(q[5])}, {half(q[3]), q[1], half(q[4])}, {half(q[5]), half(q[4]), q[2]}},
            {half(q[6]), half(q[7]), half(q[8])},
            q[9]};
}

/// Solves M x = -v with full pivoting. Pivots of `least` or less count as zero: their unknowns stay 0. Returns the
/// rank.
int solve(const QuadQuadric& q, Quad least, Quad3& x) {
    Quad a[3][4];
    for (int r = 0; r < 3; ++r) {
        for (int k = 0; k < 3; ++k) a[r][k] = q.m[r][k];
        a[r][3] = -q.v[r];
    }
    int column_of[3] = {0, 1, 2}, rank = 0;
    for (; rank < 3; ++rank) {
        int pr = rank, pc = rank;
        for (int r = rank; r < 3; ++r)
            for (int k = rank; k < 3; ++k)
                if (magnitude(a[r][k]) > magnitude(a[pr][pc])) pr = r, pc = k;
        if (magnitude(a[pr][pc]) <= least) break;
        for (int k = 0; k < 4; ++k) std::swap(a[rank][k], a[pr][k]);
        for (auto& row : a) std::swap(row[rank], row[pc]);
        std::swap(column_of[rank], column_of[pc]);
        for (int r = 0; r < 3; ++r) {
            if (r == rank) continue;
            const Quad factor = a[r][rank] / a[rank][rank];
            for (int k = rank; k < 4; ++k) a[r][k] -= factor * a[rank][k];
        }
    }
    x = {0, 0, 0};
    for (int r = 0; r < rank; ++r) x[static_cast<std::size_t>(column_of[r])] = a[r][3] / a[r][r];
    return rank;
}

/// Of the points on the axis of a cylinder, near that of a paraboloid, or midway in a slab, the one nearest to all
/// planes together: a solid whose quadric does not say where along the axis it lies is found by its caps. Least
/// squares, |Mx + v| counting 1e8 times as much as the distance from a plane.
Quad3 point_among_planes(const QuadQuadric& q, const std::vector<BoundingPlane>& planes) {
    QuadQuadric sum{};
    const auto add_square = [&sum](const Quad(&n)[3], Quad b, Quad weight) {
        for (int r = 0; r < 3; ++r) {
            for (int k = 0; k < 3; ++k) sum.m[r][k] += weight * n[r] * n[k];
            sum.v[r] += weight * b * n[r];
        }
    };
    for (int r = 0; r < 3; ++r) add_square(q.m[r], q.v[r], 1e16);
    for (const BoundingPlane& plane : planes) {
        const Quad n[3] = {plane.coefficients[0], plane.coefficients[1], plane.coefficients[2]};
        add_square(n, plane.coefficients[3], 1 / (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    }
    Quad3 point;
    solve(sum, 1e-6, point);
    return point;
}

bool parallel(const Quad (&a)[3], const Quad (&b)[3]) {
    const auto square = [](const Quad(&v)[3]) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
    const Quad cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return square(cross) <= static_cast<Quad>(1e-60) * square(a) * square(b);
}

/// The planes of a quadric that changes along one direction n only: m t^2 + 2 g t + c, t = n.(p - anchor), m >= 0.
/// `w` and `c` are those about the anchor.
std::vector<SolidPlane> flat_sides(const QuadQuadric& q, const Quad (&w)[3], Quad c) {
    int lead = 0;
    for (int i = 1; i < 3; ++i)
        if (magnitude(q.m[i][i]) > magnitude(q.m[lead][lead])) lead = i;
    const bool linear = q.m[lead][lead] == 0;
    const Quad(&along)[3] = linear ? q.v : q.m[lead];
    if (q.m[lead][lead] < 0 || !parallel(q.v, along)) return {};
    for (const auto& row : q.m)
        if (!parallel(row, along)) return {};
    const auto d = [](Quad v) { return static_cast<double>(v); };
    const glm::dvec3 normal = glm::normalize(glm::dvec3(d(along[0]), d(along[1]), d(along[2])));
    if (!(glm::dot(normal, normal) > 0.5)) return {};  // constant
    const double m = d(q.m[0][0] + q.m[1][1] + q.m[2][2]), g = glm::dot(normal, {d(w[0]), d(w[1]), d(w[2])});
    if (linear) return {{-normal, d(c) / (-2.0 * g), 0}};
    const double half2 = g * g - m * d(c);
    if (!(half2 > 0.0)) return {};
    const double half = std::sqrt(half2);
    return {{normal, (g + half) / m, 0}, {-normal, (half - g) / m, 0}};
}

/// The axis of a cylinder or paraboloid: a direction u with M u = 0, and across v where M leaves a choice. Zero if
/// there is none.
glm::dvec3 axis_of(const QuadQuadric& q) {
    const auto square = [](const Quad3& u) { return u[0] * u[0] + u[1] * u[1] + u[2] * u[2]; };
    Quad3 axis{};
    const auto consider = [&](const Quad(&a)[3], const Quad(&b)[3]) {
        const Quad3 u{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        if (square(u) > square(axis)) axis = u;
    };
    for (int i = 0; i < 3; ++i) consider(q.m[i], q.m[(i + 1) % 3]);
    if (square(axis) == 0)
        for (const auto& row : q.m) consider(row, q.v);
    for (const auto& row : q.m) {
        const Quad change = row[0] * axis[0] + row[1] * axis[1] + row[2] * axis[2];
        const Quad terms = square({row[0], row[1], row[2]}) * square(axis);
        if (change * change > static_cast<Quad>(1e-60) * terms) return glm::dvec3(0.0);
    }
    const glm::dvec3 along(static_cast<double>(axis[0]), static_cast<double>(axis[1]), static_cast<double>(axis[2]));
    const double length = glm::length(along);
    return length > 0.0 ? along / length : glm::dvec3(0.0);
}

bool positive_definite(const Sym3& m, const Sym3& adjugate, double determinant) {
    return m.xx > 0 && m.yy > 0 && m.zz > 0 && adjugate.xx > 0 && adjugate.yy > 0 && adjugate.zz > 0 && determinant > 0;
}

/// Q(centre) is 0 where it is no more than this share of its terms: the rounding of a cone's ten coefficients, by which
/// its limb would be a hole.
constexpr Quad kVanishes = 1e-15;

void set_general(const GeneralQuadric& general, const std::vector<BoundingPlane>& planes, Solid& solid) {
    QuadQuadric q = expand(general);
    Quad largest = 0;
    for (const auto& row : q.m)
        for (const Quad entry : row) largest = std::max(largest, magnitude(entry));
    if (largest == 0)
        for (const Quad entry : q.v) largest = std::max(largest, magnitude(entry));
    if (largest == 0) largest = 1;
    for (auto& row : q.m)
        for (Quad& entry : row) entry /= largest;
    for (Quad& entry : q.v) entry /= largest;
    q.s /= largest;

    Quad3 anchor;
    const int rank = solve(q, 1e-12, anchor);
    if (rank < 3) anchor = point_among_planes(q, planes);
    for (int i = 0; i < 3; ++i) solid.anchor.metres[i] = static_cast<double>(anchor[static_cast<std::size_t>(i)]);
    Quad w[3], c = q.s;
    for (int i = 0; i < 3; ++i) {
        w[i] = q.v[i];
        for (int k = 0; k < 3; ++k) w[i] += q.m[i][k] * static_cast<Quad>(solid.anchor.metres[k]);
        c += (w[i] + q.v[i]) * static_cast<Quad>(solid.anchor.metres[i]);
        solid.w[i] = static_cast<double>(w[i]);
    }
    const auto cofactor = [&](int r, int k) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        return q.m[r1][k1] * q.m[r2][k2] - q.m[r1][k2] * q.m[r2][k1];
    };
    const auto d = [](Quad v) { return static_cast<double>(v); };
    solid.m = {d(q.m[0][0]), d(q.m[1][1]), d(q.m[2][2]), d(q.m[0][1]), d(q.m[0][2]), d(q.m[1][2])};
    solid.adjugate = {d(cofactor(0, 0)), d(cofactor(1, 1)), d(cofactor(2, 2)),
                      d(cofactor(0, 1)), d(cofactor(0, 2)), d(cofactor(1, 2))};
    solid.determinant = d(q.m[0][0] * cofactor(0, 0) + q.m[0][1] * cofactor(0, 1) + q.m[0][2] * cofactor(0, 2));
    solid.c = d(c);
    solid.flat_sides = flat_sides(q, w, c);
    solid.axis = axis_of(q);
    solid.ellipsoid = rank == 3 && positive_definite(solid.m, solid.adjugate, solid.determinant);
    const Quad terms = magnitude(q.s) + magnitude(q.v[0] * anchor[0] + q.v[1] * anchor[1] + q.v[2] * anchor[2]);
    solid.centre_value = rank == 3 && magnitude(c) > kVanishes * terms ? std::abs(solid.c) : 0.0;
    if (solid.ellipsoid) {
        // Largest semi-axis squared is -c / (smallest eigenvalue) <= -c trace(adj)/det, since the others' product is at
        // most that.
        const double trace = solid.adjugate.xx + solid.adjugate.yy + solid.adjugate.zz;
        solid.radius = std::sqrt(std::max(0.0, -solid.c) * trace / solid.determinant);
    }
}

void add_plane(const BoundingPlane& plane, int surface, Solid& solid) {
    const auto& b = plane.coefficients;
    const Quad length2 =
        static_cast<Quad>(b[0]) * b[0] + static_cast<Quad>(b[1]) * b[1] + static_cast<Quad>(b[2]) * b[2];
    Quad offset = b[3];
    for (int i = 0; i < 3; ++i)
        offset += static_cast<Quad>(b[static_cast<std::size_t>(i)]) * static_cast<Quad>(solid.anchor.metres[i]);
    const double length = std::sqrt(static_cast<double>(length2));
    solid.planes.push_back({glm::dvec3(b[0], b[1], b[2]) / length, static_cast<double>(offset / length), surface});
}

/// Whether the solid goes on for ever in direction d: the quadric's asymptotic cone and every half-space contain it.
/// Errs on the side of yes.
bool recedes(const Solid& solid, const glm::dvec3& direction) {
    const double length = glm::length(direction);
    if (!(length > 1e-12)) return false;
    const glm::dvec3 d = direction / length;
    if (value(solid.m, d) > 1e-9) return false;
    return std::all_of(solid.planes.begin(), solid.planes.end(),
                       [&](const SolidPlane& p) { return glm::dot(p.normal, d) > -1e-9; });
}

/// Looks at every extreme direction of {d'Md <= 0, n_j.d >= 0}: if that cone is more than its tip, one of them is in
/// it.
bool endless(const Solid& solid) {
    if (solid.ellipsoid) return false;
    std::vector<glm::dvec3> normals;
    for (const SolidPlane& p : solid.planes) normals.push_back(p.normal);
    // Directions along an axis of M serve cones that no plane touches.
    const auto both_ways = [&](const glm::dvec3& d) { return recedes(solid, d) || recedes(solid, -d); };
    const Sym3& a = solid.adjugate;
    for (const glm::dvec3& d :
         {glm::dvec3(a.xx, a.xy, a.xz), glm::dvec3(a.xy, a.yy, a.yz), glm::dvec3(a.xz, a.yz, a.zz)})
        if (both_ways(d)) return true;
    for (int k = 0; k < 3; ++k) normals.push_back({k == 0, k == 1, k == 2});  // a frame to span directions with
    for (std::size_t i = 0; i < normals.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            if (both_ways(glm::cross(normals[i], normals[j]))) return true;
        // Where plane i meets the asymptotic cone: a quadratic in the plane's own basis.
        const glm::dvec3 n = normals[i];
        const glm::dvec3 e =
            glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 f = glm::cross(n, e);
        const double ee = value(solid.m, e), ef = value(solid.m, e, f), ff = value(solid.m, f);
        const double discriminant = std::max(0.0, ef * ef - ee * ff);
        for (const double sign : {-1.0, 1.0}) {
            if (both_ways(e * (-ef + sign * std::sqrt(discriminant)) + f * ee)) return true;
            if (both_ways(f * (-ef + sign * std::sqrt(discriminant)) + e * ff)) return true;
        }
    }
    return false;
}

/// Radius of a sphere about the anchor that holds a solid whose quadric goes on for ever: in it Q <= 0 and P_i, P_j >
/// 0, so Q - t P_i P_j <= 0 for every t >= 0, and where that form is positive definite it is an ellipsoid. This closes
/// hills, cylinders and cones between two of their planes. Infinity where it closes nothing.
double radius_between_planes(const Solid& solid) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < solid.planes.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const SolidPlane &a = solid.planes[i], &b = solid.planes[j];
            for (const double t : {0.5, 2.0, 8.0}) {
                const Sym3 m = solid.m - 0.5 * t * outer(a.normal, b.normal);
                const Sym3 adjugate{m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
                                    m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy, m.xy * m.xz - m.yz * m.xx};
                const double determinant = m.xx * adjugate.xx + m.xy * adjugate.xy + m.xz * adjugate.xz;
                constexpr double kClearlyDefinite = 1e-9;  // the largest entry of M is about 1
                if (!(m.xx > kClearlyDefinite && adjugate.zz > kClearlyDefinite && determinant > kClearlyDefinite))
                    continue;
                const glm::dvec3 w = solid.w - 0.5 * t * (b.offset * a.normal + a.offset * b.normal);
                const glm::dvec3 centre = (-1.0 / determinant) * (adjugate * w);
                const double at_centre = solid.c - t * a.offset * b.offset + glm::dot(w, centre);
                const double trace = adjugate.xx + adjugate.yy + adjugate.zz;
                const double reach = std::sqrt(std::max(0.0, -at_centre) * trace / determinant);
                constexpr double kRounding = 1e-6;
                least = std::min(least, (glm::length(centre) + reach) * (1.0 + kRounding));
            }
        }
    }
    return least;
}

}  // namespace

double Solid::quadric_at(const ScenePoint& p) const {
    const long double x = static_cast<long double>(p.metres.x) - anchor.metres.x;
    const long double y = static_cast<long double>(p.metres.y) - anchor.metres.y;
    const long double z = static_cast<long double>(p.metres.z) - anchor.metres.z;
    const long double q = x * (m.xx * x + 2.0L * (m.xy * y + m.xz * z + w.x)) +
                          y * (m.yy * y + 2.0L * (m.yz * z + w.y)) +
                          z * (m.zz * z + 2.0L * static_cast<long double>(w.z)) + c;
    return static_cast<double>(q);
}

double Solid::plane_at(const SolidPlane& plane, const ScenePoint& p) const {
    long double sum = plane.offset;
    for (int i = 0; i < 3; ++i) sum += plane.normal[i] * (static_cast<long double>(p.metres[i]) - anchor.metres[i]);
    return static_cast<double>(sum);
}

Solid make_solid(const Object& object) {
    Solid solid;
    solid.radius = std::numeric_limits<double>::infinity();
    if (const auto* ellipsoid = std::get_if<Ellipsoid>(&object.shape)) set_ellipsoid(*ellipsoid, solid);
    if (const auto* hill = std::get_if<Hill>(&object.shape)) set_hill(*hill, solid);
    if (const auto* general = std::get_if<GeneralQuadric>(&object.shape)) set_general(*general, object.planes, solid);
    for (std::size_t j = 0; j < object.planes.size(); ++j) add_plane(object.planes[j], static_cast<int>(j) + 1, solid);
    if (!solid.ellipsoid) solid.radius = radius_between_planes(solid);
    solid.may_be_endless = endless(solid);
    if (!solid.may_be_endless) find_edges(solid);
    return solid;
}

}  // namespace quadrig
