/// Settings of the image generator's approximations that have a name.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "ig_core/view.h"

namespace quadrig::config {

struct QualityPreset {
    std::string_view name;
    Quality quality;
};
/// From the fastest to the best.
inline constexpr std::array<QualityPreset, 4> kQualityPresets{{{"draft", {.sub_scan_lines = 1}},
                                                               {"default", {.sub_scan_lines = 2}},
                                                               {"fine", {.sub_scan_lines = 4}},
                                                               {"best", {.sub_scan_lines = 8}}}};
inline constexpr QualityPreset kDefaultQuality = kQualityPresets[1];

/// What a quality may be, for help texts and errors.
inline constexpr std::string_view kQualityNames = "draft, default, fine or best";

constexpr std::optional<QualityPreset> quality_preset(std::string_view name) {
    for (const QualityPreset& preset : kQualityPresets)
        if (preset.name == name) return preset;
    return std::nullopt;
}

}  // namespace quadrig::config
