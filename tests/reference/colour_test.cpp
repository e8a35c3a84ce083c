#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/reference/surface_colour.h"
#include "tests/reference/scene_makers.h"

using namespace quadrig;
using namespace quadrig::reference;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// A texture so coarse that T is the same everywhere: with phase 0, 1/4.
const Texture kEvenTexture{"even", {{1.0, 1e-12, 0.0}}, 0.0, {0.0, 0.0}};

Paint plain(Colour colour) { return {colour, {}, 0.0, {}}; }

Scene dusk() {
    Scene scene;
    scene.sun = {{0}, {30}, 0.2};
    scene.sky = {{0.6, 0.7, 0.8}, {0.1, 0.2, 0.5}};
    scene.textures = {kEvenTexture};
    return scene;
}

Colour middle_of(const Scene& scene, const View& view, const Environment& environment = {}) {
    const LinearImage image = picture(scene, view, environment, 1);
    const float* p = &image.rgb[3 * static_cast<std::size_t>(image.height / 2 * image.width + image.width / 2)];
    return {p[0], p[1], p[2]};
}

void check_same(const Colour& a, const Colour& b) {
    for (int c = 0; c < 3; ++c) CHECK(a[c] == Approx(b[c]).epsilon(1e-6));
}

}  // namespace

TEST_CASE("the texturing function has the mean of its Bessel expansion, near 1/4") {
    // Of the cross terms only those of order +-2 in both sines have a mean: J2(pi/2)^2 (1 - cos 4p) / 2 a term.
    const double coefficients = 1.0 + 0.6;
    const Texture texture{"two terms", {{1.0, 0.8, 0.5}, {0.6, 0.8 * 7, 2.1}}, 0.0, {0.0, 0.0}};
    const double j2 = std::cyl_bessel_j(2.0, kPi / 2);
    const auto correlation = [&](double c, double p) { return c * c * j2 * j2 * (1 - std::cos(4 * p)) / 2; };
    const double expected =
        0.25 * (1 + (correlation(1.0, 0.5) + correlation(0.6, 2.1)) / (coefficients * coefficients));

    const int samples = 200;
    const double period = 4 * kPi / 0.8;
    double sum = 0.0, lowest = 1.0, highest = 0.0;
    for (int i = 0; i < samples; ++i) {
        for (int j = 0; j < samples; ++j) {
            const double t = texturing_function(texture, {{i * period / samples, j * period / samples, 17.0}}, 0.0);
            sum += t;
            lowest = std::min(lowest, t);
            highest = std::max(highest, t);
        }
    }
    CHECK(sum / (samples * samples) == Approx(expected).epsilon(1e-9));
    CHECK(lowest >= 0.0);
    CHECK(highest <= 1.0);
    CHECK(highest > 0.8);
}

TEST_CASE("phase, vertical variation and drift enter the texturing function as Eq 15 has them") {
    const auto t = [](double phase, double u, glm::dvec2 drift, glm::dvec3 p, double seconds) {
        return texturing_function({"one term", {{3.0, 1.0, phase}}, u, drift}, {p}, seconds);
    };
    CHECK(t(0, 0, {0, 0}, {0, 0, 0}, 0) == Approx(0.25));
    CHECK(t(kPi / 2, 0, {0, 0}, {0, 0, 0}, 0) == Approx(1.0));  // both phase shifts are pi/2
    CHECK(t(-kPi / 2, 0, {0, 0}, {0, 0, 0}, 0) == Approx(0.0).margin(1e-15));
    CHECK(t(0, 0.5, {0, 0}, {0, 0, kPi}, 0) == Approx(0.5));                   // PX = pi/2, PY = 0
    CHECK(t(0, 0.5, {0, 0}, {0, 0, 0}, 0) == Approx(0.5));                     // PX = 0, PY = pi/2
    CHECK(t(0, 0, {kPi / 4, 0}, {0, 0, 0}, 2) == Approx(0.5));                 // east sine at 1
    CHECK(t(0, 0, {0, -kPi / 4}, {0, 0, 0}, 2) == Approx(0.0).margin(1e-15));  // north sine at -1
    CHECK(t(0, 0, {0, 0}, {kPi, 0, 0}, 0) == Approx(0.5));                     // PY = pi/2, sin pi = 0
    CHECK(t(0, 0, {0, 0}, {0, kPi, 0}, 0) == Approx(0.5));
    CHECK(t(0, 0, {0, 0}, {kPi / 2, 0, 0}, 0) == Approx(0.5 * (std::sin(kPi / 2 * std::sqrt(0.5)) + 1)));
}

TEST_CASE("a face is lit by the cosine to the sun and never below the ambient share") {
    Scene scene = dusk();
    scene.objects = {box({-50, 10, -50}, {50, 20, 50})};
    scene.objects[0].paint = plain({1.0, 0.5, 0.25});
    const View north = look_north({0, 0, 0}), south = look({0, 40, 0}, {{180}, {0}, {0}});
    check_same(middle_of(scene, north), 0.2 * Colour(1.0, 0.5, 0.25));
    check_same(middle_of(scene, south), (0.2 + 0.8 * std::cos(kPi / 6)) * Colour(1.0, 0.5, 0.25));
    Environment evening;
    evening.sun = Sun{{225}, {0}, 0.1};
    check_same(middle_of(scene, north, evening), (0.1 + 0.9 * std::sqrt(0.5)) * Colour(1.0, 0.5, 0.25));
}

TEST_CASE("a sphere is lit by its outward normal") {
    Scene scene = dusk();
    scene.objects = {solid(sphere({0, 0, 0}, 2))};
    const View from_above = look({0, 0, 30}, {{0}, {-90}, {0}}), from_below = look({0, 0, -30}, {{0}, {90}, {0}});
    check_same(middle_of(scene, from_above), Colour(0.2 + 0.8 * 0.5));
    check_same(middle_of(scene, from_below), Colour(0.2));
}

TEST_CASE("the ground and cloud decks are lit from above whichever side is seen") {
    Scene scene = dusk();
    scene.ground = Ground{plain({0.5, 0.5, 0.5})};
    const Colour lit = (0.2 + 0.8 * 0.5) * Colour(0.5);
    check_same(middle_of(scene, look({0, 0, 5}, {{0}, {-90}, {0}})), lit);
    check_same(middle_of(scene, look({0, 0, -5}, {{0}, {90}, {0}})), lit);
    scene.ground.reset();
    scene.cloud_decks = {{100.0, plain({0.5, 0.5, 0.5})}};
    check_same(middle_of(scene, look({0, 0, 150}, {{0}, {-90}, {0}})), lit);
    check_same(middle_of(scene, look({0, 0, 5}, {{0}, {90}, {0}})), lit);
}

TEST_CASE("the sky goes from horizon to zenith with the sine of elevation and stays at the horizon's colour below") {
    const Scene scene = dusk();
    check_same(middle_of(scene, look({0, 0, 5}, {{33}, {90}, {0}})), scene.sky.zenith);
    check_same(middle_of(scene, look({0, 0, 5}, {{33}, {30}, {70}})), 0.5 * (scene.sky.horizon + scene.sky.zenith));
    check_same(middle_of(scene, look({0, 0, 5}, {{33}, {-40}, {0}})), scene.sky.horizon);
}

TEST_CASE("haze takes 95 percent of a layer's colour at the visibility, by slant range, and none of the sky's") {
    Scene scene = dusk();
    scene.haze = Haze{500, {0.9, 0.8, 0.7}};
    scene.objects = {box({-5000, 500, -5000}, {5000, 600, 5000})};
    const double clearness = std::exp(-2.996);
    CHECK(clearness == Approx(0.05).epsilon(1e-3));
    check_same(middle_of(scene, look_north({0, 0, 0})), clearness * Colour(0.2) + (1 - clearness) * scene.haze->colour);
    const View aside = look({0, 250, 0}, {{60}, {0}, {0}});  // slant range 500 again
    check_same(middle_of(scene, aside), clearness * Colour(0.2) + (1 - clearness) * scene.haze->colour);
    check_same(middle_of(scene, look({0, 0, 0}, {{180}, {30}, {0}})), 0.5 * (scene.sky.horizon + scene.sky.zenith));

    Environment clearer;
    clearer.visibility = 1000;
    const double less = std::exp(-2.996 / 2);
    check_same(middle_of(scene, look_north({0, 0, 0}), clearer), less * Colour(0.2) + (1 - less) * scene.haze->colour);
    scene.haze.reset();
    check_same(middle_of(scene, look_north({0, 0, 0})), Colour(0.2));
    check_same(middle_of(scene, look_north({0, 0, 0}), clearer), less * Colour(0.2) + (1 - less) * scene.sky.horizon);
}

TEST_CASE("translucent layers compose front to back, each with its own haze") {
    // From below: a half open ball (T = tau), a quarter open deck, an opaque ceiling. All see T = 1/4.
    Scene scene = dusk();
    scene.haze = Haze{300, {0.9, 0.8, 0.7}};
    scene.objects = {box({-50, -50, 200}, {50, 50, 210}), solid(sphere({0, 0, 20}, 5))};
    scene.objects[0].paint = plain({0.3, 0.1, 0.2});
    scene.objects[1].paint = {{0.2, 0.9, 0.4}, 0u, 0.5, Translucence{0.25, 0.6, 0.4}};
    scene.cloud_decks = {{100.0, {{1.0, 1.0, 1.0}, 0u, 0.25, Translucence{0.2, 0.9, 0.2}}}};
    const auto hazed = [&](Colour colour, double range) {
        const double e = std::exp(-2.996 * range / 300);
        return e * colour + (1 - e) * scene.haze->colour;
    };
    const Colour ball = hazed((0.5 * 0.2 + 0.5 * 0.25) * Colour(0.2, 0.9, 0.4), 15);
    const Colour deck = hazed(Colour(0.75 * 0.6 + 0.25 * 0.25), 100);
    const Colour ceiling = hazed(0.2 * Colour(0.3, 0.1, 0.2), 200);
    check_same(middle_of(scene, look({0, 0, 0}, {{0}, {90}, {0}})), 0.5 * ball + 0.5 * (0.75 * deck + 0.25 * ceiling));
}

TEST_CASE("the limb function opens a translucent ball towards its limb and leaves plane faces alone") {
    Scene scene = dusk();
    scene.sun.ambient = 1.0;
    scene.objects = {solid(sphere({0, 0, 0}, 5), {{{0, 0, -1, 3}}})};
    scene.objects[0].paint = {{1.0, 1.0, 1.0}, 0u, 0.0, Translucence{0.25, 0.45, 0.8}};
    const auto opacity = [&](glm::dvec3 eye, Attitude attitude) {
        const double behind = eye.z < 0 ? scene.sky.zenith.r : scene.sky.horizon.r;
        return (middle_of(scene, look(eye, attitude)).r - behind) / (1.0 - behind);
    };
    for (const double aside : {0.0, 1.0, 3.0, 4.5}) {
        const double g = 1 - aside * aside / 25;
        CHECK(opacity({aside, 0, -40}, {{0}, {90}, {0}}) ==
              Approx((0.25 - (0.25 + 0.2 * (1 - g))) / 0.8 + 0.5).epsilon(1e-5));
        if (aside < 4) CHECK(opacity({aside, 0, 40}, {{0}, {-90}, {0}}) == Approx(0.5).epsilon(1e-5));
    }
}

TEST_CASE("the limb function of ten coefficients does not depend on their scale, and is 1 without a centre") {
    Scene scene = dusk();
    scene.sun.ambient = 1.0;
    const Translucence holes{0.25, 0.45, 0.8};
    const auto red_through = [&](const Shape& shape, glm::dvec3 eye) {
        scene.objects = {solid(shape)};
        scene.objects[0].paint = {{1.0, 1.0, 1.0}, 0u, 0.0, holes};
        return middle_of(scene, look(eye, {{0}, {90}, {0}})).r;
    };
    const double zenith = scene.sky.zenith.r, g = 1 - 9.0 / 25;
    const double opacity = 0.5 - 0.2 * (1 - g) / 0.8;
    for (const double scale : {1e-12, 1.0, 1e12}) {
        const Shape ball = GeneralQuadric{{scale, scale, scale, 0, 0, 0, -20 * scale, 0, 0, 75 * scale}};
        CHECK(red_through(ball, {13, 0, -40}) == Approx(opacity + (1 - opacity) * zenith).epsilon(1e-6));
    }
    const Shape paraboloid = GeneralQuadric{{1, 1, 0, 0, 0, 0, 0, 0, -1, 0}};
    const Shape cone_upwards = GeneralQuadric{{1, 1, -1, 0, 0, 0, 0, 0, 0, 0}};
    CHECK(red_through(paraboloid, {3, 0, -40}) == Approx(0.5 + 0.5 * zenith).epsilon(1e-6));
    scene.objects = {solid(cone_upwards, {{{0, 0, 1, 0}}})};
    scene.objects[0].paint = {{1.0, 1.0, 1.0}, 0u, 0.0, holes};
    CHECK(middle_of(scene, look_north({3, -40, 10})).r == Approx(0.5 + 0.5 * scene.sky.horizon.r).epsilon(1e-6));
}

TEST_CASE("tilted cylinders and paraboloids have no more of a centre than upright ones: the limb function is 1") {
    Scene scene = dusk();
    scene.sun.ambient = 1.0;
    scene.sky.zenith = scene.sky.horizon;
    const auto check_half_open = [&](const Shape& shape, glm::dvec3 eye) {
        scene.objects = {solid(shape)};
        scene.objects[0].paint = {{1.0, 1.0, 1.0}, 0u, 0.0, Translucence{0.25, 0.45, 0.8}};
        CHECK(middle_of(scene, look_north(eye)).r == Approx(0.5 + 0.5 * scene.sky.horizon.r).epsilon(1e-6));
    };
    for (const Attitude& tilt : {Attitude{{90}, {0}, {0}}, Attitude{{30}, {20}, {10}}, Attitude{{77}, {-40}, {123}}}) {
        INFO("heading " << tilt.heading.value);
        const glm::dvec3 u =
            glm::transpose(eye_from_scene_rotation(tilt))[1];  // the axis; M = 1 - u u' but for rounding
        const auto about_axis = [&](double linear, double constant) {
            return GeneralQuadric{{1 - u.x * u.x, 1 - u.y * u.y, 1 - u.z * u.z, -2 * u.x * u.y, -2 * u.y * u.z,
                                   -2 * u.x * u.z, linear * u.x, linear * u.y, linear * u.z, constant}};
        };
        check_half_open(about_axis(0, -25), {1, -40, 2});
        check_half_open(about_axis(-1, 0), glm::dvec3(1, -40, 2) + 9.0 * u);
    }
}

TEST_CASE("a hill's limb function is 1 where the ray has no lowest point of Q, and falls to 0 on the limb") {
    // A level ray at a distance s beside the axis, b below the centre: min Q = 1 + s^2/a^2 - b^2/c^2, |Q(centre)| = 1.
    const double r = 40, m = 0.5, c = r * m * m, a = r * m, b = 1.3 * c;
    Scene scene = dusk();
    scene.sun.ambient = 1.0;
    scene.objects = {solid(Hill{{{0, 0, 100}}, r, m})};
    scene.objects[0].paint = {{1.0, 1.0, 1.0}, 0u, 0.0, Translucence{0.25, 0.45, 0.8}};
    const auto opacity = [&](const View& view) {
        return (middle_of(scene, view).r - scene.sky.horizon.r) / (1.0 - scene.sky.horizon.r);
    };
    for (const double aside : {0.0, 0.3 * a, 0.7 * a}) {
        const double g = b * b / (c * c) - 1 - aside * aside / (a * a);
        CHECK(opacity(look_north({aside, -300, 100 + c - b})) == Approx(0.5 - 0.2 * (1 - g) / 0.8).epsilon(1e-4));
    }
    CHECK(opacity(look({5, 0, 300}, {{0}, {-90}, {0}})) == Approx(0.5).epsilon(1e-5));
}

TEST_CASE("the picture is the mean of a regular grid in linear light") {
    Scene scene = dusk();
    scene.sun.ambient = 1.0;
    scene.objects = {box({-80, 10, -80}, {2.5, 20, 80})};  // its east edge is a quarter into the third of four columns
    scene.objects[0].paint = plain({1.0, 0.0, 0.5});
    scene.sky = {{0.2, 0.2, 0.2}, {0.2, 0.2, 0.2}};
    const View view{{{0, 0, 0}}, glm::dmat3(1.0), {4, 4, -2.0, 1.0, 2.0, 1.0}};
    const LinearImage image = picture(scene, view, {}, 4);
    CHECK(image.rgb[3 * 1] == 1.0F);
    CHECK(image.rgb[3 * 2] == Approx(0.25 * 1.0 + 0.75 * 0.2));
    CHECK(image.rgb[3 * 2 + 1] == Approx(0.75 * 0.2));
    CHECK(image.rgb[3 * 3] == Approx(0.2));
}

TEST_CASE("drift moves the texture with scene time") {
    Scene scene = dusk();
    scene.sun.ambient = 1.0;
    scene.textures[0].terms[0].frequency = 1.0;
    scene.textures[0].drift = {kPi / 2, 0};
    scene.ground = Ground{{{1.0, 1.0, 1.0}, 0u, 1.0, {}}};
    const View down = look({0, 0, 5}, {{0}, {-90}, {0}});
    check_same(middle_of(scene, down), Colour(0.25));
    Environment later;
    later.seconds = 1;
    check_same(middle_of(scene, down, later), Colour(0.5));
}

TEST_CASE("sRGB codes come back from the linear light they stand for, and out-of-range light is clamped") {
    LinearImage linear{16, 17, std::vector<float>(3 * 16 * 17)};
    for (int code = 0; code < 256; ++code) {
        const double s = code / 255.0;
        const double light = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        for (std::size_t c = 0; c < 3; ++c)
            linear.rgb[3 * static_cast<std::size_t>(code) + c] = static_cast<float>(light);
    }
    linear.rgb[3 * 256] = -0.5F;
    linear.rgb[3 * 256 + 1] = 7.0F;
    linear.rgb[3 * 256 + 2] = 0.18F;
    std::vector<std::uint8_t> bytes(4 * 16 * 17);
    const FrameImage bottom_up{bytes.data() + 4 * 16 * 16, 16, 17, -4 * 16};
    to_srgb8(linear, bottom_up);
    for (int code = 0; code < 256; ++code) {
        const std::uint8_t* pixel = bottom_up.row(code / 16) + 4 * (code % 16);
        for (int c = 0; c < 3; ++c) CHECK(pixel[c] == code);
        CHECK(pixel[3] == 255);
    }
    CHECK(bottom_up.row(16)[0] == 0);
    CHECK(bottom_up.row(16)[1] == 255);
    CHECK(bottom_up.row(16)[2] == 118);
}
