#include "config/scene_file.h"
#include "tests/ig_core/against_reference.h"
#include "tests/ig_core/random_scene.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

struct Shipped {
    const char* file;
    std::vector<std::pair<glm::dvec3, Attitude>> eyes;
};

/// Eyes along the recorded flights, and about the village.
const std::vector<Shipped> kScenes{
    {"takeoff", {{{0, 0, 1.3}, {{326}, {1}, {1}}}, {{-472, -982, 95}, {{200}, {8}, {-12}}}}},
    {"turn", {{{-5222, -5366, 4020}, {{8}, {1.8}, {30}}}, {{249, 1961, 4020}, {{68}, {-12}, {30}}}}},
    {"village", {{{60, -140, 30}, {{-20}, {-8}, {0}}}, {{-120, 40, 4}, {{95}, {2}, {180}}}}},
};

Agreement compare_shipped(int width, int height) {
    Agreement total;
    for (const Shipped& shipped : kScenes) {
        Scene scene = config::read_scene(std::string(QUADRIG_SOURCE_DIR "/config/scenes/") + shipped.file + ".toml");
        CAPTURE(shipped.file);
        REQUIRE(scene.objects.size() >= 60);
        ImageGenerator generator(std::move(scene), 2);
        for (const auto& [eye, attitude] : shipped.eyes) {
            const Agreement agreement = compare_with_reference(generator, look(eye, attitude, width, height, 60));
            CAPTURE(eye.x, eye.y, agreement.ties, agreement.worst_depth);
            CHECK(agreement.wrong_identity == 0);
            CHECK(agreement.wrong_depth == 0);
            CHECK(agreement.objects > agreement.pixels / 100);
            CHECK(agreement.ties < agreement.pixels / 1000);
            total += agreement;
        }
    }
    return total;
}

}  // namespace

TEST_CASE("the scenes that travel along show what the reference shows, at every pixel centre") {
#if defined(__SANITIZE_ADDRESS__)
    compare_shipped(160, 120);
#else
    compare_shipped(640, 480);
#endif
}
