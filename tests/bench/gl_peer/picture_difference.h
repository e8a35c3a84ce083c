/// How far two finished pictures are from one another.
#pragma once

#include "ig_core/view.h"

namespace quadrig::gl_peer {

/// dB, linear light, peak 1, of two pictures of one size (as reference::PictureError).
double psnr_between(const FrameImage& picture, const FrameImage& other);

}  // namespace quadrig::gl_peer
