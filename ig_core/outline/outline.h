/// The picture outline of one object: key points, z-bands and, in each band, the visible boundaries and the surfaces
/// between them (Gardner 1984, 2.1).
///
/// Key points are the only places where the visible boundaries of a convex object change from scan line to scan line:
/// extrema of the limb and of intersection curves, contact points, and the ends of the edges along which two planes
/// meet (intersection points and triplets). Only those that lie on the object count. Between two of them the order of
/// boundaries and surfaces is constant; it is found once, on a typical scan line, by asking for the surface
/// inside every interval.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "ig_core/outline/image_bounds.h"
#include "ig_core/outline/image_forms.h"

namespace quadrig {

/// A boundary curve of an outline on the way of a scan line.
struct Boundary {
    enum class Kind : std::uint8_t { rising, falling, line, left_end, right_end };
    Kind kind;
    std::uint16_t index;  ///< into Outline::curves or Outline::lines
};

/// A place on a row where the visible surface changes.
struct Change {
    Boundary boundary;
    std::int8_t surface;  ///< to its right
};

/// An edge: the image of the line in which two bounding planes meet, over the part that lies on the object.
struct EdgeLine {
    glm::dvec3 line{0.0};  ///< X_ij of Eq 14
    double zeta_from = 0, zeta_to = 0;
    std::uint8_t plane = 0, other_plane = 0;  ///< i and j, indices into EyeSolid::planes
};

/// Rows on which a curve can be seen: from the first to the last of the key points on it.
struct CurveRows {
    double zeta_from = std::numeric_limits<double>::infinity();
    double zeta_to = -std::numeric_limits<double>::infinity();
    void add(double zeta) {
        zeta_from = std::min(zeta_from, zeta);
        zeta_to = std::max(zeta_to, zeta);
    }
    static constexpr double kRounding = 1e-9;
    [[nodiscard]] bool may_hold(double zeta) const {
        return zeta >= zeta_from - kRounding && zeta <= zeta_to + kRounding;
    }
};

/// A curve that can bound what is seen: the limb, or the intersection curve of a plane.
struct Curve : RowConic {
    CurveRows rows;                   ///< not of solids without end
    glm::dvec3 visibility_line{0.0};  ///< V_j of the plane (Eq 12)
};

/// Rows from zeta_from to zeta_to that show changes first..first+count-1 (indices into Outline::changes), from left to
/// right.
struct ZBand {
    double zeta_from = 0, zeta_to = 0;
    std::uint32_t first = 0, count = 0;
};

struct KeyPoint {
    enum class Kind : std::uint8_t { limb_extremum, curve_extremum, contact, edge_end };
    double xi, zeta;
    Kind kind;
};

struct Outline {
    std::uint32_t object = 0;
    bool limb_only = false;        ///< nothing but the limb: one band, one surface
    bool direct = false;           ///< every row is solved by itself: solids without end
    double zeta_from, zeta_to;     ///< rows outside show nothing
    double near_u = 0, far_u = 0;  ///< bounds of 1/k over the solid
    std::vector<ZBand> bands;      ///< by rising zeta; what is in none of them shows nothing
    std::vector<Change> changes;
    std::vector<Curve> curves;  ///< [0] the limb, then the intersection curves of the planes that cut
    std::vector<EdgeLine> lines;
    EyeSolid solid;
    std::vector<KeyPoint> key_points;

    Outline() { show_on_no_row(); }
    void show_on_no_row() {
        zeta_from = std::numeric_limits<double>::infinity();
        zeta_to = -std::numeric_limits<double>::infinity();
    }
};

/// The rows on which outlines will be asked for: z = top - (row + 1/2) step, row in 0..count-1.
struct RowGrid {
    double top = 0, step = 1;
    int count = 0;
    [[nodiscard]] double z(int row) const { return top - (row + 0.5) * step; }
    friend bool operator==(const RowGrid&, const RowGrid&) = default;
};

/// Part of a scan line on which one surface of an object is seen; x in image-plane units (distance 1), from < to.
struct Cut {
    double from, to;
    int surface;
};
/// At most so many cuts on one row: each of the 19 planes and the quadric can show twice.
inline constexpr int kMaxCuts = 40;

/// Builds the outline of a solid whose image_bounds from the same eye are known. Reuses the memory of `out`.
void make_outline(const Solid& solid, const ImageBounds& bounds, std::uint32_t object, const ScenePoint& eye,
                  const glm::dmat3& eye_from_scene, const RowGrid& rows, Outline& out, SetUp set_up = SetUp::anchored);
/// The same with bounds of its own.
void make_outline(const Solid& solid, std::uint32_t object, const ScenePoint& eye, const glm::dmat3& eye_from_scene,
                  const RowGrid& rows, Outline& out, SetUp set_up = SetUp::anchored);

/// Which z-band of an outline a scan line lies in. Scan lines come in order, so the next one's is looked for from there
/// on; whatever it is to begin with is right.
using BandPlace = std::uint32_t;
inline constexpr BandPlace kHighestBand = std::numeric_limits<BandPlace>::max();

/// That band; null where there is none.
const ZBand* band_on_row(const Outline& outline, double zeta, BandPlace& place);

/// The visible surfaces on the scan line z, from left to right: from the z-band the row lies in, or solved directly
/// where the band's order does not hold to within rounding. Returns how many were written to `cuts` (room for
/// kMaxCuts).
int cuts_on_row(const Outline& outline, double z, BandPlace& band, Cut* cuts);
inline int cuts_on_row(const Outline& outline, double z, Cut* cuts) {
    BandPlace band = kHighestBand;
    return cuts_on_row(outline, z, band, cuts);
}

/// The same by the row's z-band alone; absent where the row has to be solved directly.
std::optional<int> cuts_by_band(const Outline& outline, double z, BandPlace& band, Cut* cuts);

/// Ends of an outline that is nothing but its limb, on several scan lines at once; from > to where a line misses it.
void limb_on_lines(const Outline& outline, const double* z, std::size_t count, double* from, double* to);

/// The same without z-bands: every boundary candidate of the row, every interval asked.
int cuts_on_row_directly(const Outline& outline, double z, Cut* cuts);

}  // namespace quadrig
