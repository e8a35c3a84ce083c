/// Visibility figures as an SVG file (W3C SVG 1.1): all curves and lines, what is seen of them, and the shaded object.
#pragma once

#include <string>
#include <vector>

#include "config/appliance_file.h"
#include "ig_core/outline/figure.h"

namespace quadrig::appliance {

/// The three panels of one object, side by side.
struct FigureRow {
    std::string title, subtitle;  ///< plain text
    Figure figure;
    std::string picture;  ///< bytes of a PNG file of the same window
};

/// One row of panels below the other, each panel of this size in user units, which are pixels at 100 %.
std::string figure_svg(const std::vector<FigureRow>& rows, const config::ImageSize& panel);

}  // namespace quadrig::appliance
