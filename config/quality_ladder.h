/// The quality ladder: settings of the image generator's approximations worth having, from the fastest to the best.
///
/// It is measured, not thought out: `quadrig accuracy` makes config/quality.toml, which is built into the program; a
/// file of the same kind can take its place.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ig_core/quality.h"

namespace quadrig::config {

struct QualityStep {
    std::string name;
    Quality quality;
    double cost = 1.0;  ///< frame time as a share of the default's
    double psnr = 0.0;  ///< dB, linear light, against the converged reference
};

/// By rising cost; names are its own, one of them "default".
using QualityLadder = std::vector<QualityStep>;

/// The one the program was built with.
const QualityLadder& shipped_ladder();

/// Throws FileError.
QualityLadder read_quality_ladder(const std::filesystem::path& file);
void write_quality_ladder(const QualityLadder& ladder, std::ostream& out);

/// Where the step of a name stands.
std::optional<std::size_t> step_named(const QualityLadder& ladder, std::string_view name);
/// Where the default stands; every ladder has one.
std::size_t default_step(const QualityLadder& ladder);
/// Means that the frame loop chooses a step by the time it has.
inline constexpr std::string_view kAutomaticQuality = "auto";
/// "draft, default, best", and with "or auto": what a quality may be called, for help texts and errors.
std::string step_names(const QualityLadder& ladder);
std::string quality_names(const QualityLadder& ladder);

/// "2 sub-scan lines", "no antialiasing, parabola sine": what makes up a quality, in a few words.
std::string words_for(const Quality& quality);

}  // namespace quadrig::config
