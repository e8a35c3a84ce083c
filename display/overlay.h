/// What is laid over the picture: a cross in its centre and the frame's number, drawn with GL once, kept as runs of
/// pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ig_core/view.h"

namespace quadrig::display {

/// The pixels of a drawing that are not fully transparent, as runs along rows: what it costs to lay it over a picture.
struct OverlayLayer {
    struct Run {
        int row = 0, column = 0;           ///< of the first pixel, in the layer's own coordinates, row 0 at the top
        std::size_t first = 0, count = 0;  ///< pixels[first] .. pixels[first + count - 1]
        bool opaque = false;               ///< every alpha is 255
    };
    std::vector<Run> runs;
    std::vector<std::array<std::uint8_t, 4>> pixels;  ///< R, G, B, A; colour not multiplied by alpha
};

/// The non-transparent runs of `width` x `height` pixels of `drawing` whose top left pixel is (row, column).
OverlayLayer overlay_layer(const FrameImage& drawing, int row, int column, int width, int height);

/// Lays a layer over a picture with its top left at (row, column): out = a source + (1 - a) picture on the 8-bit
/// values, exact to 1/2 of 255. Pixels outside the picture are left out. Alpha stays 255. Allocates nothing.
void lay_over(const OverlayLayer& layer, const FrameImage& picture, int row, int column);

/// A centre cross and a frame counter for pictures of one size. Draws with GL while it is made and never again.
class Overlay {
  public:
    /// Leaves the thread without a current GL context. Throws std::runtime_error as Channel does.
    Overlay(int width, int height);
    /// `picture` has the overlay's size. The counter stands at the top left, six digits or as many as the number has;
    /// digits that the picture has no room for are left out. Allocates nothing.
    void lay_over(const FrameImage& picture, std::uint64_t frame_number) const;

  private:
    int margin_, digit_advance_;
    OverlayLayer cross_;
    std::array<OverlayLayer, 10> digits_;
};

}  // namespace quadrig::display
