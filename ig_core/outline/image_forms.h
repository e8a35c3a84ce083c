/// A solid seen from the eye, and the curves and lines its outline is made of (Gardner 1984, 2.1): all forms in the ray
/// direction d = (x, 1, z).
///
///   quadric along the ray (Eq 4)          A k^2 + 2 B k + C,  A = d'Md, B = v.d, C = s
///   limb curve (Eq 5, 6)                  d'Ld = 0, positive where the ray meets the quadric
///   intersection curve of plane j (Eq 8)  d'E_j d = 0
///   visibility line of plane j (Eq 12)    V_j.d = 0, positive where the limb is kept by the plane
///   intersection line of i, j (Eq 14)     X_ij.d = 0
///
/// Numerics. Everything is computed in a sheared eye space, X' = X - x0 Y, Z' = Z - z0 Y, whose Y axis runs through the
/// object's anchor: rays stay rays, k stays k, and image coordinates (xi, zeta) = (x - x0, z - z0) are measured from
/// the object. The forms are written in the moments of lines about the anchor a (d x a and the like) and in adj(M): the
/// products of scene-sized numbers that cancel in L = v v' - s M and E = b^2 M - b (v n' + n v') + s n n' never arise.
/// With w = 0, as for every quadric with a centre,
///
///   d'Ld = -(a x d)' adj(M) (a x d) - c d'Md
///
/// and a row's discriminant of E_j is b^2 (-m' adj(M) m - c u'Mu), m and u moment and direction of the line in which
/// the row's plane through the eye cuts plane j: exact also where the eye nearly lies in plane j. What must cancel, Q
/// and P at the eye, comes from extended precision in scene space.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ig_core/geometry/symmetric.h"
#include "ig_core/quality.h"
#include "ig_core/scene/solid.h"

namespace quadrig {

/// Bounding planes as the outline sees them: those of the file, and two of our own.
inline constexpr int kNoSurface = -1;
inline constexpr int kNearSurface = -2;               ///< where a ray enters at k_near or less: drawn as nothing
inline constexpr int kMaxEyePlanes = kMaxPlanes + 3;  ///< the file's, sheet, near, infinity

struct EyePlane {
    glm::dvec3 normal{0.0};
    double local_offset = 0.0;  ///< P at the anchor
    double at_eye = 0.0;        ///< P at the eye (B4 of Eq 10, 13): positive where the plane faces away
    int surface = kNoSurface;
    bool cuts = true;                      ///< false for a half-space that only picks a sheet
    std::array<float, 3> scene_outward{};  ///< unit normal of the solid's face, scene axes: for shading
};

/// The quadric in scene axes, in single precision: for shading.
struct SceneQuadric {
    std::array<float, 6> m{};                ///< M: xx yy zz xy xz yz
    std::array<float, 3> gradient{};         ///< w
    std::array<float, 3> eye_from_anchor{};  ///< m
    float inverse_centre_value = 0;          ///< 1 / |Q(centre)|, 0 for a quadric without a centre
};

/// A conic of the image restricted to the row zeta: alpha xi^2 + 2 beta xi + gamma, beta and gamma polynomials in zeta.
/// `discriminant` = beta^2 - alpha gamma as its own polynomial, free of cancellation.
struct RowConic {
    double alpha = 0;
    std::array<double, 2> beta{};
    std::array<double, 3> gamma{};
    std::array<double, 3> discriminant{};

    [[nodiscard]] double beta_at(double zeta) const { return beta[0] + zeta * beta[1]; }
    [[nodiscard]] double gamma_at(double zeta) const { return gamma[0] + zeta * (gamma[1] + zeta * gamma[2]); }
    [[nodiscard]] double discriminant_at(double zeta) const {
        return discriminant[0] + zeta * (discriminant[1] + zeta * discriminant[2]);
    }
};

/// Whether the row is clear of the curve by more than rounding. A wedge's edge is a double line: it is touched
/// everywhere.
bool misses_row(const RowConic& conic, double zeta);

/// What rows and samples ask for comes first, what only the set-up does last.
struct EyeSolid {
    double x0 = 0, z0 = 0;  ///< image point of the sheared Y axis
    glm::dvec3 v{0.0};      ///< gradient of Q/2 at the eye
    double s = 0;           ///< Q at the eye
    Sym3 m;
    Sym3 limb;  ///< L
    SceneQuadric in_scene;
    int first_face = 0;                 ///< index in `planes` of surface 1's, which the file's others follow
    std::optional<EyePlane> flat_side;  ///< the one of Solid::flat_sides that faces the eye: all of the quadric seen
    std::vector<EyePlane> planes;       ///< at most kMaxEyePlanes
    ScenePoint scene_anchor;            ///< Solid's, or another on its axis
    SetUp set_up = SetUp::anchored;
    glm::dvec3 anchor{0.0};
    Sym3 adjugate;
    double determinant = 0;
    glm::dvec3 w{0.0};
    double c = 0;
    Sym3 tangent;  ///< planes l.p = 0 through the eye touch the quadric where l' tangent l = 0 (dual of the limb, over
                   ///< s)

    /// The plane of surface j > 0.
    [[nodiscard]] const EyePlane& face(int surface) const {
        return planes[static_cast<std::size_t>(first_face + surface - 1)];
    }
};

/// Brings a solid into the sheared eye space of an eye point and attitude. `near_plane` and `infinity` add those
/// bounds. With a textbook set-up there is no shear, and this and the following are as the paper has them
/// (textbook_forms.h).
void look_at(const Solid& solid, const ScenePoint& eye, const glm::dmat3& eye_from_scene, bool near_plane,
             bool infinity, SetUp set_up, EyeSolid& out);

RowConic limb_on_rows(const EyeSolid& solid);
RowConic intersection_curve_on_rows(const EyeSolid& solid, const EyePlane& plane);
glm::dvec3 visibility_line(const EyeSolid& solid, const EyePlane& plane);
glm::dvec3 intersection_line(const EyeSolid& solid, const EyePlane& i, const EyePlane& j);

/// Relative to what is summed up: a point kept in vain costs one more question, one lost costs a wrong picture.
inline constexpr double kKeeping = 1e-6;

/// First surface that the ray through (xi, zeta) enters, as EyePlane::surface (0 the quadric), or kNoSurface;
/// kNearSurface is turned into kNoSurface. This is the slow, sure answer for one ray; z-bands carry it from row to row.
int surface_at(const EyeSolid& solid, double xi, double zeta);

}  // namespace quadrig
