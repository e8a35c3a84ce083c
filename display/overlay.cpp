#include "display/overlay.h"

#include <GL/gl.h>
#include <GL/osmesa.h>

#include <algorithm>
#include <cstring>

#include "display/channel.h"
#include "display/picture.h"

namespace quadrig::display {

namespace {

struct Ink {
    float value, alpha;
};
constexpr Ink kNothing{0.0F, 0.0F}, kPlate{0.0F, 0.5F}, kDark{0.0F, 1.0F}, kBright{1.0F, 1.0F};

/// A filled rectangle, `top` counted from the upper edge. A scissored clear covers exactly the pixels asked for.
void fill(int canvas_height, int left, int top, int width, int height, Ink ink) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(left, canvas_height - top - height, width, height);
    glClearColor(ink.value, ink.value, ink.value, ink.alpha);
    glClear(GL_COLOR_BUFFER_BIT);
}

/// Segments of the seven-segment digits, bit 0 the top one, then clockwise, bit 6 the middle one.
constexpr std::array<unsigned, 10> kSegments{0x3F, 0x06, 0x5B, 0x4F, 0x66, 0x6D, 0x7D, 0x07, 0x7F, 0x6F};

/// Digit cells are 8 x 12 units, a unit grows with the picture.
constexpr int kCellWidth = 8, kCellHeight = 12;

void draw_digit(int canvas_height, int left, int top, int unit, unsigned segments) {
    fill(canvas_height, left, top, kCellWidth * unit, kCellHeight * unit, kPlate);
    constexpr std::array<std::array<int, 4>, 7> kBars{
        {{2, 1, 4, 1}, {6, 1, 1, 5}, {6, 6, 1, 5}, {2, 10, 4, 1}, {1, 6, 1, 5}, {1, 1, 1, 5}, {2, 5, 4, 1}}};
    for (std::size_t s = 0; s < kBars.size(); ++s)
        if (segments & (1U << s))
            fill(canvas_height, left + kBars[s][0] * unit, top + kBars[s][1] * unit, kBars[s][2] * unit,
                 kBars[s][3] * unit, kBright);
}

/// Two bright bars with a dark rim, two units thick at an even picture size so that they are truly in the middle.
void draw_cross(int width, int height, int unit) {
    const int arm = std::max(2, std::min(width, height) / 24);
    for (const auto& [rim, ink] : {std::pair{unit, kDark}, std::pair{0, kBright}}) {
        const int thick_x = (width % 2 == 0 ? 2 : 1) * unit, thick_y = (height % 2 == 0 ? 2 : 1) * unit;
        const int long_x = 2 * arm + thick_x, long_y = 2 * arm + thick_y;
        fill(height, (width - long_x) / 2 - rim, (height - thick_y) / 2 - rim, long_x + 2 * rim, thick_y + 2 * rim,
             ink);
        fill(height, (width - thick_x) / 2 - rim, (height - long_y) / 2 - rim, thick_x + 2 * rim, long_y + 2 * rim,
             ink);
    }
}

std::uint8_t blend(std::uint8_t source, std::uint8_t picture, int alpha) {
    return static_cast<std::uint8_t>((source * alpha + picture * (255 - alpha) + 127) / 255);
}

}  // namespace

OverlayLayer overlay_layer(const FrameImage& drawing, int row, int column, int width, int height) {
    OverlayLayer layer;
    for (int r = 0; r < height; ++r) {
        bool in_run = false;
        for (int c = 0; c < width; ++c) {
            const std::uint8_t* p = pixel(drawing, row + r, column + c);
            if (p[3] == 0) {
                in_run = false;
                continue;
            }
            const bool opaque = p[3] == 255;
            if (!in_run || layer.runs.back().opaque != opaque)
                layer.runs.push_back({r, c, layer.pixels.size(), 0, opaque});
            in_run = true;
            ++layer.runs.back().count;
            layer.pixels.push_back({p[0], p[1], p[2], p[3]});
        }
    }
    return layer;
}

void lay_over(const OverlayLayer& layer, const FrameImage& picture, int row, int column) {
    for (const OverlayLayer::Run& run : layer.runs) {
        const int r = row + run.row;
        const int begin = std::max(0, column + run.column);
        const int end = std::min(picture.width, column + run.column + static_cast<int>(run.count));
        if (r < 0 || r >= picture.height || begin >= end) continue;
        const auto* source = layer.pixels.data() + run.first + static_cast<std::size_t>(begin - column - run.column);
        std::uint8_t* out = pixel(picture, r, begin);
        if (run.opaque) {
            std::memcpy(out, source, 4 * static_cast<std::size_t>(end - begin));
            continue;
        }
        for (int c = begin; c < end; ++c, ++source, out += 4)
            for (std::size_t i = 0; i < 3; ++i) out[i] = blend((*source)[i], out[i], (*source)[3]);
    }
}

Overlay::Overlay(int width, int height) {
    Channel channel(width, height);
    const int unit = std::max(1, height / 360);
    const FrameImage drawing = channel.image();
    fill(height, 0, 0, width, height, kNothing);
    draw_cross(width, height, unit);
    glFinish();
    cross_ = overlay_layer(drawing, 0, 0, width, height);

    digit_advance_ = kCellWidth * unit;
    margin_ = 2 * digit_advance_;
    Channel strip(10 * digit_advance_, kCellHeight * unit);
    for (int digit = 0; digit < 10; ++digit)
        draw_digit(kCellHeight * unit, digit * digit_advance_, 0, unit, kSegments[static_cast<std::size_t>(digit)]);
    glFinish();
    for (int digit = 0; digit < 10; ++digit)
        digits_[static_cast<std::size_t>(digit)] =
            overlay_layer(strip.image(), 0, digit * digit_advance_, digit_advance_, kCellHeight * unit);
}

void Overlay::lay_over(const FrameImage& picture, std::uint64_t frame_number) const {
    display::lay_over(cross_, picture, 0, 0);
    std::array<std::uint8_t, 20> digits{};
    std::size_t count = 0;
    do {
        digits[count++] = static_cast<std::uint8_t>(frame_number % 10);
        frame_number /= 10;
    } while (frame_number > 0);
    count = std::max<std::size_t>(count, 6);
    int column = margin_;
    while (count > 0 && column + digit_advance_ <= picture.width) {
        display::lay_over(digits_[digits[--count]], picture, margin_, column);
        column += digit_advance_;
    }
}

}  // namespace quadrig::display
