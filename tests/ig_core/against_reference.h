/// Comparison of ids and depth, pixel by pixel, with the reference renderer.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/image_generator.h"
#include "ig_core/reference/reference_renderer.h"

namespace quadrig::test {

struct Agreement {
    long pixels = 0, ties = 0, objects = 0, wrong_identity = 0, wrong_depth = 0;
    double worst_depth = 0;  ///< relative error where identities agree and the pixel is no tie

    Agreement& operator+=(const Agreement& other) {
        pixels += other.pixels, ties += other.ties, objects += other.objects;
        wrong_identity += other.wrong_identity, wrong_depth += other.wrong_depth;
        worst_depth = std::max(worst_depth, other.worst_depth);
        return *this;
    }
};

/// Error of 1/k allowed: relative, and what stays of it towards a horizon, where 1/k goes to 0.
inline constexpr double kDepthTolerance = 1e-9, kHorizonTolerance = 1e-12;

/// Messages of the first wrong pixel wait for the next assertion.
inline Agreement compare_with_reference(ImageGenerator& generator, const View& view) {
    std::vector<std::uint8_t> ties;
    const GroundTruth exact = reference::ground_truth(generator.scene(), view, &ties);
    const GroundTruth fast = generator.ground_truth(view);
    Agreement agreement;
    REQUIRE(fast.object_ids.size() == exact.object_ids.size());
    for (std::size_t i = 0; i < exact.object_ids.size(); ++i) {
        ++agreement.pixels;
        agreement.objects += exact.object_ids[i] >= 0;
        if (ties[i] != 0) {
            ++agreement.ties;
            continue;
        }
        const auto where = [&] {
            const auto width = static_cast<std::size_t>(view.image.width);
            UNSCOPED_INFO("column " << i % width << ", row " << i / width << ": object " << fast.object_ids[i]
                                    << " surface " << fast.surface_ids[i] << " depth " << fast.depth[i]
                                    << ", by the reference " << exact.object_ids[i] << ", " << exact.surface_ids[i]
                                    << ", " << exact.depth[i]);
        };
        if (fast.object_ids[i] != exact.object_ids[i] || fast.surface_ids[i] != exact.surface_ids[i]) {
            if (agreement.wrong_identity++ == 0) where();
            continue;
        }
        if (fast.depth[i] == exact.depth[i]) continue;
        const double error = std::abs(fast.depth[i] - exact.depth[i]) / exact.depth[i];
        if (!(error <= kDepthTolerance + kHorizonTolerance * exact.depth[i]) && agreement.wrong_depth++ == 0) where();
        agreement.worst_depth = std::max(agreement.worst_depth, error);
    }
    return agreement;
}

}  // namespace quadrig::test
