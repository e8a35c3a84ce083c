/// A scene as one eye sees it: its solids about the eye in three precisions, and what bounds them.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "ig_core/reference/candidates.h"
#include "ig_core/reference/solid.h"

namespace quadrig::reference {

struct SeenScene {
    SeenScene(const Scene& scene, const View& view);

    const Scene& scene;
    const View& view;
    std::vector<Solid<Quad>> exact;          ///< where a sign is in doubt
    std::vector<Solid<long double>> values;  ///< where a value is asked
    std::vector<Solid<double>> triage;       ///< for entry_bounds
    std::vector<BoundingSphere> spheres;

    /// A light's disc: in pixels where it is and how far it reaches, and its depth.
    struct Disc {
        std::uint32_t light;
        double column, row, across, down, depth;
    };
    std::vector<Disc> discs;  ///< of the lights that the eye may see

    template <class Scalar>
    [[nodiscard]] const Solid<Scalar>& solid(std::uint32_t object) const {
        if constexpr (std::is_same_v<Scalar, Quad>)
            return exact[object];
        else
            return values[object];
    }
    /// Scene direction of the ray through an image point.
    [[nodiscard]] Vector<double> direction(double column, double row) const;
};

/// Depth of a level plane, if it is in front of the eye. A ray that is level to the image plane's rounding meets none.
template <class Scalar>
std::optional<Scalar> level_depth(const View& view, double altitude, const Vector<Scalar>& direction) {
    const double widest = std::abs(view.image.left) + std::abs(view.image.top) + 1.0;
    const Scalar level = 4.0 * std::numeric_limits<double>::epsilon() * widest;
    const Scalar drop = Scalar(altitude) - Scalar(view.eye.metres.z);
    if ((direction[2] <= level && direction[2] >= -level) || !(drop / direction[2] > 0)) return std::nullopt;
    return drop / direction[2];
}

/// Whether a is in front of b by more than rounding; if not, file order decides.
template <class Scalar>
bool in_front(Scalar a, Scalar b) {
    return b == std::numeric_limits<long double>::infinity() || b - a > Limits<Scalar>::thin * b;
}

}  // namespace quadrig::reference
