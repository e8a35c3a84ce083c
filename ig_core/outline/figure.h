/// The visibility figure of a solid (Gardner 1984, Fig 5) as plain values: what its outline is found from and what is
/// found.
///
/// All of it is in image coordinates (x, z) on the image plane at distance 1, clipped to a window. Curves are polylines
/// within kFigureTolerance of the window's width; straight pieces have two points.
#pragma once

#include <vector>

#include "ig_core/outline/image_forms.h"
#include "ig_core/outline/polyline.h"

namespace quadrig {

inline constexpr double kFigureTolerance = 2e-4;

enum class StrokeKind { limb, intersection_curve, visibility_line, intersection_line };

/// One curve or line of the image, whether or not any of it is seen (Fig 5a). Curves are drawn where they lie in front
/// of the eye.
struct Stroke {
    StrokeKind kind = StrokeKind::limb;
    int plane = 0;  ///< surface that it belongs to, the second one for an intersection line; 0 for the limb
    int other_plane = 0;
    std::vector<Polyline> pieces;
};

/// A boundary as far as one z-band shows it (Fig 5b). It runs upwards, or, where it is level, to the right; `left` and
/// `right` are the surfaces at either hand on that way, kNoSurface for none.
struct VisibleSegment {
    StrokeKind kind = StrokeKind::limb;
    int left = 0, right = 0;
    std::vector<Polyline> pieces;
};

struct FigureKeyPoint {
    enum class Kind { limb_extremum, curve_extremum, contact, intersection, triplet };
    Kind kind = Kind::contact;
    glm::dvec2 at{0.0};
};

/// Rows over which nothing changes in the window but where boundaries are: from one key point's height to the next.
struct FigureBand {
    double z_from = 0, z_to = 0;
};

struct Figure {
    ImageWindow window;
    std::vector<Stroke> strokes;  ///< in the order of their kinds
    std::vector<VisibleSegment> segments;
    std::vector<FigureKeyPoint> key_points;  ///< the visible ones, each once
    std::vector<FigureBand> bands;           ///< by rising z
    /// A solid that may have no end: its rows are solved one by one, and its bands are found by looking at them.
    bool solved_by_row = false;
};

/// Never fails: what is out of sight, or out of the window, leaves the figure empty.
Figure make_figure(const Solid& solid, const ScenePoint& eye, const glm::dmat3& eye_from_scene,
                   const ImageWindow& window);

}  // namespace quadrig
