#include "appliance/painter.h"

#include <chrono>
#include <utility>

#include "display/test_pattern.h"

namespace quadrig::appliance {
namespace {

std::optional<scheduler::BudgetControl> budget_for(const PictureSettings& settings) {
    if (!settings.automatic) return std::nullopt;
    std::vector<double> costs;
    for (const config::QualityStep& step : settings.ladder) costs.push_back(step.cost);
    return scheduler::BudgetControl(std::move(costs), settings.step, scheduler::frame_time(settings.rate, 1));
}

}  // namespace

Painter::Painter(Scene scene, const PictureSettings& settings)
    : settings_(settings),
      budget_(budget_for(settings)),
      frames_at_step_(settings.ladder.size()),
      overlay_(settings.size.width, settings.size.height),
      channel_(settings.size.width, settings.size.height),
      generator_(std::move(scene), settings.threads) {}

ImagePlane Painter::image_plane() const {
    return ImagePlane::symmetric(settings_.size.width, settings_.size.height, settings_.fov);
}

display::VideoFormat Painter::video_format() const {
    return {settings_.size.width, settings_.size.height, settings_.rate.numerator, settings_.rate.denominator};
}

StageTimes Painter::paint(const View& view, const Environment& environment, std::uint64_t frame_number,
                          const Extras& extras) {
    const std::size_t step = extras.step.value_or(this->step());
    const auto begun = std::chrono::steady_clock::now();
    const StageTimes times = draw(view, environment, frame_number, step, extras);
    ++frames_at_step_[step];
    if (budget_) budget_->frame_took(std::chrono::steady_clock::now() - begun);
    return times;
}

StageTimes Painter::draw(const View& view, const Environment& environment, std::uint64_t frame_number, std::size_t step,
                         const Extras& extras) {
    StageTimes times{};
    if (!extras.test_pattern) times = generator_.render(view, environment, settings_.ladder[step].quality, image());
    const auto begun = std::chrono::steady_clock::now();
    if (extras.test_pattern) display::draw_test_pattern(image());
    if (extras.overlay.value_or(settings_.overlay)) overlay_.lay_over(image(), frame_number);
    times[static_cast<std::size_t>(Stage::present)] += std::chrono::steady_clock::now() - begun;
    return times;
}

void Painter::warm_up(const View& view) {
    constexpr int kWarmUpFrames = 2;
    for (int i = 0; i < kWarmUpFrames; ++i) draw(view, {}, 0, settings_.step, {});
}

}  // namespace quadrig::appliance
