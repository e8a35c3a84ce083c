/// What a frame costs, and how that grows: `bench_cost` prints the tables of ig_core/README.md. One thread unless said
/// otherwise; medians.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "config/camera_path.h"
#include "config/scene_file.h"
#include "ig_core/image_generator.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

struct Measured {
    std::string name;
    double frame = 0;  // ms
    std::array<double, kStageCount> stages{};
    FrameWork work;
};

View view_from(const ScenePoint& eye, const Attitude& attitude, Degrees fov, int width, int height) {
    return {eye, eye_from_scene_rotation(attitude), ImagePlane::symmetric(width, height, fov)};
}

/// The eye moves by a millimetre a frame, so that nothing is kept from one to the next.
Measured measure(std::string name, ImageGenerator& generator, View view, int frames = 9) {
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(view.image.width * view.image.height));
    const FrameImage image{pixels.data(), view.image.width, view.image.height, 4 * std::ptrdiff_t{view.image.width}};
    Measured all{std::move(name), 0, {}, {}};
    std::vector<std::pair<double, StageTimes>> runs;
    for (int i = 0; i < frames + 1; ++i) {  // the first one warms up
        view.eye.metres.x += 1e-3;
        const auto start = Clock::now();
        const StageTimes stages = generator.render(view, {}, {}, image);
        if (i > 0) runs.emplace_back(milliseconds(Clock::now() - start), stages);
    }
    std::sort(runs.begin(), runs.end());
    const auto& [frame, stages] = runs[runs.size() / 2];
    all.frame = frame;
    for (std::size_t i = 0; i < kStageCount; ++i) all.stages[i] = milliseconds(stages[i]);
    all.work = generator.work();
    return all;
}

double stage(const Measured& m, Stage which) { return m.stages[static_cast<std::size_t>(which)]; }

/// What a stage's time is made of: names and numbers of the things it does.
struct Made {
    Stage stage;
    std::vector<const char*> names;
    std::vector<double> (*counts)(const FrameWork&);
};
double number(std::uint64_t count) { return static_cast<double>(count); }
const Made kOutlining{
    Stage::outline, {"outline of an object"}, [](const FrameWork& w) { return std::vector{number(w.outlines)}; }};
const Made kSweeping{
    Stage::sweep, {"span of a row, until it is a run", "pair of spans in doubt"}, [](const FrameWork& w) {
        return std::vector{number(w.spans), number(w.pairs)};
    }};
const Made kShading{
    Stage::shade,
    {"stretch of a surface", "sample", "term of a sample", "pixel that an edge passes through", "pixel"},
    [](const FrameWork& w) {
        return std::vector{number(w.stretches), number(w.samples), number(w.terms), number(w.edge_pixels),
                           number(w.pixels)};
    }};

/// Costs in ns, none negative, with the least squares of errors relative to the frame's time, from all views but one.
std::vector<double> fit(const std::vector<Measured>& views, const Made& made, std::size_t left_out) {
    std::vector<double> costs(made.names.size(), 0.0);
    for (int round = 0; round < 20'000; ++round)
        for (std::size_t k = 0; k < costs.size(); ++k) {
            double over = 0, under = 0;
            for (std::size_t v = 0; v < views.size(); ++v) {
                if (v == left_out) continue;
                const double weight = 1.0 / (views[v].frame * views[v].frame);
                const std::vector<double> n = made.counts(views[v].work);
                double rest = 1e6 * stage(views[v], made.stage);
                for (std::size_t j = 0; j < costs.size(); ++j)
                    if (j != k) rest -= costs[j] * n[j];
                over += weight * n[k] * rest, under += weight * n[k] * n[k];
            }
            costs[k] = under > 0 ? std::max(0.0, over / under) : 0.0;
        }
    return costs;
}

void print_model(const std::vector<Measured>& views) {
    const std::size_t all = views.size();
    std::printf("| | ns |\n|---|---|\n");
    for (const Made* made : {&kOutlining, &kSweeping, &kShading}) {
        const std::vector<double> costs = fit(views, *made, all);
        for (std::size_t k = 0; k < costs.size(); ++k) std::printf("| %s | %.2f |\n", made->names[k], costs[k]);
    }
    std::printf(
        "\n| view | outlines | spans | pairs | stretches | samples, M | terms, M | edge pixels | measured, ms | "
        "predicted | |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (std::size_t v = 0; v < all; ++v) {
        const Measured& m = views[v];
        double predicted = stage(m, Stage::select);
        for (const Made* made : {&kOutlining, &kSweeping, &kShading}) {
            const std::vector<double> others = fit(views, *made, v), n = made->counts(m.work);
            predicted += 1e-6 * std::inner_product(others.begin(), others.end(), n.begin(), 0.0);
        }
        const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
        std::printf("| %s | %llu | %llu | %llu | %llu | %.2f | %.2f | %llu | %.1f | %.1f | %+.0f %% |\n",
                    m.name.c_str(), count(m.work.outlines), count(m.work.spans), count(m.work.pairs),
                    count(m.work.stretches), 1e-6 * number(m.work.samples), 1e-6 * number(m.work.terms),
                    count(m.work.edge_pixels), m.frame, predicted, 100 * (predicted / m.frame - 1));
    }
}

std::vector<Measured> bench_views(int width, int height) {
    const std::filesystem::path folder = std::filesystem::path(QUADRIG_SOURCE_DIR) / "config/scenes/bench";
    std::vector<Measured> views;
    for (const char* scene : {"landscape", "trees", "dense", "wood"}) {
        ImageGenerator generator(config::read_scene(folder / (std::string(scene) + ".toml")), 1);
        for (const char* eye : {"2m", "150m", "1500m"}) {
            const config::Camera camera =
                config::read_camera_path(folder / ("eye_" + std::string(eye) + ".json")).front();
            views.push_back(measure(scene + std::string(" ") + eye + " " + std::to_string(width), generator,
                                    view_from(camera.eye, camera.attitude, camera.horizontal_fov, width, height)));
        }
    }
    return views;
}

/// Textured ellipsoids at random on a square of 4 km a side, the eye at its southern edge.
Scene ellipsoids(int objects, int planes, bool behind) {
    Scene scene;
    scene.textures = {{"bark", {{1, 0.4, 0}, {0.7, 0.9, 1}, {0.5, 1.9, 2}}, 0.3}};
    Randomness random(1);
    for (int i = 0; i < objects; ++i) {
        Object object;
        const glm::dvec3 centre(random.between(-2000, 2000), (behind ? -1 : 1) * random.between(50, 4000),
                                random.between(-40, 10));
        object.shape =
            Ellipsoid{{centre}, {random.between(2, 8), random.between(2, 8), random.between(2, 8)}, random.attitude()};
        for (int j = 0; j < planes; ++j) {
            const glm::dvec3 n = random.direction();
            object.planes.push_back({n.x, n.y, n.z, random.between(1.5, 4) - glm::dot(n, centre)});
        }
        object.paint.texture = 0u, object.paint.texture_weight = 0.6;
        scene.objects.push_back(object);
    }
    return scene;
}

/// Translucent ellipsoids behind one another, each of which fills the picture.
Scene layers(int count) {
    Scene scene = ellipsoids(0, 0, false);
    for (int i = 0; i < count; ++i) {
        Object object;
        object.shape = Ellipsoid{{{0, 1000.0 + 10 * i, 0}}, {4000, 4, 4000}, {}};
        object.paint.texture = 0u, object.paint.texture_weight = 0.6;
        object.paint.translucence = Translucence{0.3, 0.3, 0.1};
        scene.objects.push_back(object);
    }
    return scene;
}

void print_growth(const char* what, const std::vector<std::pair<int, Scene>>& scenes) {
    std::printf(
        "\n| %s | ready, ms | in view | outlines | spans | frame, ms | per object in view, us |\n"
        "|---|---|---|---|---|---|---|\n",
        what);
    const View view = view_from({{0, 0, 0}}, {}, Degrees{60}, 1280, 720);
    for (const auto& [count, scene] : scenes) {
        const auto start = Clock::now();
        ImageGenerator generator(scene, 1);
        const double ready = milliseconds(Clock::now() - start);
        const Measured m = measure("", generator, view, 5);
        std::printf("| %d | %.0f | %llu | %llu | %llu | %.2f | %.2f |\n", count, ready,
                    static_cast<unsigned long long>(m.work.objects), static_cast<unsigned long long>(m.work.outlines),
                    static_cast<unsigned long long>(m.work.spans), m.frame,
                    m.work.objects > 0 ? 1e3 * m.frame / static_cast<double>(m.work.objects) : 0.0);
        std::fflush(stdout);
    }
}

}  // namespace

int main() {
    std::vector<Measured> views = bench_views(640, 480);
    for (Measured& m : bench_views(1920, 1080)) views.push_back(std::move(m));
    print_model(views);

    std::vector<std::pair<int, Scene>> scenes;
    for (int n = 100; n <= 1'000'000; n *= 10) scenes.emplace_back(n, ellipsoids(n, 0, false));
    print_growth("objects", scenes);
    scenes.clear();
    for (int n = 100; n <= 1'000'000; n *= 100) scenes.emplace_back(n, ellipsoids(n, 0, true));
    print_growth("objects behind the eye", scenes);
    scenes.clear();
    for (int planes : {0, 1, 2, 4, 6, 8, 16}) scenes.emplace_back(planes, ellipsoids(3000, planes, false));
    print_growth("planes of 3,000 objects", scenes);
    scenes.clear();
    for (int n : {1, 2, 4, 8, 16}) scenes.emplace_back(n, layers(n));
    print_growth("translucent layers", scenes);
}
