/// Shading, per instruction set: the texturing function, whole pixels, layers, packing.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ig_core/shading/compositing.h"
#include "ig_core/shading/frame_paint.h"
#include "ig_core/shading/shade.h"
#include "tests/ig_core/randomness.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

constexpr int kColumns = 1280;

Scene textured_scene(int terms, double slowest) {
    Scene scene;
    scene.haze = Haze{20000, {0.6, 0.7, 0.8}};
    Texture texture;
    double w = slowest, c = 1;
    for (int i = 0; i < terms; ++i, w *= 1.9, c *= 0.707) texture.terms.push_back({c, w, 0.7 * i});
    texture.vertical = 0.75;
    scene.textures = {texture};
    Object object;
    object.paint = {{0.3, 0.5, 0.2}, 0u, 0.7, {}};
    scene.objects = {object};
    return scene;
}

void per_item(benchmark::State& state, std::int64_t items) {
    state.counters["ns"] = benchmark::Counter(static_cast<double>(items * state.iterations()) * 1e-9,
                                              benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Points of a surface a few metres apart: no term is filtered.
void texture_points(benchmark::State& state, std::int64_t target, SineMethod sine) {
    const SimdTarget held(target);
    const Scene scene = textured_scene(static_cast<int>(state.range(0)), 0.2);
    FramePaints paints = make_frame_paints(scene);
    Quality quality;
    quality.sine = sine;
    move_textures(scene, {}, 0, quality, paints);
    Randomness random(1);
    std::vector<float> x, y, z, t(kColumns);
    for (std::size_t i = 0; i < t.size(); ++i) {
        const glm::dvec3 p = random.vector(30);
        x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y)),
            z.push_back(static_cast<float>(p.z));
    }
    for (auto _ : state) {
        texture_values(paints.textures[0], x, y, z, t);
        benchmark::DoNotOptimize(t.data());
    }
    per_item(state, kColumns);
}

/// A row of a plane 300 m ahead, in stretches of so many columns: intersection, normal, terms, light, haze.
void plane_pixels(benchmark::State& state, std::int64_t target, bool smooth_stretches, int columns) {
    const SimdTarget held(target);
    const Scene scene = textured_scene(static_cast<int>(state.range(0)), 0.02);
    FramePaints paints = make_frame_paints(scene);
    move_textures(scene, {}, 0, {}, paints);
    const FrameLight light = make_frame_light(scene, {});
    const ShadeRow row{&light, smooth_stretches, false, {1.0F / kColumns, 0, 0}, {0, 0, 1.0F / kColumns}};
    std::vector<ShadeInput> jobs;
    for (int column = 0; column < kColumns; column += columns) {
        ShadeInput& in = jobs.emplace_back();
        in.kind = ShadeInput::Kind::plane;
        in.count = std::min(columns, kColumns - column);
        in.buffer = static_cast<std::uint32_t>(column);
        in.most_column = static_cast<float>(in.count);
        in.ray = {-0.5F + static_cast<float>(column) / kColumns, 1.0F, 0.1F};
        in.normal = {0, -1, 0};
        in.plane_u = 1.0F / 300;
        in.paint = &paints.objects[0], in.row = &row;
    }
    ShadeBuffer buffer;
    buffer.resize(kColumns + kShadePadding);
    for (auto _ : state) {
        shade(jobs, buffer);
        benchmark::DoNotOptimize(buffer.red.data());
    }
    per_item(state, kColumns);
}

void whole_layers(benchmark::State& state, std::int64_t target) {
    const SimdTarget held(target);
    ShadeBuffer buffer, row;
    buffer.resize(4 * kColumns + kShadePadding), row.resize(kColumns + kShadePadding);
    std::fill(buffer.opacity.begin(), buffer.opacity.end(), 0.5F);
    std::vector<CompositeLayer> layers;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(state.range(0)); ++i)
        layers.push_back({i * kColumns, i, nullptr});
    const std::vector<CompositeRun> runs{{0, kColumns, layers}};
    for (auto _ : state) {
        composite_whole(buffer, runs, row);
        benchmark::DoNotOptimize(row.red.data());
    }
    per_item(state, kColumns * state.range(0));
}

void partial_pixels(benchmark::State& state, std::int64_t target) {
    const SimdTarget held(target);
    ShadeBuffer buffer, row;
    buffer.resize(8 + kShadePadding), row.resize(8 + kShadePadding);
    buffer.opacity[0] = buffer.opacity[1] = 1.0F;
    RowSpan left, right;
    left.from.fill(0), left.to.fill(0.4), right.from.fill(0), right.to.fill(5);
    right.inner_to = 5;
    const std::vector<CompositeLayer> layers{{0, 0, &left}, {1, 1, &right}};
    const std::vector<CompositeRun> runs{{0, 1, layers}};
    for (auto _ : state) {
        composite_partial(buffer, runs, 2, row);
        benchmark::DoNotOptimize(row.red.data());
    }
    per_item(state, 1);
}

void packing(benchmark::State& state, std::int64_t target) {
    const SimdTarget held(target);
    ShadeBuffer row;
    row.resize(kColumns + kShadePadding);
    Randomness random(1);
    for (auto* plane : {&row.red, &row.green, &row.blue})
        for (float& value : *plane) value = static_cast<float>(random.between(0, 1));
    std::vector<std::uint8_t> rgba(4 * kColumns);
    for (auto _ : state) {
        pack_srgb8(row, kColumns, rgba.data());
        benchmark::DoNotOptimize(rgba.data());
    }
    per_item(state, kColumns);
}

/// The best instruction set by the kernel's name, the others with theirs.
const bool kRegistered = [] {
    const auto targets = simd_targets();
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const std::int64_t target = targets[i];
        const std::string set = i == 0 ? "" : std::string("/SIMD:") + hwy::TargetName(target);
        const auto add = [&](const std::string& name, auto function, auto... more) {
            return benchmark::RegisterBenchmark((name + set).c_str(),
                                                [=](benchmark::State& state) { function(state, target, more...); });
        };
        add("texture/parabola", texture_points, SineMethod::parabola)->ArgName("terms")->Arg(1)->Arg(3)->Arg(7);
        add("texture/polynomial", texture_points, SineMethod::polynomial)->ArgName("terms")->Arg(7);
        add("texture/table", texture_points, SineMethod::table)->ArgName("terms")->Arg(7);
        add("texture/library", texture_points, SineMethod::library)->ArgName("terms")->Arg(7);
        add("pixel/each", plane_pixels, false, kColumns)->ArgName("terms")->Arg(1)->Arg(3)->Arg(7);
        add("pixel/stretches_of_8", plane_pixels, false, 8)->ArgName("terms")->Arg(1)->Arg(3)->Arg(7);
        add("pixel/smooth_stretches", plane_pixels, true, kColumns)->ArgName("terms")->Arg(3);
        add("layers/whole", whole_layers)->ArgName("layers")->Arg(1)->Arg(3);
        add("layers/partial_pixel", partial_pixels);
        add("pack_srgb8", packing);
    }
    return true;
}();

}  // namespace
