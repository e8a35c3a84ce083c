#include "frame_scheduler/host_view.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>

using namespace quadrig;
using namespace quadrig::scheduler;

TEST_CASE("An eye mounted on a banked aircraft sits where its offset says and looks where its turn says") {
    // Heading east, no pitch, right wing down by 90 degrees: the body's right is down, its forward east, its up
    // south... and so by hand: forward (1,0,0), right (0,0,-1), up = right x forward = (0,-1,0).
    const ScenePose body{{{100, 200, 300}}, eye_from_scene_rotation({{90.0}, {0.0}, {90.0}})};
    const ImagePlane image = ImagePlane::symmetric(640, 480, {60.0});
    const View plain = host_view(body, std::nullopt, image);
    CHECK(glm::distance(plain.eye.metres, {100, 200, 300}) == 0.0);
    const View view = host_view(body, host::ViewMount{{1.0, 10.0, 2.0}, {{90.0}, {0.0}, {0.0}}}, image);
    CHECK(glm::distance(view.eye.metres, glm::dvec3(100 + 10, 200 - 2, 300 - 1)) < 1e-12);
    // The eye looks to the body's right, which is down; its own up stays the body's.
    CHECK(glm::distance(view.eye_from_scene * glm::dvec3(0, 0, -1), {0, 1, 0}) < 1e-12);
    CHECK(glm::distance(view.eye_from_scene * glm::dvec3(0, -1, 0), {0, 0, 1}) < 1e-12);
    CHECK(view.image.width == 640);
}

TEST_CASE("The host's window replaces the channel's field of view at the channel's size") {
    const ImagePlane channel = ImagePlane::symmetric(800, 600, {60.0});
    CHECK(host_image_plane(std::nullopt, channel).column_step == channel.column_step);
    const ImagePlane plane = host_image_plane(host::ViewWindow{{-45.0}, {45.0}, {30.0}, {-30.0}}, channel);
    CHECK(plane.width == 800);
    CHECK(plane.height == 600);
    CHECK(plane.x(0.0) == Approx(-1.0));
    CHECK(plane.x(800.0) == Approx(1.0));
    CHECK(plane.z(0.0) == Approx(std::tan(30.0 * 3.14159265358979 / 180.0)));
    CHECK(plane.z(600.0) == Approx(-std::tan(30.0 * 3.14159265358979 / 180.0)));
}
