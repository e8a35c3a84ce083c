#include "ig_core/view.h"

#include <cmath>

namespace quadrig {

ImagePlane ImagePlane::symmetric(int width, int height, Degrees horizontal_fov) {
    const double step = 2.0 * std::tan(horizontal_fov.radians() / 2.0) / width;
    return {width, height, -0.5 * width * step, step, 0.5 * height * step, step};
}

ImagePlane ImagePlane::window(int width, int height, Degrees left, Degrees right, Degrees top, Degrees bottom) {
    const double tan_left = std::tan(left.radians()), tan_top = std::tan(top.radians());
    return {width,    height,
            tan_left, (std::tan(right.radians()) - tan_left) / width,
            tan_top,  (tan_top - std::tan(bottom.radians())) / height};
}

}  // namespace quadrig
