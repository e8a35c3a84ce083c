/// Curves of the image as polylines: followed as closely as a drawing needs, cut off at the edges of a window.
///
/// Points are (x, z) on the image plane at distance 1.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace quadrig {

using Polyline = std::vector<glm::dvec2>;

/// Part of the image plane, x_from < x_to and z_from < z_to.
struct ImageWindow {
    double x_from = 0, x_to = 0, z_from = 0, z_to = 0;
    [[nodiscard]] double width() const { return x_to - x_from; }
    [[nodiscard]] double height() const { return z_to - z_from; }
};

/// Follows the curve x(z), which bends one way as a conic's does between its extrema, upwards from z_from to z_to.
/// Inside the window no chord strays from it by more than `tolerance`, also where x turns vertical at an end as a conic
/// does at its extrema. Where x(z) is NaN or infinite there is no curve: the pieces around such a gap are told apart.
std::vector<Polyline> follow(double z_from, double z_to, const std::function<double(double)>& x_at,
                             const ImageWindow& window, double tolerance);

/// From a point to the nearest of a polyline; infinite for one without chords.
double distance(const glm::dvec2& p, const Polyline& path);

/// What of a polyline lies inside the window.
std::vector<Polyline> clip(const Polyline& path, const ImageWindow& window);

/// The line a.x x + a.y + a.z z = 0 across the window: one piece, or none.
std::vector<Polyline> line_across(const glm::dvec3& a, const ImageWindow& window);

}  // namespace quadrig
