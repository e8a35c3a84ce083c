/// What a picture may do without: every approximation of the image generator has a name here, so that its cost and its
/// error can be measured, and a frame that is short of time can choose.
#pragma once

#include <algorithm>
#include <cstdint>

namespace quadrig {

/// How the forms of an outline are computed (outline/image_forms.h).
enum class SetUp : std::uint8_t {
    anchored,        ///< about the object's own anchor: no large numbers cancel
    textbook,        ///< as the paper writes them, in eye coordinates, double (Gardner 1984, Eq 4 to 14)
    textbook_single  ///< the same in float
};

/// Which distance puts two spans in order (spans/priority.h).
enum class DistanceRule : std::uint8_t {
    exact,
    interpolated  ///< linearly between a span's ends, as in the paper (Gardner 1984, 2.1)
};

/// How the texturing function's sines are evaluated; errors of one sine (shading/cosine-inl.h).
enum class SineMethod : std::uint8_t {
    parabola,    ///< a parabola times what is quadratic in it, 2e-3
    polynomial,  ///< a parabola times a polynomial of degree 4 in it, 1e-6
    table,       ///< the nearest of 1024 entries, 3.1e-3
    library      ///< Highway's own, 3e-7
};

/// Shading samples of a surface per pixel.
enum class ShadingRate : std::uint8_t {
    eighth,   ///< as a quarter, where two neighbours on a row share one too
    quarter,  ///< the whole picture is drawn on a grid half as fine, visibility too, each sample filling 2 x 2 pixels
    half,     ///< two neighbours on a row share one
    one,
    four  ///< the whole picture is drawn on a grid twice as fine, visibility too, and its light averaged
};

/// Pixels of the picture across one of the grid that it is drawn on: 2, 1 or 1/2.
constexpr double pixels_across(ShadingRate rate) {
    const bool coarse = rate == ShadingRate::eighth || rate == ShadingRate::quarter;
    return coarse ? 2.0 : rate == ShadingRate::four ? 0.5 : 1.0;
}
/// Whether two neighbours on a row of that grid share a sample.
constexpr bool shades_pairs(ShadingRate rate) { return rate == ShadingRate::eighth || rate == ShadingRate::half; }

struct Quality {
    int sub_scan_lines =
        2;  ///< samples of visibility in z per pixel row: 1, 2, 4 or 8; 0 is none but the pixels' centres
    SetUp set_up = SetUp::anchored;
    DistanceRule distance = DistanceRule::exact;
    SineMethod sine = SineMethod::parabola;
    int terms_left_out = 0;        ///< of every texture's sines the fastest, but never the last one; 0..7
    bool smooth_stretches = true;  ///< what changes slowly along a row is interpolated between samples
    ShadingRate shading = ShadingRate::one;
    double smallest_feature = 0.0;  ///< pixels: objects whose outlines are less high are left out

    /// Scan lines on which a row of pixels is asked for, 1..8.
    [[nodiscard]] int lines_per_row() const { return std::clamp(sub_scan_lines, 1, 8); }

    friend bool operator==(const Quality&, const Quality&) = default;
};

}  // namespace quadrig
