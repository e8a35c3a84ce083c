/// The one door of ig_core: a scene goes in once, a view every frame, a picture comes out.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string_view>

#include "ig_core/view.h"

namespace quadrig {

/// Stages of a frame, in order, as they appear in reports.
enum class Stage { select, outline, sweep, shade, present };
inline constexpr std::size_t kStageCount = 5;
inline constexpr std::array<std::string_view, kStageCount> kStageNames{"select", "outline", "sweep", "shade",
                                                                       "present"};
using StageTimes = std::array<std::chrono::nanoseconds, kStageCount>;

/// Draws one scene. Not copyable; one frame at a time. After the first frames it allocates nothing.
class ImageGenerator {
  public:
    /// Prepares a scene for drawing. `threads` >= 1 workers in all, the caller's included.
    explicit ImageGenerator(Scene scene, int threads = 1);
    ~ImageGenerator();
    ImageGenerator(const ImageGenerator&) = delete;
    ImageGenerator& operator=(const ImageGenerator&) = delete;

    /// Draws the picture. `image` must have the view's size. Wall-clock time is split over the stages; sweep and shade
    /// alternate on every row, so their share is the workers' mean.
    StageTimes render(const View& view, const Environment& environment, const Quality& quality,
                      const FrameImage& image);

    /// What is seen at the pixel centres: ids and depth of the geometry, holes ignored (not for the frame loop: it
    /// allocates). Of `quality` counts what decides visibility: set-up, distance rule, smallest feature;
    /// of `environment` what places objects.
    GroundTruth ground_truth(const View& view, Quality quality = {}, const Environment& environment = {});

    [[nodiscard]] const Scene& scene() const;
    /// Name of the instruction set that shading runs on here, e.g. "AVX3_DL".
    [[nodiscard]] static std::string_view simd_target();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrig
