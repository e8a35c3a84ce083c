#include <catch2/catch.hpp>
#include <cmath>

#include "tests/reference/scene_makers.h"

using namespace quadrig;
using namespace quadrig::reference;

namespace {

/// Nothing but black sky and what is painted white, whichever way it faces.
Scene white_on_black(std::initializer_list<Object> objects) {
    Scene scene = scene_of(objects);
    scene.sun.ambient = 1.0;
    scene.sky = {Colour(0.0), Colour(0.0)};
    return scene;
}

double sum_of(const LinearImage& image) {
    double sum = 0.0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) sum += static_cast<double>(image.rgb[i]);
    return sum;
}

double largest_difference(const LinearImage& a, const LinearImage& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        largest = std::max(largest, static_cast<double>(std::abs(a.rgb[i] - b.rgb[i])));
    return largest;
}

}  // namespace

TEST_CASE("a converged picture covers each pixel of a slanting edge by its exact area") {
    // The face Y = 10 to the right of X + 0.3 Z = -0.7: a straight edge in the picture, at x = -0.07 - 0.3 z.
    Object half = solid(GeneralQuadric{{0, 0, 0, 0, 0, 0, 0, 0, 0, -1}}, {{{0, 1, 0, -10}}, {{1, 0, 0.3, 0.7}}});
    const View view = look({0, 0, 0}, {}, 33, 25, 30);
    const ConvergedPicture picture = converged_picture(white_on_black({half}), view, {});
    CHECK(picture.open_pixels < 33 * 25 / 50);
    for (int row = 0; row < 25; ++row) {
        for (int column = 0; column < 33; ++column) {
            // Area by strips of a row, each with an exact width.
            double area = 0.0;
            const int strips = 2000;
            for (int strip = 0; strip < strips; ++strip) {
                const double edge = -0.07 - 0.3 * view.image.z(row + (strip + 0.5) / strips);
                const double edge_column = (edge - view.image.left) / view.image.column_step;
                area += std::clamp(column + 1 - edge_column, 0.0, 1.0) / strips;
            }
            const auto pixel = static_cast<std::size_t>(3 * (row * 33 + column));
            INFO("column " << column << " row " << row);
            REQUIRE(static_cast<double>(picture.image.rgb[pixel]) == Approx(area).margin(3e-4));
        }
    }
}

TEST_CASE("a converged picture gives a sphere the area of its limb") {
    const double distance = 50.0, radius = 7.0;
    const View view = look({0, 0, 0}, {}, 64, 48, 25);
    const ConvergedPicture picture =
        converged_picture(white_on_black({solid(sphere({0, distance, 0}, radius))}), view, {});
    const double limb = radius / std::sqrt(distance * distance - radius * radius) / view.image.column_step;
    CHECK(sum_of(picture.image) == Approx(3.14159265358979 * limb * limb).epsilon(2e-5));
}

TEST_CASE("a converged picture is the limit of supersampling, light, texture and holes included") {
    Scene scene = scene_of({solid(sphere({-1, 20, 0}, 4)), box({1, 15, -2}, {4, 18, 3})});
    scene.textures = {{"waves", {{1.0, 0.8, 0.2}, {0.5, 2.1, 1.0}}, 0.6, {0, 0}}};
    scene.objects[0].paint = {{0.2, 0.8, 0.3}, 0, 0.5, Translucence{0.2, 0.4, 0.2}};
    scene.ground.emplace();
    scene.haze = Haze{500, {0.6, 0.7, 0.8}};
    const View view = look({0, 0, 2}, {{0}, {-3}, {10}}, 40, 30, 50);
    const ConvergedPicture converged = converged_picture(scene, view, {});
    const double coarse = largest_difference(converged.image, picture(scene, view, {}, 16));
    const double fine = largest_difference(converged.image, picture(scene, view, {}, 64));
    CHECK(fine < 3e-3);
    CHECK(fine < 0.5 * coarse);
}

TEST_CASE("pixels whose mean still changes are counted, and looser tolerances cost fewer rays") {
    const Scene scene = white_on_black({solid(sphere({0, 50, 0}, 7))});
    const View view = look({0, 0, 0}, {}, 32, 24, 25);
    const ConvergedPicture strict = converged_picture(scene, view, {}, 0.0, 4);
    CHECK(strict.open_pixels == 32 * 24);
    const ConvergedPicture fine = converged_picture(scene, view, {}, 1e-4),
                           loose = converged_picture(scene, view, {}, 1e-2);
    CHECK(loose.open_pixels == 0);
    CHECK(loose.rays < fine.rays);
    CHECK(largest_difference(loose.image, fine.image) < 2e-2);
}
