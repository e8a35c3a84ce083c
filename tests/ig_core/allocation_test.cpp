#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>

#include "tests/ig_core/painted_scene.h"
#include "tests/ig_core/rendering.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {
std::atomic<long> allocations{0};
}

// All of this program's memory is counted, whichever thread asks for it.
[[gnu::noinline]] void* operator new(std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    allocations.fetch_add(1, std::memory_order_relaxed);
    return std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

/// Allocations during each flight along the same path of views, until two in a row need none.
std::vector<long> flights(const Scene& scene, int threads, int most, const Quality& quality = {4}) {
    ImageGenerator generator(scene, threads);
    std::vector<View> path;
    for (int i = 0; i < 12; ++i) {
        Randomness random(700'000 + i);
        path.push_back(random_view(random, 160, 120));
    }
    std::vector<std::uint8_t> memory(4 * 160 * 120);
    const FrameImage image{memory.data(), 160, 120, 4 * 160};
    std::vector<long> counts;
    int quiet = 0;
    for (int flight = 0; flight < most && quiet < 2; ++flight) {
        const long before = allocations;
        for (const View& view : path) generator.render(view, {1.0 * flight, Sun{}, 900.0}, quality, image);
        const long after = allocations;
        counts.push_back(after - before);
        quiet = after == before ? quiet + 1 : 0;
    }
    return counts;
}

}  // namespace

TEST_CASE("once its views have been drawn, a frame allocates nothing") {
    Randomness random(3);
    const Scene scene = painted_scene(random, 80);
    const auto counts = flights(scene, 1, 3);
    REQUIRE(counts.size() == 3);
    CHECK(counts[0] > 0);  // or nothing was counted
    CHECK(counts[1] == 0);
    CHECK(counts[2] == 0);
}

TEST_CASE("nor does it on a grid half or twice as fine as the picture") {
    Randomness random(3);
    const Scene scene = painted_scene(random, 15);
    for (const ShadingRate rate : {ShadingRate::eighth, ShadingRate::quarter, ShadingRate::four}) {
        // Rows of a strip pass their memory on to one another: it takes some flights until each has the most.
        const auto counts = flights(scene, 1, 8, {.shading = rate});
        CAPTURE(static_cast<int>(rate), counts);
        CHECK(counts.front() > 0);
        CHECK(counts.back() == 0);
    }
}

TEST_CASE("with several workers too, frames come to allocate nothing") {
    Randomness random(3);
    const Scene scene = painted_scene(random, 80);
    // Which worker draws which rows is chance, so each needs a while to have seen the busiest.
    const auto counts = flights(scene, 3, 40);
    CAPTURE(counts);
    CHECK(counts.front() > 0);
    CHECK(counts.back() == 0);
}
