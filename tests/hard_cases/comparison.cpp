#include "tests/hard_cases/comparison.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quadrig::test {
namespace {

std::string seen_text(const GroundTruth& truth, std::size_t pixel) {
    std::ostringstream text;
    text.precision(15);
    text << "object " << truth.object_ids[pixel] << " surface " << truth.surface_ids[pixel] << " depth "
         << truth.depth[pixel];
    return text.str();
}

std::string place_text(std::size_t pixel, int width) {
    const auto columns = static_cast<std::size_t>(width);
    return "column " + std::to_string(pixel % columns) + " row " + std::to_string(pixel / columns);
}

/// Rays along each side of a pixel.
constexpr int kCoarse = 3, kFine = 16;

/// A picture in memory of its own.
struct Pixels {
    Pixels(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(4 * w * h)) {}
    [[nodiscard]] FrameImage image() { return {rgba.data(), width, height, 4 * width}; }
    [[nodiscard]] const std::uint8_t* pixel(int column, int row) const {
        return rgba.data() + 4 * (row * width + column);
    }
    [[nodiscard]] int at(int column, int row, int channel) const { return pixel(column, row)[channel]; }

    int width, height;
    std::vector<std::uint8_t> rgba;
};

Pixels supersampled(const Scene& scene, const View& view, int samples) {
    Pixels pixels(view.image.width, view.image.height);
    reference::to_srgb8(reference::picture(scene, view, {}, samples), pixels.image());
    return pixels;
}

/// The 3 x 3 pixels about one as a picture of their own.
View block_about(const View& view, int column, int row) {
    View block = view;
    block.image.left = view.image.x(column - 1);
    block.image.top = view.image.z(row - 1);
    block.image.width = block.image.height = 3;
    return block;
}

/// How far a colour lies outside the range of those in the 3 x 3 pixels about a place.
int outlier(const std::uint8_t* colour, const Pixels& exact, int column, int row) {
    int steps = 0;
    for (int channel = 0; channel < 3; ++channel) {
        int least = 255, most = 0;
        for (int r = std::max(0, row - 1); r <= std::min(exact.height - 1, row + 1); ++r) {
            for (int c = std::max(0, column - 1); c <= std::min(exact.width - 1, column + 1); ++c) {
                least = std::min(least, exact.at(c, r, channel));
                most = std::max(most, exact.at(c, r, channel));
            }
        }
        steps = std::max({steps, least - colour[channel], colour[channel] - most});
    }
    return steps;
}

std::string colour_text(const std::uint8_t* colour) {
    return std::to_string(colour[0]) + " " + std::to_string(colour[1]) + " " + std::to_string(colour[2]);
}

}  // namespace

VisibilityErrors visibility_errors(const Scene& scene, const View& view, const Quality& quality) {
    std::vector<std::uint8_t> ties;
    const GroundTruth exact = reference::ground_truth(scene, view, &ties);
    const GroundTruth answer = ImageGenerator(scene).ground_truth(view, quality);
    VisibilityErrors errors{reference::visibility_error(answer, exact, ties), {}, {}};
    const auto describe = [&](std::size_t pixel, std::string& text) {
        if (pixel != errors.kNone)
            text = place_text(pixel, view.image.width) + ": " + seen_text(answer, pixel) +
                   ", exact: " + seen_text(exact, pixel);
    };
    describe(errors.first_wrong, errors.first_wrong_text);
    describe(errors.deepest, errors.deepest_text);
    return errors;
}

namespace {
Pixels drawn_picture(const Scene& scene, const View& view) {
    Pixels drawn(view.image.width, view.image.height);
    ImageGenerator(scene).render(view, {}, {.sub_scan_lines = 8}, drawn.image());
    return drawn;
}
}  // namespace

void draw_picture(const Scene& scene, const View& view) { drawn_picture(scene, view); }

PictureErrors picture_errors(const Scene& scene, const View& view) {
    const int width = view.image.width, height = view.image.height;
    const Pixels drawn = drawn_picture(scene, view);
    const Pixels exact = supersampled(scene, view, width * height < 1000 ? kFine : kCoarse);
    PictureErrors errors;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            for (int channel = 0; channel < 3; ++channel)
                errors.mean += std::abs(drawn.at(column, row, channel) - exact.at(column, row, channel));
            if (outlier(drawn.pixel(column, row), exact, column, row) <= errors.outlier) continue;
            // More outlying than any so far, at so few rays a pixel: with many, too?
            const Pixels block = supersampled(scene, block_about(view, column, row), kFine);
            const int steps = outlier(drawn.pixel(column, row), block, 1, 1);
            if (steps <= errors.outlier) continue;
            errors.outlier = steps;
            errors.worst_pixel = place_text(static_cast<std::size_t>(row * width + column), width) + ": " +
                                 colour_text(drawn.pixel(column, row)) + ", exact " + colour_text(block.pixel(1, 1));
        }
    }
    errors.mean /= 3.0 * width * height;
    return errors;
}

}  // namespace quadrig::test
