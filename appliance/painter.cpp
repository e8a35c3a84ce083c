#include "appliance/painter.h"

#include <chrono>
#include <utility>

namespace quadrig::appliance {
namespace {

std::optional<display::Overlay> overlay_for(const PictureSettings& settings) {
    if (!settings.overlay) return std::nullopt;
    return std::optional<display::Overlay>(std::in_place, settings.size.width, settings.size.height);
}

}  // namespace

Painter::Painter(Scene scene, const PictureSettings& settings)
    : settings_(settings),
      overlay_(overlay_for(settings)),
      channel_(settings.size.width, settings.size.height),
      generator_(std::move(scene), settings.threads) {}

ImagePlane Painter::image_plane() const {
    return ImagePlane::symmetric(settings_.size.width, settings_.size.height, settings_.fov);
}

StageTimes Painter::paint(const View& view, const Environment& environment, std::uint64_t frame_number) {
    StageTimes times = generator_.render(view, environment, settings_.quality.quality, image());
    const auto begun = std::chrono::steady_clock::now();
    if (overlay_) overlay_->lay_over(image(), frame_number);
    times[static_cast<std::size_t>(Stage::present)] += std::chrono::steady_clock::now() - begun;
    return times;
}

void Painter::warm_up(const View& view) {
    constexpr int kWarmUpFrames = 2;
    for (int i = 0; i < kWarmUpFrames; ++i) paint(view, {}, 0);
}

}  // namespace quadrig::appliance
