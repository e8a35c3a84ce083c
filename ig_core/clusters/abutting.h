/// Adjacent objects of one shape and the planes in which they meet (Gardner 1984, 2.3).
///
/// Two quadrics with the same quadratic part N,  Q_i(p) = (p - c_i)' N (p - c_i) + k_i,  differ by a linear form, so
/// all points common to both surfaces lie in the plane Q_i = Q_j. Each object is kept where its own Q is the smaller:
/// no point of the two solids is lost, none is left in both, and their surfaces meet on the plane without a gap. So it
/// is for ellipsoids of equal proportions and attitude and for hills of equal slope.
#pragma once

#include <span>

#include "ig_core/geometry/symmetric.h"
#include "ig_core/scene/scene.h"

namespace quadrig::clusters {

/// A quadric about its centre, as above: inside is negative.
struct CentredQuadric {
    Sym3 n;
    glm::dvec3 centre{0.0};
    double k = 0.0;
    double lowest_sheet_below = 0.0;  ///< hills: only the sheet below this Z is the solid; infinity for ellipsoids
    double top = 0.0;                 ///< Z below which the solid lies; infinity for ellipsoids
    double reach = 0.0;               ///< m, horizontal: objects farther apart than their reaches are not adjacent
};

/// An ellipsoid of the template's semi-axes, `size` times as large. Those of one template have the same N, bit for bit.
CentredQuadric centred(const Ellipsoid& ellipsoid, const glm::dvec3& template_semi_axes, double size);
/// A hill whose foot is at Z = `base`. Hills of one slope have the same N, bit for bit.
CentredQuadric centred(const Hill& hill, double base);

/// Whether two solids run into each other and are cut apart by the plane in which their surfaces meet.
bool abut(const CentredQuadric& a, const CentredQuadric& b);

/// The plane that keeps a where it meets b, its normal of unit length; the one that keeps b is its exact negative.
BoundingPlane shared_plane(const CentredQuadric& a, const CentredQuadric& b);

struct Adjacent {
    Object* object;
    CentredQuadric quadric;
};
/// Cuts objects by the planes they share with their neighbours, the deepest intersections first, no object by more than
/// `most_neighbours` or to more than kMaxPlanes in all. Where an object has more neighbours, those left are merely
/// overlapped, which looks the same. False where more than 4 million pairs overlap, or 400
/// million are near one another: nothing is cut then.
[[nodiscard]] bool cut_where_they_abut(std::span<Adjacent> objects, int most_neighbours);

}  // namespace quadrig::clusters
