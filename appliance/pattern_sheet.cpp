#include "appliance/pattern_sheet.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "display/contact_sheet.h"
#include "ig_core/image_generator.h"

namespace quadrig::appliance {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr std::array<double, 3> kDistances{2.5, 6.0, 15.0};

double longest_wave(const Texture& texture) {
    double lowest = texture.terms.front().frequency;
    for (const TextureTerm& term : texture.terms) lowest = std::min(lowest, term.frequency);
    return 2.0 * std::numbers::pi / lowest;
}

/// Lengths in waves: the eye stands `away` south of the middle and as high as makes it look down by 15 degrees.
struct Stage {
    Scene scene;
    double wave;

    explicit Stage(const Texture& texture) : wave(longest_wave(texture)) {
        scene.sun = {{225.0}, {35.0}, 0.4};
        scene.textures = {texture};
    }
    [[nodiscard]] Paint paint() const { return {Colour(0.75), 0U, 0.75, std::nullopt}; }

    void shoot(double away, double seconds, display::ContactSheet& sheet) {
        const double distance = away * wave;
        const View view{{{0.0, -distance, 0.27 * distance}},
                        eye_from_scene_rotation({{0.0}, {-15.0}, {0.0}}),
                        ImagePlane::symmetric(2 * kWidth, 2 * kHeight, {50.0})};
        display::Picture picture(view.image.width, view.image.height);
        Environment environment;
        environment.seconds = seconds;
        ImageGenerator(scene).render(view, environment, {}, picture.image());
        sheet.add(picture.image());
    }
};

}  // namespace

display::Picture pattern_sheet(std::span<const Texture> patterns, double seconds) {
    display::ContactSheet sheet(9, static_cast<int>(patterns.size()), kWidth, kHeight);
    for (const Texture& pattern : patterns) {
        Stage plane(pattern), hill(pattern), ball(pattern);
        plane.scene.ground = Ground{plane.paint()};
        const double wave = plane.wave;
        hill.scene.objects = {
            {"hill", Hill{{{0.0, 0.0, 0.55 * wave}}, 0.9 * wave, 0.7}, {{{0, 0, 1, 0}}}, hill.paint()}};
        Object egg{"ball", Ellipsoid{{}, {0.8 * wave, 0.8 * wave, 0.6 * wave}, {}}, {}, ball.paint()};
        // What varies upwards is foliage, cloud or smoke, rock or snow: holes show its outline.
        if (pattern.vertical > 0.5) egg.paint.translucence = Translucence{0.08, 0.45, 0.1};
        ball.scene.objects = {egg};
        for (Stage* stage : {&plane, &hill, &ball})
            for (const double away : kDistances) stage->shoot(away, seconds, sheet);
    }
    display::Picture page(sheet.image().width, sheet.image().height);
    display::copy_pixels(sheet.image(), page.image());
    return page;
}

}  // namespace quadrig::appliance
