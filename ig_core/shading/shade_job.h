/// What shading needs to know of a surface on one pixel row: plain floats, ready for any vector width.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ig_core/spans/row_span.h"
#include "ig_core/view.h"

namespace quadrig {

/// A sine whose argument grows by so much over a pixel, squared mean, rad^2, is filtered away: its mean over the pixel
/// falls with that growth, for a box filter as 1 - x/24 to begin with, and ends near the sampling frequency, 6 rad.
inline constexpr float kFilteredAway = 36.0F;

/// A texture as one frame sees it. Phases are in turns and measured from the eye: the scene-sized part of w X + p is
/// reduced in double, so that the float part stays small wherever the texture is not yet filtered away.
struct FrameTexture {
    struct Term {
        float turns_per_metre;  ///< w_i / 2 pi
        float amplitude;        ///< of the sine in a factor, C_i / (2 sum C)
        float fade;             ///< what of it a footprint of 1 m^2 takes away
        // Phases at the eye, turns, in 0..1, of cosines: of the sines of X and Y, of what X / 2 and Y / 2 add to the
        // other's phase, and of what Z / 2 adds to either.
        float along_x, along_y, half_x, half_y, up_x, up_y;
    };
    std::array<Term, kMaxTextureTerms> terms;  ///< by rising frequency
    int count = 0;
    float variance = 0;  ///< of either factor, unfiltered
    SineMethod sine = SineMethod::parabola;
    float vertical = 0;  ///< u of Eq 15
};

/// Light, haze and sky of one frame.
struct FrameLight {
    std::array<float, 3> to_sun{};  ///< unit vector, scene axes
    float ambient = 1;
    bool haze = false;
    float extinction = 0;  ///< 1/m, in powers of two: 2.996 / V / ln 2
    std::array<float, 3> haze_colour{}, horizon{}, zenith{};
};

/// So many bins of paints there are; textures that share one cost a little time.
inline constexpr std::uint32_t kTextureBins = 16, kPaintBins = 2 * kTextureBins;

/// How one surface looks.
struct FramePaint {
    std::array<float, 3> colour{1, 1, 1};
    const FrameTexture* texture = nullptr;
    float texture_weight = 0;
    bool translucent = false;
    std::uint8_t bin = 0;  ///< surfaces of one bin may be shaded together
    float threshold = 0, limb_threshold = 0, softness = 1;
};

/// Columns [from, to) of one surface, to be shaded once per pixel into `buffer` (offset of column `from`).
struct ShadeJob {
    const RowSpan* span = nullptr;
    int from = 0, to = 0;
    std::uint32_t buffer = 0;
    std::uint8_t row = 0;               ///< which of those that are shaded together
    std::uint8_t bin = 0;               ///< jobs of one bin are shaded together
    const FramePaint* paint = nullptr;  ///< null: sky or light
};

/// So many samples of a surface are shaded in a vector of no more.
inline constexpr int kFewSamples = 8;

/// What all jobs of a picture have in common.
struct ShadeRow {
    const FrameLight* light = nullptr;
    bool smooth_stretches = true;  ///< interpolate what changes slowly
    bool pairs = false;            ///< one sample for two columns
    // Scene axes: how a ray's direction changes from a column and from a row to the next.
    std::array<float, 3> ray_step{}, along_row{};
    float xi_step = 0;  ///< the same of xi
};

/// A job's numbers. Columns are counted from the job's first one, at pixel centres.
struct ShadeInput {
    enum class Kind : std::uint8_t { sky, light, plane, quadric };
    Kind kind = Kind::sky;
    int count = 0;
    std::uint32_t buffer = 0;                 ///< where the first column's sample goes
    float least_column = 0, most_column = 0;  ///< sample points stay within the surface
    std::array<float, 3> colour{};            ///< lights: as it is seen, haze included
    std::array<float, 3> ray{};               ///< direction, scene axes: d = ray + column * ray_step
    std::array<float, 3> normal{};            ///< planes: unit, outward
    float plane_u = 0, plane_u_step = 0;      ///< planes: 1/k
    // Quadrics: xi = xi + column * xi_step; A, B, L as polynomials in xi; C.
    float xi = 0, c = 0;
    std::array<float, 2> b{};
    std::array<float, 3> a{}, limb{};
    const SceneQuadric* quadric = nullptr;
    const FramePaint* paint = nullptr;
    const ShadeRow* row = nullptr;
};

/// Linear light and opacity of shaded samples, one array each.
struct ShadeBuffer {
    std::vector<float> red, green, blue, opacity;
    void resize(std::size_t count);
};

/// Room that kernels may write past a job's end.
inline constexpr std::size_t kShadePadding = 64;

}  // namespace quadrig
