/// The picture of a run: the image generator draws into the video channel's frame buffer, the overlay goes on top.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "appliance/run_options.h"
#include "display/channel.h"
#include "display/frame_writer.h"
#include "display/overlay.h"
#include "frame_scheduler/budget_control.h"
#include "ig_core/image_generator.h"

namespace quadrig::appliance {

class Painter {
  public:
    Painter(Scene scene, const PictureSettings& settings);

    /// Leaves a whole picture in image(). Allocates nothing after the first frames. The stage `present` is the overlay.
    /// A test pattern comes in the scene's place.
    struct Extras {
        bool test_pattern = false;
        std::optional<bool> overlay;           ///< absent: as the settings say
        std::optional<std::size_t> step = {};  ///< of the ladder; absent: step()
    };
    StageTimes paint(const View& view, const Environment& environment, std::uint64_t frame_number) {
        return paint(view, environment, frame_number, {});
    }
    StageTimes paint(const View& view, const Environment& environment, std::uint64_t frame_number,
                     const Extras& extras);
    /// The step of the quality ladder that the next picture is due with.
    [[nodiscard]] std::size_t step() const { return budget_ ? budget_->step() : settings_.step; }
    /// Pictures painted with each step of the quality ladder.
    [[nodiscard]] const std::vector<std::uint64_t>& frames_at_step() const { return frames_at_step_; }
    /// Draws a view as often as it takes for memory to be there.
    void warm_up(const View& view);

    [[nodiscard]] FrameImage image() const { return channel_.image(); }
    [[nodiscard]] const Scene& scene() const { return generator_.scene(); }
    [[nodiscard]] const PictureSettings& settings() const { return settings_; }
    /// The channel's own window, by its size and field of view.
    [[nodiscard]] ImagePlane image_plane() const;
    [[nodiscard]] display::VideoFormat video_format() const;

  private:
    StageTimes draw(const View& view, const Environment& environment, std::uint64_t frame_number, std::size_t step,
                    const Extras& extras);

    PictureSettings settings_;
    std::optional<scheduler::BudgetControl> budget_;
    std::vector<std::uint64_t> frames_at_step_;
    display::Overlay overlay_;
    display::Channel channel_;
    ImageGenerator generator_;
};

}  // namespace quadrig::appliance
