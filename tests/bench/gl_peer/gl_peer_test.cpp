#include "tests/bench/gl_peer/gl_peer.h"

#include <catch2/catch.hpp>
#include <stdexcept>

#include "display/channel.h"
#include "ig_core/reference/error.h"
#include "tests/bench/gl_peer/picture_difference.h"
#include "tests/ig_core/random_objects.h"

using namespace quadrig;
using gl_peer::GlPeer;
using gl_peer::Shading;
using test::Randomness;

namespace {

constexpr int kWidth = 160, kHeight = 120;

View view_from(const glm::dvec3& eye, const Attitude& attitude) {
    return {{eye}, eye_from_scene_rotation(attitude), ImagePlane::symmetric(kWidth, kHeight, {60.0})};
}

Paint random_paint(Randomness& random, bool holes) {
    Paint paint{{random.between(0, 1), random.between(0, 1), random.between(0, 1)}, 0U, random.between(0, 1), {}};
    if (holes) {
        const double threshold = random.between(0.0, 0.2);
        paint.translucence = {threshold, threshold + random.between(0.0, 0.3), random.between(0.2, 0.4)};
    }
    return paint;
}

/// A hazy evening with nothing in it yet. Its texture is coarse enough to be below the sampling frequency on
/// everything within some hundred metres, decks' up to where haze hides them, so that one sample a pixel is all that
/// either renderer can take of it.
Scene evening(Randomness& random) {
    Scene scene;
    scene.sun = {{random.between(0, 360)}, {random.between(5, 60)}, 0.4};
    scene.haze = Haze{random.between(200, 600), {0.6, 0.5, 0.4}};
    scene.textures = {{"coarse", {}, random.between(0.0, 0.8), {}}, {"clouds", {}, 0.0, {}}};
    for (const double w : {0.11, 0.07, 0.19}) {
        scene.textures[0].terms.push_back({random.between(0.2, 1), w, random.between(0, 6.28)});
        scene.textures[1].terms.push_back({random.between(0.2, 1), 0.01 * w, random.between(0, 6.28)});
    }
    return scene;
}

/// PSNR of the peer's picture against exact rays through the pixels' centres.
double psnr_of(GlPeer& peer, const Scene& scene, const View& view) {
    return reference::picture_error(peer.render(view), reference::picture(scene, view, {}, 1)).psnr();
}

}  // namespace

TEST_CASE("The GL peer draws solids of every kind as the exact renderer does") {
    display::Channel suppresses_known_leaks(16, 16);  // what Mesa leaks is said in display/channel.cpp
    const int count = test::trials(6);
    for (int trial = 0; trial < count; ++trial) {
        INFO("QUADRIG_TEST_SEED=" << test::seed() << ", trial " << trial);
        Randomness random(trial);
        Scene scene = evening(random);
        const glm::dvec3 eye(random.between(-3000, 3000), random.between(-3000, 3000), random.between(20, 40));
        for (int kind = 0; kind < test::kKinds; ++kind) {
            const glm::dvec3 centre =
                eye + glm::dvec3(random.between(-20, 20), random.between(25, 70), random.between(-12, 12));
            Object object = test::random_object(random, static_cast<test::Kind>(kind), centre, random.between(3, 9),
                                                true, random.below(4));
            object.paint = random_paint(random, false);
            scene.objects.push_back(object);
        }
        if (random.chance(0.5)) scene.ground = Ground{{{0.3, 0.4, 0.1}, {}, 0.0, {}}};
        const View view =
            view_from(eye, {{random.between(-10, 10)}, {random.between(-10, 10)}, {random.between(-90, 90)}});
        GlPeer peer(scene, kWidth, kHeight, trial % 2 == 0 ? Shading::deferred : Shading::forward);
        CHECK(psnr_of(peer, scene, view) > 48.0);
        // The bound tells pictures apart: half a degree further left is another one.
        View beside = view;
        beside.image.left -= 0.01;
        const auto exact = reference::picture(scene, view, {}, 1);
        CHECK(reference::picture_error(peer.render(beside), exact).psnr() < 37.0);
    }
}

TEST_CASE("The GL peer lays translucent solids and cloud decks over one another as the exact renderer does") {
    display::Channel suppresses_known_leaks(16, 16);
    const int count = test::trials(6);
    for (int trial = 0; trial < count; ++trial) {
        INFO("QUADRIG_TEST_SEED=" << test::seed() << ", trial " << trial);
        Randomness random(1000 + trial);
        Scene scene = evening(random);
        const glm::dvec3 eye(random.between(-300, 300), random.between(-300, 300), 30);
        // One behind the other without touching, so that the order of their centres is that of their surfaces.
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 centre = eye + glm::dvec3(random.between(-8, 8), 25 + 12 * i, random.between(-8, 8));
            const bool holes = i % 4 != 3;
            Object object{"", Ellipsoid{{centre}, {random.between(4, 12), 5.5, random.between(4, 12)}, {}}, {}, {}, {}};
            if (i % 2 == 1) object.planes = {{{0.3, 0.2, -0.9, 0.9 * centre.z - 0.3 * centre.x - 0.2 * centre.y + 2}}};
            object.paint = random_paint(random, holes);
            scene.objects.push_back(object);
        }
        for (const double altitude : {-25.0, 70.0, 90.0}) {
            scene.cloud_decks.push_back({altitude, random_paint(random, true)});
            scene.cloud_decks.back().paint.texture = 1;
        }
        const View view = view_from(eye, {{0}, {random.between(-5, 5)}, {random.between(-10, 10)}});
        GlPeer peer(scene, kWidth, kHeight, trial % 2 == 0 ? Shading::deferred : Shading::forward);
        // Towards limbs and horizon the peer fades its texture out, and single rays do not.
        CHECK(psnr_of(peer, scene, view) > 37.0);
    }
}

TEST_CASE("The GL peer refuses a scene with lights or markings rather than leave them out") {
    display::Channel suppresses_known_leaks(16, 16);
    Scene lit;
    lit.lights.emplace_back();
    CHECK_THROWS_AS(GlPeer(lit, 8, 8), std::runtime_error);
    Scene marked;
    marked.ground_polygons.push_back({{{0, 0}, {1, 0}, {0, 1}}, {}});
    CHECK_THROWS_AS(GlPeer(marked, 8, 8), std::runtime_error);
}

TEST_CASE("PSNR between two pictures is that of linear light") {
    std::uint8_t black[4] = {0, 0, 0, 255}, grey[4] = {188, 188, 188, 255};  // sRGB 188 is linear 0.503
    CHECK(gl_peer::psnr_between({black, 1, 1, 4}, {grey, 1, 1, 4}) == Approx(5.97).margin(0.01));
}
