#include "display/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadrig::display {

namespace {

/// IEC 61966-2-1, 8-bit value to linear light.
const std::array<double, 256>& linear_from_srgb() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i) {
            const double v = static_cast<double>(i) / 255.0;
            t[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        }
        return t;
    }();
    return table;
}

std::uint8_t srgb_from_linear(double v) {
    const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(s, 0.0, 1.0)));
}

/// The length of pixel `i` that lies within begin..end.
double covered(int i, double begin, double end) {
    return std::min(i + 1.0, end) - std::max(static_cast<double>(i), begin);
}

}  // namespace

void scale_down(const FrameImage& from, const FrameImage& to) {
    const auto& linear = linear_from_srgb();
    const double x_scale = static_cast<double>(from.width) / to.width,
                 y_scale = static_cast<double>(from.height) / to.height;
    for (int row = 0; row < to.height; ++row) {
        const double y0 = row * y_scale, y1 = std::min((row + 1) * y_scale, static_cast<double>(from.height));
        for (int column = 0; column < to.width; ++column) {
            const double x0 = column * x_scale, x1 = std::min((column + 1) * x_scale, static_cast<double>(from.width));
            std::array<double, 3> sum{};
            double area = 0.0;
            for (int y = static_cast<int>(y0); y < y1; ++y)
                for (int x = static_cast<int>(x0); x < x1; ++x) {
                    const double a = covered(x, x0, x1) * covered(y, y0, y1);
                    const std::uint8_t* source = pixel(from, y, x);
                    for (std::size_t i = 0; i < 3; ++i) sum[i] += a * linear[source[i]];
                    area += a;
                }
            std::uint8_t* out = pixel(to, row, column);
            for (std::size_t i = 0; i < 3; ++i) out[i] = srgb_from_linear(sum[i] / area);
            out[3] = 255;
        }
    }
}

ContactSheet::ContactSheet(int columns, int rows, int thumbnail_width, int thumbnail_height, int gap)
    : columns_(columns),
      rows_(rows),
      thumbnail_width_(thumbnail_width),
      thumbnail_height_(thumbnail_height),
      gap_(gap),
      page_(columns * (thumbnail_width + gap) + gap, rows * (thumbnail_height + gap) + gap) {
    constexpr std::uint8_t kDark = 24;
    for (std::size_t i = 0; i < page_.pixels.size(); ++i) page_.pixels[i] = i % 4 == 3 ? 255 : kDark;
}

bool ContactSheet::add(const FrameImage& picture) {
    if (count_ >= columns_ * rows_) return false;
    const int top = gap_ + count_ / columns_ * (thumbnail_height_ + gap_);
    const int left = gap_ + count_ % columns_ * (thumbnail_width_ + gap_);
    const FrameImage page = page_.image();
    scale_down(picture, {pixel(page, top, left), thumbnail_width_, thumbnail_height_, page.row_bytes});
    ++count_;
    return true;
}

}  // namespace quadrig::display
