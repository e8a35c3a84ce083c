/// Speed against error of every setting: as a table, as JSON, as a plot, and as a quality ladder.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "config/quality_ladder.h"
#include "ig_core/reference/error.h"

namespace quadrig::appliance {

/// One setting from one camera.
struct CameraResult {
    double frame_ms = 0.0;  ///< median of the runs
    double cost = 0.0;      ///< median over the runs of the frame's time as a share of the default's in the same run
    reference::VisibilityError visibility;
    reference::PictureError picture;
};

/// One setting over all cameras: times are means, errors are pooled.
struct SettingResult {
    Quality quality;
    std::vector<CameraResult> cameras;
    double frame_ms = 0.0;
    double cost = 0.0;
    reference::VisibilityError visibility;
    reference::PictureError picture;
    bool on_front = false;  ///< no other setting is at least as fast and closer to the truth
};

/// Fills in everything beyond `cameras`.
void sum_up(std::vector<SettingResult>& results);

std::string accuracy_table(const std::vector<SettingResult>& results);
nlohmann::ordered_json accuracy_json(const std::vector<SettingResult>& results);
/// Frame time against PSNR, the Pareto front drawn through. SVG; `title` in plain text.
std::string accuracy_plot(const std::vector<SettingResult>& results, const std::string& title);

/// The ladder: of the front what names the right surface everywhere, stands at 38 dB or better and differs by a
/// decibel or more from its neighbours, and the default. The first step that is not drawn half as fine is called
/// "draft", the default "default", the one above it "fine", the last one "best", any other by what it is worth
/// ("43dB").
config::QualityLadder ladder_from(const std::vector<SettingResult>& results);

}  // namespace quadrig::appliance
