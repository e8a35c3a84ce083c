/// The shading kernels, dispatched at run time to the best instruction set the machine has.
#pragma once

#include <span>
#include <string_view>

#include "ig_core/shading/shade_job.h"

namespace quadrig {

/// Shades the jobs of a row (image model: Eq 15, light, limb function, translucence, haze) into `buffer`, planar linear
/// light. Jobs stand there one behind the other; up to kShadePadding samples are written past the last one's end. Short
/// ones that follow one another and show one texture are shaded together. Returns how many terms of a texture it was
/// asked for at samples of their own, neither interpolated nor shared.
std::uint64_t shade(std::span<const ShadeInput> jobs, ShadeBuffer& buffer);

/// Evaluates the texturing function without filtering at scene points given relative to the eye, as shading does: for
/// tests.
void texture_values(const FrameTexture& texture, std::span<const float> x, std::span<const float> y,
                    std::span<const float> z, std::span<float> t);

std::string_view simd_target_name();

}  // namespace quadrig
