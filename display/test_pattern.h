/// A picture to judge a display by, in place of the scene.
///
/// Upper two thirds: eight bars of equal width, white, yellow, cyan, green, magenta, red, blue, black, each channel 0
/// or 255. Below: sixteen greys of equal width, 0 to 255 in steps of 17, dark to the left. All around, a white line of
/// one pixel: where it cannot be seen whole, the display cuts.
#pragma once

#include "ig_core/view.h"

namespace quadrig::display {

/// Fills the picture. Allocates nothing.
void draw_test_pattern(const FrameImage& picture);

}  // namespace quadrig::display
