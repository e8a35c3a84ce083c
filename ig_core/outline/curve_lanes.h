/// The curves of an outline and the points on them that can be key points, one curve a vector lane.
#pragma once

#include <array>
#include <cstddef>

#include "ig_core/outline/image_forms.h"

namespace quadrig {

/// Lane 0 is the limb's, the others are those of the planes that cut, in their order.
struct CurveLanes {
    /// The limb and every plane, in whole vectors.
    static constexpr std::size_t kCapacity = (1 + kMaxEyePlanes + 7) / 8 * 8;
    /// One number for each curve.
    using Lanes = std::array<double, kCapacity>;
    using Lanes2 = std::array<Lanes, 2>;
    using Lanes3 = std::array<Lanes, 3>;

    std::size_t count = 1;
    // Of the planes: index into EyeSolid::planes, and what EyePlane has.
    Lanes plane;
    Lanes3 normal;
    Lanes local_offset, at_eye;
    // Of their curves: a RowConic, and the visibility line (Eq 12).
    Lanes alpha;
    Lanes2 beta;
    Lanes3 gamma, discriminant;
    Lanes3 visibility_line;

    /// Image points; zeta is not a number where there is none.
    struct Point {
        Lanes xi, zeta;
    };
    std::array<Point, 2> extrema;   ///< in zeta; of the limb, too
    std::array<Point, 2> contacts;  ///< where limb and visibility line meet (Eq 6, 12)

    /// Takes the next lane for a plane.
    void add(std::size_t index, const EyePlane& of) {
        plane[count] = static_cast<double>(index);
        for (std::size_t i = 0; i < 3; ++i) normal[i][count] = of.normal[static_cast<int>(i)];
        local_offset[count] = of.local_offset, at_eye[count] = of.at_eye;
        ++count;
    }
    void set_curve(std::size_t lane, const RowConic& conic, const glm::dvec3& line) {
        alpha[lane] = conic.alpha;
        for (std::size_t i = 0; i < 2; ++i) beta[i][lane] = conic.beta[i];
        for (std::size_t i = 0; i < 3; ++i) {
            gamma[i][lane] = conic.gamma[i], discriminant[i][lane] = conic.discriminant[i];
            visibility_line[i][lane] = line[static_cast<int>(i)];
        }
    }
    [[nodiscard]] RowConic conic(std::size_t lane) const {
        return {alpha[lane],
                {beta[0][lane], beta[1][lane]},
                {gamma[0][lane], gamma[1][lane], gamma[2][lane]},
                {discriminant[0][lane], discriminant[1][lane], discriminant[2][lane]}};
    }
    [[nodiscard]] glm::dvec3 line(std::size_t lane) const {
        return {visibility_line[0][lane], visibility_line[1][lane], visibility_line[2][lane]};
    }
};

/// Fills in conics and visibility lines of an anchored set-up whose anchor is on the Y axis, as in a sheared space:
/// intersection_curve_on_rows and visibility_line without the terms that are zero there. Expects planes.
void find_curves_about_axis(const EyeSolid& solid, CurveLanes& curves);

/// Fills in the points that lie in front of the eye, are kept by all planes but their curve's own, and are not on the
/// far side of the quadric, each to within kKeeping. Expects planes, conics and visibility lines.
void find_points(const EyeSolid& solid, const RowConic& limb, CurveLanes& curves);

/// Whether the quadric through one point of the sheared eye space is entered there by the ray from the eye, to within
/// kKeeping.
bool faces_eye(const EyeSolid& solid, const glm::dvec3& point);

}  // namespace quadrig
