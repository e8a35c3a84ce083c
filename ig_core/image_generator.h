/// The one door of ig_core: a scene goes in once, a view every frame, a picture comes out.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
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

/// What there was to do for a frame: what its time is made of.
struct FrameWork {
    std::uint64_t objects = 0;      ///< in view
    std::uint64_t outlines = 0;     ///< made: of those that something may be seen of
    std::uint64_t spans = 0;        ///< made of them and of all else, the hidden ones that were asked for too
    std::uint64_t pairs = 0;        ///< of spans on a row, in doubt which of them is in front
    std::uint64_t stretches = 0;    ///< of surfaces, shaded at a time
    std::uint64_t samples = 0;      ///< shaded
    std::uint64_t terms = 0;        ///< of textures, that samples of their own were asked for
    std::uint64_t edge_pixels = 0;  ///< that edges pass through
    std::uint64_t pixels = 0;
};

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

    /// What render() did last.
    [[nodiscard]] const FrameWork& work() const;

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
