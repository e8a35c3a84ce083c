#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "ig_core/shading/frame_paint.h"
#include "ig_core/shading/shade.h"
#include "tests/ig_core/randomness.h"
#include "tests/ig_core/simd_targets.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

Scene random_paints(Randomness& random) {
    Scene scene;
    if (random.chance(0.7)) scene.haze = Haze{random.log_between(50, 50000), {0.6, 0.7, 0.8}};
    for (int i = 0; i < 3; ++i) {
        Texture& texture = scene.textures.emplace_back();
        for (int k = 1 + random.below(kMaxTextureTerms); k > 0; --k)
            texture.terms.push_back({random.between(0.1, 1), random.log_between(0.005, 20), random.between(-10, 10)});
        if (random.chance(0.5)) texture.vertical = random.between(0, 1);
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
        Paint& paint = scene.objects.emplace_back().paint;
        paint.colour = {random.between(0, 1), random.between(0, 1), random.between(0, 1)};
        if (random.chance(0.2)) continue;
        paint.texture = static_cast<std::uint32_t>(random.below(3));
        paint.texture_weight = random.between(0, 1);
        if (random.chance(0.4)) paint.translucence = Translucence{0.3, 0.6, 0.05};
    }
    return scene;
}

/// Jobs of a row as they stand in the buffer, and what they refer to: skies, lights, planes and spheres.
struct RowJobs {
    Scene scene;
    FramePaints paints;
    FrameLight light;
    ShadeRow row;
    std::vector<SceneQuadric> spheres;
    std::vector<ShadeInput> jobs;
    std::uint32_t samples = 0;
};

/// Unit sphere times `radius`, its centre straight ahead: Q(p) = |p - centre|^2 - radius^2, along the ray (x, 1, z).
void set_sphere(double distance, double radius, double x, double z, SceneQuadric& sphere, ShadeInput& in) {
    in.kind = ShadeInput::Kind::quadric;
    const double c = distance * distance - radius * radius, b = -distance, a = 1 + z * z;
    in.xi = static_cast<float>(x);
    in.c = static_cast<float>(c);
    in.b = {static_cast<float>(b), 0.0F};
    in.a = {static_cast<float>(a), 0.0F, 1.0F};
    in.limb = {static_cast<float>(b * b - a * c), 0.0F, static_cast<float>(-c)};
    sphere.m = {1, 1, 1, 0, 0, 0};
    sphere.eye_from_anchor = {0, static_cast<float>(-distance), 0};
    sphere.inverse_centre_value = static_cast<float>(1 / (radius * radius));
    in.quadric = &sphere;
}

void make_jobs(Randomness& random, RowJobs& made) {
    made.scene = random_paints(random);
    made.paints = make_frame_paints(made.scene);
    move_textures(made.scene, {random.vector(1000)}, 0, {}, made.paints);
    made.light = make_frame_light(made.scene, {});
    const float step = 1.0F / 1024;
    made.row = {&made.light, random.chance(0.7), random.chance(0.3), {step, 0, 0}, {0, 0, -step}, step};
    made.spheres.resize(40);
    std::size_t paint = 0;
    for (SceneQuadric& sphere : made.spheres) {
        ShadeInput& in = made.jobs.emplace_back();
        in.count = random.chance(0.8) ? 1 + random.below(20) : 1 + random.below(500);
        in.buffer = made.samples;
        made.samples += static_cast<std::uint32_t>(in.count);
        in.most_column = static_cast<float>(in.count) - 0.5F;
        const double x = random.between(-0.1, 0.1), z = random.between(-0.1, 0.1);
        in.ray = {static_cast<float>(x), 1, static_cast<float>(z)};
        in.row = &made.row;
        if (random.chance(0.3)) paint = static_cast<std::size_t>(random.below(8));
        in.paint = &made.paints.objects[paint];
        switch (random.below(8)) {
            case 0:
                in.kind = random.chance(0.5) ? ShadeInput::Kind::sky : ShadeInput::Kind::light;
                in.colour = {0.25F, 0.5F, 0.75F};
                break;
            case 1:
            case 2:
            case 3:
                in.kind = ShadeInput::Kind::plane;
                in.normal = {0, -1, 0};
                in.plane_u = static_cast<float>(1 / random.log_between(1, 3000));
                in.plane_u_step = static_cast<float>(random.between(-1e-6, 1e-6));
                break;
            default: {
                const double distance = random.log_between(2, 3000);
                set_sphere(distance, distance * random.between(0.05, 0.9), x, z, sphere, in);
            }
        }
    }
}

/// Bits of the samples of a job.
std::vector<float> of_job(const ShadeBuffer& buffer, std::uint32_t from, int count) {
    std::vector<float> all;
    for (const auto* plane : {&buffer.red, &buffer.green, &buffer.blue, &buffer.opacity})
        all.insert(all.end(), plane->begin() + from, plane->begin() + from + count);
    return all;
}

}  // namespace

TEST_CASE("surfaces that are shaded together have the bits that each has by itself") {
    CAPTURE(seed());
    for (const std::int64_t target : simd_targets()) {
        const SimdTarget held(target);
        CAPTURE(hwy::TargetName(target));
        for (int trial = 0; trial < trials(60); ++trial) {
            CAPTURE(trial);
            Randomness random(trial);
            RowJobs made;
            make_jobs(random, made);
            ShadeBuffer together, alone;
            together.resize(made.samples + kShadePadding), alone.resize(500 + kShadePadding);
            const std::uint64_t terms = shade(made.jobs, together);
            std::uint64_t terms_alone = 0;
            std::size_t different = 0, no_numbers = 0;
            for (const ShadeInput& job : made.jobs) {
                ShadeInput in = job;
                in.buffer = 0;
                terms_alone += shade({&in, 1}, alone);
                const std::vector<float> own = of_job(alone, 0, in.count);
                no_numbers += static_cast<std::size_t>(
                    std::count_if(own.begin(), own.end(), [](float x) { return !std::isfinite(x); }));
                different += own != of_job(together, job.buffer, job.count);
            }
            CHECK(different == 0);
            CHECK(no_numbers == 0);
            CHECK(terms == terms_alone);
        }
    }
}
