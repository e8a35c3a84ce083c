/// CIGI's body axes, and how far its numbers may go.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace quadrig::host::cigi {

/// Axes of the wire: X forward (north), Y right (east), Z down. Ours: right, forward, up. A proper turn of axes, so
/// that it holds for axes of rotation too; the same turn leads back.
inline glm::dvec3 turn_axes(double x, double y, double z) { return {y, x, -z}; }

/// Whether all of some numbers are finite and no farther from 0 than `limit`.
bool below(double limit, const auto& values) {
    return std::ranges::all_of(values, [&](double value) { return std::abs(value) <= limit; });
}

}  // namespace quadrig::host::cigi
