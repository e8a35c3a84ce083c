#include <catch2/catch.hpp>

#include "config/scene_file.h"
#include "ig_core/reference/reference_renderer.h"
#include "tests/ig_core/randomness.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

constexpr int kWidth = 64, kHeight = 16, kFrames = 4;

/// A patch of a picture 1280 pixels and 60 degrees wide, from two rows below the horizon on: what lies far away.
ImagePlane far_patch(int left_column) {
    const double step = std::tan(std::acos(-1.0) / 6.0) / 640.0;
    ImagePlane patch;
    patch.width = kWidth;
    patch.height = kHeight;
    patch.left = left_column * step;
    patch.column_step = patch.row_step = step;
    patch.top = -2.0 * step;
    return patch;
}

}  // namespace

TEST_CASE("far away nothing crawls: on an approach, frames change as supersampled ones do, to 1.5 of 255") {
    const Scene scene = config::read_scene(QUADRIG_SOURCE_DIR "/config/scenes/bench/landscape.toml");
    ImageGenerator generator(scene, 2);
    double sum = 0.0;
    int values = 0;
    for (int place = 0; place < trials(3); ++place) {
        Randomness random(place);
        const double height = random.between(40, 400), left = random.between(-500, 400);
        std::vector<std::uint8_t> before, before_exact;
        for (int frame = 0; frame < kFrames; ++frame) {
            // 60 m/s at 60 Hz, down a slope of 3 degrees towards the landscape.
            const View view{{{0.0, -19.1 * height + frame, height - 0.0524 * frame}},
                            glm::dmat3(1.0),
                            far_patch(static_cast<int>(left))};
            Environment environment;
            environment.seconds = frame / 60.0;
            const Picture seen = render(generator, view, environment);
            Picture exact = seen;
            reference::to_srgb8(reference::picture(scene, view, environment, 4),
                                {exact.rgba.data(), kWidth, kHeight, 4 * kWidth});
            for (std::size_t i = 0; frame > 0 && i < seen.rgba.size(); ++i) {
                const double change = seen.rgba[i] - before[i], exact_change = exact.rgba[i] - before_exact[i];
                sum += (change - exact_change) * (change - exact_change);
                values += i % 4 < 3 ? 1 : 0;
            }
            before = seen.rgba;
            before_exact = exact.rgba;
        }
    }
    const double flicker = std::sqrt(sum / values);
    CAPTURE(seed(), flicker);
    CHECK(flicker < 1.5);
    CHECK(values > 0);
}
