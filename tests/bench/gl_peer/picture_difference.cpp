#include "tests/bench/gl_peer/picture_difference.h"

#include <cmath>

#include "ig_core/reference/error.h"

namespace quadrig::gl_peer {

double psnr_between(const FrameImage& picture, const FrameImage& other) {
    reference::LinearImage linear{other.width, other.height, {}};
    linear.rgb.reserve(3 * static_cast<std::size_t>(other.width) * static_cast<std::size_t>(other.height));
    for (int row = 0; row < other.height; ++row)
        for (int column = 0; column < other.width; ++column)
            for (int channel = 0; channel < 3; ++channel) {
                const float code = static_cast<float>(other.row(row)[4 * column + channel]) / 255.0F;
                linear.rgb.push_back(code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F));
            }
    return reference::picture_error(picture, linear).psnr();
}

}  // namespace quadrig::gl_peer
